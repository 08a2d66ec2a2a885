# Commands of ./run that check more than ./run test: clauses, coverage, fuzzing, stress, soak.
# Sourced by ./run, whose functions and variables they use.

run_clauses() {
  install_packages build
  build hmlfc_cli
  exec python3 -B "$root/tests/clauses/clause_table.py" --program "$build/tools/hmlfc" "$@"
}

run_coverage() {
  install_packages build coverage
  build_decode_path vector-coverage vector_check
  exec "$(debian_python)" -B "$root/tests/coverage/report.py" --build "$build" "$@"
}

run_fuzz() {
  install_packages build fuzz
  build_decode_path fuzz tests/fuzz/all
  exec "$(debian_python)" -B "$root/tests/fuzz/fuzz.py" --build "$build" "$@"
}

# Scenes are made and encoded by the optimised program.
run_stress() {
  install_packages build fuzz
  build hmlfc_cli
  local hmlfc=$build/tools/hmlfc
  build_decode_path stress stress_streams stress_cameras
  exec "$(debian_python)" -B "$root/tests/stress/stress.py" --build "$build" --hmlfc "$hmlfc" "$@"
}

# The Verilated units of this build count coverage.
run_rtl_coverage() {
  install_packages build test
  use_build rtl-coverage
  build testbench
  exec "$(debian_python)" "$root/testbench/programs/rtl_coverage.py" "$build/testbench/testbench" "$@"
}

# run_soak --minutes N [--seed S] [--shard I/N] [CTEST-ARG...]: the tests with label soak, of N shards the I-th, then
# random streams, intact and damaged, on every Verilated unit. The default seed is the time, so that each soak is different.
run_soak() {
  local minutes='' seed=$((EPOCHSECONDS % 1000000000)) shard=1/1 status=0 rest=()
  while (($# > 0)); do
    case $1 in
      --minutes) minutes=${2:?"--minutes takes a number"} && shift 2 ;;
      --seed) seed=${2:?"--seed takes a number"} && shift 2 ;;
      --shard) shard=${2:?"--shard takes I/N"} && shift 2 ;;
      *) rest+=("$1") && shift ;;
    esac
  done
  if [[ ! $minutes =~ ^[1-9][0-9]*$ || ! $seed =~ ^[0-9]+$ || ! $shard =~ ^[1-9][0-9]*/[1-9][0-9]*$ ]] ||
    ((${shard%/*} > ${shard#*/})); then
    say "soak: --minutes takes a number from 1 on, --seed a number, --shard I/N with I from 1 to N"
    exit 2
  fi
  install_packages build test soak
  soak=ON build all
  local begin=$SECONDS left
  say "Tests with label soak, for $minutes minutes at most"
  timeout --signal=INT $((60 * minutes)) \
    ctest --test-dir "$build" -L soak -I "${shard%/*},,${shard#*/}" --output-on-failure -j "$(nproc)" "${rest[@]}" >&2 ||
    status=$?
  if ((status == 124)); then
    say "the time is up before all of them have run"
    exit 1
  fi
  if ((status != 0)); then exit 1; fi
  left=$((60 * minutes - (SECONDS - begin)))
  if ((left <= 0)); then return; fi
  say "Random streams on the decode unit from seed $seed on"
  exec "$build/testbench/testbench" random --seed "$seed" \
    --minutes "$((left / 60)).$((left % 60 / 6))"
}
