#!/usr/bin/env bash
# Ctrl-C and requests to end: the frame in hand is finished, nothing unfinished is left, the status says why.
source "$(dirname "$0")/library.sh"
set -m  # jobs of their own, so that they do not ignore SIGINT
# A shell that was itself started with SIGINT ignored (a background job) cannot give it back to its jobs; env can.
heeding=(env --default-signal=INT,TERM,HUP,PIPE)

"$program" make town --out town --count 400 --viewers 40 --range 100 --frames 200 >/dev/null || fail "make"

# A replay that waits for its next frame on standard input is in the middle of its work for certain.
stopped_by() {  # stopped_by SIGNAL STATUS
  checks=$((checks + 1))
  mkfifo pipe
  "${heeding[@]}" "$program" run town/scene.json --frames - --out out/pvs.jsonl --stats out/stats.json <pipe >stdout.txt 2>stderr.txt &
  local child=$! status
  exec 3>pipe
  head -n 20 town/frames.jsonl >&3
  for _ in $(seq 100); do [ -n "$(ls -A out)" ] && break; sleep 0.05; done
  [ -n "$(ls -A out)" ] || fail "$1: the replay did not begin"
  kill -s "$1" "$child"
  wait "$child"
  status=$?
  exec 3>&-
  rm pipe
  is "status after $1" "$status" "$2"
  is "left behind after $1" "$(ls -A out)" ""
  grep -q '^gridcull: stopped' stderr.txt || fail "$1: said: $(cat stderr.txt)"
}
stopped_by INT 130
stopped_by TERM 143
stopped_by HUP 129

# Who reads our output has enough: the program ends without a word, and without the file that it had begun.
checks=$((checks + 3))
"${heeding[@]}" "$program" run town/scene.json --frames town/frames.jsonl --out - --stats out/stats.json 2>stderr.txt |
  head -c 100 >/dev/null
is "status after a broken pipe" "${PIPESTATUS[0]}" 141
is "left behind after a broken pipe" "$(ls -A out)" ""
is "said after a broken pipe" "$(cat stderr.txt)" ""

finish
