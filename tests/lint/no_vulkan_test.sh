#!/usr/bin/env bash
# no_vulkan_test.sh RUN TESTS: where no Vulkan device is found, ./run test skips the tests that need
# one, names and counts them, and with --require-all fails. TESTS is the build folder of the tests.
set -euo pipefail
# shellcheck source=/dev/null
source "$1"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf 'subdirs("%s")\n' "$2" >"$folder/CTestTestfile.cmake"

# Everything is built; results go into the folder.
install_packages() { :; }
build() { :; }
build=$folder
# The loader of Vulkan finds no driver; both names, for loaders old and new.
export VK_DRIVER_FILES=$folder/none.json VK_ICD_FILENAMES=$folder/none.json

# check STATUS ARG...: run_tests ARG... on the tests of the GPU returns STATUS, with all of these
# tests skipped, and each of them named.
check() {
  local want=$1 status=0
  shift
  local tests=(-R '^gpu\.' -E '^gpu\.(spirv|tables|kernel_accesses|Hazards\.|GpuDeviceChoice\.|GpuKernelCache\.|GpuKernelCacheFolder\.)')
  ctest --test-dir "$build" -N "${tests[@]}" | sed -n 's/^ *Test *#[0-9]*: /skipped: /p' |
    sort >"$folder/expected"
  (run_tests "$@" "${tests[@]}") >"$folder/output" 2>&1 || status=$?
  grep '^skipped: ' "$folder/output" | sort >"$folder/skipped"
  local count
  count=$(wc -l <"$folder/expected")
  if ((status != want || count < 20)) || ! cmp -s "$folder/expected" "$folder/skipped" ||
    [[ $(tail -n 1 "$folder/output") != "0 passed, 0 failed, $count skipped" ]]; then
    printf 'run_tests %s: status %d, not %d, or not all %d tests skipped:\n' \
      "$*" "$status" "$want" "$count"
    diff "$folder/expected" "$folder/skipped" || true
    cat "$folder/output"
    exit 1
  fi
}

check 0
check 1 --require-all
