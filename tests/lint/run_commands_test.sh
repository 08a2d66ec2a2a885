#!/usr/bin/env bash
# run_commands_test.sh RUN: what ./run says about its commands, and which program each of them runs.
set -euo pipefail
# shellcheck source=/dev/null
source "$1"

# Nothing is built or installed; the program is printed instead of run.
install_packages() { :; }
build() { :; }
build_decode_path() { :; }
use_build() { :; }
build=/build
exec() { printf '%s\n' "$*" && exit; }
faults=0

# not_built TEXT: the programs /build/FOLDER/NAME in TEXT that FOLDER/CMakeLists.txt does not name as what it makes.
not_built() {
  local word
  for word in $1; do
    [[ $word =~ ^/build/(.*)/([a-z_]+)$ ]] || continue
    local folder=${BASH_REMATCH[1]} name=${BASH_REMATCH[2]}
    grep -qsE -- "(^|[( /])$name([) ]|[.]cpp|\$)" "$root/$folder/CMakeLists.txt" || printf '%s\n' "$word"
  done
}

# expect STATUS PATTERN ARG...: main ARG... ends with STATUS, its output fits the pattern, and the
# programs in it are built.
expect() {
  local want=$1 pattern=$2 status=0 output
  shift 2
  output=$( (main "$@") 2>&1) || status=$?
  # shellcheck disable=SC2053
  if [[ $status != "$want" || $output != $pattern || -n $(not_built "$output") ]]; then
    printf './run %s: status %d, not %d, a program is not built, or this output is not as %s:\n%s\n\n' \
      "$*" "$status" "$want" "$pattern" "$output"
    faults=$((faults + 1))
  fi
}

for argument in '' --help -h help; do
  expect 0 $'Usage: ./run COMMAND *\nStart\n  demo *\nYour light field\n*\nYour decoder\n*\nMore\n*' $argument
done
expect 0 $'Usage: ./run COMMAND *\nMeasurements\n*' help developers
expect 2 "./run: 'encod' is not a command; did you mean encode[?]*" encod
expect 2 "./run: 'rtl-chek' is not a command; did you mean rtl-check[?]*" rtl-chek
expect 2 $'./run: \'nonsense\' is not a command\nRun ./run --help for help' nonsense
expect 0 '/build/tools/hmlfc synth --scene cards' synth --scene cards
expect 0 "python3 -B $root/rtl/synth/report.py size ice40" synthesis size ice40
expect 0 "*python3 -B $root/rtl/fpga/fpga.py --seeds 1" fpga --seeds 1
expect 0 '/build/testbench/gpu_check FILE' gpu-check FILE
expect 0 '/build/testbench/testbench check FILE' rtl-check FILE
expect 0 '/build/testbench/testbench view FILE' rtl-view FILE
expect 0 "*python3 $root/testbench/programs/rtl_coverage.py /build/testbench/testbench" rtl-coverage
expect 0 "*python3 -B $root/tools/release/sbom.py $root out.json" sbom out.json
expect 0 "*python3 -B $root/tools/release/site_pages.py $root $root/out/site" docs
expect 0 '*tests/stress/stress.py --build /build --hmlfc /build/tools/hmlfc *' stress --minutes 1
expect 0 '/build/bench/hmlfc_measure render FILE' bench render FILE
expect 0 '/build/bench/bench_gpu FILE' bench gpu FILE
expect 0 "*python3 $root/bench/accuracy --quick" bench accuracy --quick
expect 0 $'Usage: ./run bench NAME *\n  accuracy  *\n  skipping  *' bench
expect 2 $'No benchmark nosuch; there are\n*\n  render  *' bench nosuch
expect 2 'No benchmark bench; *' bench bench
expect 2 'No benchmark .*; *' bench '.*'

# The two pages name the commands of main and of hmlfc, each once.
named=$(commands | sort)
reached=$({
  declare -f main | sed -n 's/^ *(\?\([a-z][a-z-]*\))$/\1/p'
  sed -nE 's/.*program(, task, |\.add_subcommand\()"([a-z-]+)".*/\2/p' \
    "$root"/tools/cli/*.cpp "$root"/tools/view/{command,publish}.cpp
} | sort)
if [[ -z $named || $named != "$reached" ]]; then
  printf 'usage names\n%s\nmain has\n%s\n' "$named" "$reached"
  faults=$((faults + 1))
fi

exit $((faults > 0))
