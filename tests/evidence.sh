# Commands of ./run that check the tests themselves: clauses, coverage, mutants, fuzzing, stress, soak.
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
  local programs=tests/fuzz/all
  if [[ " $* " == *" --self-test "* ]]; then programs=fuzz_faults; fi
  build_decode_path fuzz tests/fuzz/all "$programs"
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
  build rtl_random
  exec "$(debian_python)" "$root/testbench/programs/rtl_coverage.py" \
    "$build/testbench/rtl_random" "$@"
}

# run_mutate WHAT [ARG...]: changes WHAT in one place at a time; the conformance vectors must notice.
run_mutate() {
  local what=${1:-}
  if (($# > 0)); then shift; fi
  case $what in
    model) mutate_model "$@" ;;
    shaders) mutate_shaders "$@" ;;
    rtl) mutate_rtl "$@" ;;
    naive) exec "$(debian_python)" -B "$root/tests/mutation/naive/mutate.py" "$@" ;;
    *)
      say "mutate: model, shaders, rtl or naive"
      exit 2
      ;;
  esac
}

mutate_model() {
  install_packages build
  build_decode_path mutation vector_check
  exec "$(debian_python)" -B "$root/tests/mutation/model/mutate.py" --build "$build" "$@"
}

mutate_shaders() {
  install_packages build test
  local program=decode_vectors
  if [[ " $* " == *" --renderer "* ]]; then program=draw_frames; fi
  soak=ON build "$program"
  exec "$(debian_python)" -B "$root/tests/mutation/shaders/campaign.py" \
    --program "$build/tests/gpu/$program" "$@"
}

# mutate_rtl [--count N] [--seed S] [--group NAME] [ARG...]: mutants other than those of the tests get their own build.
mutate_rtl() {
  local count='' seed='' groups=(datapath loading tiles references memories dma view) rest=()
  while (($# > 0)); do
    case $1 in
      --count) count=${2:?"--count takes a number"} && shift 2 ;;
      --seed) seed=${2:?"--seed takes a number"} && shift 2 ;;
      --group) groups=("${2:?"--group takes a name"}") && rest+=(--group "$2") && shift 2 ;;
      *) rest+=("$1") && shift ;;
    esac
  done
  install_packages build test
  if [[ -n $count$seed ]]; then
    use_build rtl-mutants
    export HMLFC_RTL_MUTANTS=${count:-42} HMLFC_RTL_MUTANT_SEED=${seed:-1}
    rm -f "$build/settings"  # so that CMake sees them
  fi
  soak=ON build "${groups[@]/#/rtl_mutants_}"
  exec "$(debian_python)" -B "$root/tests/mutation/rtl/mutate.py" "$build/tests/mutation/rtl/" "$root/vectors" \
    --jobs "$(nproc)" "${rest[@]}"
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
  install_packages build test
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
  exec "$build/testbench/rtl_random" --seed "$seed" \
    --minutes "$((left / 60)).$((left % 60 / 6))"
}
