# Shared by the scripts beside it: a scratch folder, scenes in one line, and what to expect of the program.
set -uo pipefail
shopt -s nullglob
program=$(realpath "$1")
work=$(mktemp -d)
server=  # the process of serve() while it runs
trap '[ -z "$server" ] || kill -9 "$server" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
mkdir out
failures=0 checks=0

fail() {
  failures=$((failures + 1))
  printf 'FAILED: %s\n' "$*" >&2
}

# finish: the script's last word.
finish() {
  echo "$checks checks, $failures failures"
  [ "$checks" -gt 0 ] && [ "$failures" -eq 0 ]
}

# scene FILE OBJECTS [VIEWERS [MORE_KEYS]]: a 2D scene; each list as JSON without its brackets.
scene() {
  printf '{"format": "gridcull.scene/1", "dimension": 2, %s "objects": [%s], "viewers": [%s]}\n' \
    "${4:-}" "$2" "${3:-}" >"$1"
}

# refused NAME WORD COMMAND...: exit 2, one line on standard error that starts with "gridcull: " and holds
# WORD (a regular expression), nothing on standard output, nothing new in the folder out/.
refused() {
  local name=$1 word=$2 status said
  shift 2
  checks=$((checks + 1))
  "$program" "$@" >stdout.txt 2>stderr.txt </dev/null
  status=$?
  said=$(<stderr.txt)
  [ "$status" -eq 2 ] || fail "$name: exit status $status, expected 2 (${said:0:300})"
  [[ "$said" == "gridcull: "* && "$said" != *$'\n'* ]] || fail "$name: expected one line 'gridcull: ...', found: $said"
  [[ "$said" =~ $word ]] || fail "$name: the line does not say '$word': $said"
  [ ! -s stdout.txt ] || fail "$name: something on standard output: $(head -c 200 stdout.txt)"
  left=(out/* out/.[!.]*)
  [ ${#left[@]} -eq 0 ] || { fail "$name: left behind: ${left[*]}"; rm -rf out; mkdir out; }
}

# good NAME COMMAND...: exit 0 and nothing on standard error; standard output is left in stdout.txt.
good() {
  local name=$1 status
  shift
  checks=$((checks + 1))
  "$program" "$@" >stdout.txt 2>stderr.txt </dev/null
  status=$?
  [ "$status" -eq 0 ] || fail "$name: exit status $status ($(head -c 300 stderr.txt))"
  [ ! -s stderr.txt ] || fail "$name: something on standard error: $(cat stderr.txt)"
}

# same NAME FILE FILE, and is NAME VALUE VALUE
same() {
  checks=$((checks + 1))
  cmp -s "$2" "$3" || fail "$1: $2 and $3 differ"
}
is() {
  checks=$((checks + 1))
  [ "$2" = "$3" ] || fail "$1: '$2', expected '$3'"
}

# serve NAME COMMAND...: a server in the background, whose output goes to NAME and NAME.err; sets server and port.
serve() {
  local out=$1
  shift
  checks=$((checks + 1))
  "$program" "$@" >"$out" 2>"$out.err" &
  server=$!
  for _ in $(seq 100); do
    grep -qs "^listening on http://127.0.0.1:" "$out" && break
    sleep 0.05
  done
  port=$(sed -n '1s/^listening on http:\/\/127.0.0.1:\([0-9]*\)$/\1/p' "$out")
  [ -n "$port" ] || fail "$*: no first line with the address"
}

# ended NAME: SIGTERM ends the server with status 0 and nothing on standard error.
ended() {
  local status
  checks=$((checks + 1))
  kill -TERM "$server"
  wait "$server"
  status=$?
  server=
  [ "$status" -eq 0 ] || fail "$1: status $status after SIGTERM, expected 0"
  [ ! -s "$1.err" ] || fail "$1: something on standard error: $(cat "$1.err")"
}
