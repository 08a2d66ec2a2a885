#!/usr/bin/env bash
# run_commands_test.sh RUN: what ./run says of its commands, and which program each of them reaches.
set -euo pipefail
# shellcheck source=/dev/null
source "$1"

# Nothing is built or installed; the program is printed instead of run.
install_packages() { :; }
build() { :; }
build_decode_path() { :; }
build=/build
exec() { printf '%s\n' "$*" && exit; }
faults=0

# expect STATUS PATTERN ARG...: main ARG... ends with STATUS, and its output fits the pattern.
expect() {
  local want=$1 pattern=$2 status=0 output
  shift 2
  output=$( (main "$@") 2>&1) || status=$?
  # shellcheck disable=SC2053
  if [[ $status != "$want" || $output != $pattern ]]; then
    printf './run %s: status %d, not %d, or this output is not as %s:\n%s\n\n' \
      "$*" "$status" "$want" "$pattern" "$output"
    faults=$((faults + 1))
  fi
}

expect 0 'Usage: ./run demo *'
for argument in --help -h help; do
  expect 0 $'Usage: ./run demo *\nCommands of hmlfc\n\n/build/tools/hmlfc --help' "$argument"
done
expect 0 '/build/tools/hmlfc synth --scene cards' synth --scene cards
expect 0 "python3 -B $root/rtl/synth/report.py size ice40" synthesis size ice40
expect 0 '/build/testbench/gpu_check FILE' gpu-check FILE
expect 0 '/build/testbench/rtl_check FILE' rtl-check FILE
expect 0 '/build/bench/bench_methods 40' bench methods 40
expect 0 "*python3 $root/bench/accuracy --quick" bench accuracy --quick
expect 0 $'Usage: ./run bench NAME *\n  accuracy  *\n  skipping  *' bench
expect 2 $'No benchmark nosuch; there are\n*\n  methods  *' bench nosuch
expect 2 'No benchmark bench; *' bench bench
expect 2 'No benchmark .*; *' bench '.*'

# Every command of the usage is one of main's, and the other way round.
named=$(usage | sed -n 's/^\(Usage:\|      \) \.\/run \([a-z][a-z-]*\) .*/\2/p' | sort -u)
reached=$(declare -f main | sed -n 's/^ *(\?\([a-z][a-z-]*\))$/\1/p' | sort -u)
if [[ -z $named || $named != "$reached" ]]; then
  printf 'usage names\n%s\nmain has\n%s\n' "$named" "$reached"
  faults=$((faults + 1))
fi

exit $((faults > 0))
