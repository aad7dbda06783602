#!/usr/bin/env bash
# Builds the fuzzers of the readers and lets each run for a while, from the committed corpus, which stays as it is.
#   fuzz.sh SOURCE WORK [SECONDS]     WORK: a build folder of their own; SECONDS for each target (default 30)
# What it finds lies in WORK/found/TARGET: mend it, and keep it in tests/fuzz/corpus. Inputs that reach new code lie in
# WORK/corpus/TARGET. A table of what was done is printed at the end.
set -euo pipefail
source=$1 work=$2 seconds=${3:-30}
compiler=$(command -v clang++ || command -v clang++-14) || { echo "skipped: no clang++" >&2; exit 77; }
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  "$compiler" -x c++ -fsanitize=fuzzer - -o /dev/null 2>/dev/null || { echo "skipped: no libFuzzer" >&2; exit 77; }

cmake -S "$source" -B "$work" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER="$compiler" \
  -DGRIDCULL_BUILD_FUZZERS=ON -DGRIDCULL_SANITIZE=address,undefined >/dev/null
targets=(wire scene frame)
cmake --build "$work" --target "${targets[@]/#/gridcull_fuzz_}"

status=0
table=
for target in "${targets[@]}"; do
  mkdir -p "$work/corpus/$target" "$work/found/$target"
  log=$work/$target.log
  "$work/gridcull_fuzz_$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=4096 -max_len=4096 \
    -dict="$source/tests/fuzz/words.dict" -print_final_stats=1 -artifact_prefix="$work/found/$target/" "$work/corpus/$target" "$source/tests/fuzz/corpus/$target" \
    >"$log" 2>&1 || { echo "$target: found something, see $log and $work/found/$target" >&2; status=1; }
  # The readers are led by what is reached in them, not in the targets alone.
  counters=$(sed -n 's/^INFO: Loaded .* (\([0-9]*\) inline 8-bit counters).*/\1/p' "$log" | head -1)
  [ "${counters:-0}" -gt 10000 ] || { echo "$target: only ${counters:-no} places are counted" >&2; status=1; }
  runs=$(sed -n 's/^stat::number_of_executed_units: //p' "$log")
  covered=$(grep -o 'cov: [0-9]*' "$log" | tail -1)
  table+="| $target | ${runs:-?} | ${covered#cov: } of $counters | $(find "$work/found/$target" -type f | wc -l) |"$'\n'
done
printf '| target | executions | edges reached | finds |\n|---|--:|--:|--:|\n%s' "$table"
exit $status
