#!/usr/bin/env bash
# test_summary_test.sh RUN: the line that closes ./run test counts each outcome of ctest once, and
# no test that was skipped or could not be started as passed.
set -euo pipefail
# shellcheck source=/dev/null
source "$1"

junit=$(mktemp)
trap 'rm -f "$junit"' EXIT
faults=0

passed='<testcase name="a.Ok" classname="a.Ok" time="0" status="run">
  <system-out>status="fail" &lt;skipped message="SKIP_</system-out></testcase>'
failed='<testcase name="a.Bad" classname="a.Bad" time="0" status="fail">
  <failure message=""/><system-out>status="run"</system-out></testcase>'
skipped='<testcase name="a.Skip" classname="a.Skip" time="0" status="notrun">
  <skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/><system-out> status="run"</system-out></testcase>'
skip_code='<testcase name="a.Code" classname="a.Code" time="0" status="notrun">
  <skipped message="SKIP_RETURN_CODE=77"/><system-out/></testcase>'
disabled='<testcase name="a.Off" classname="a.Off" time="0" status="disabled">
  <system-out>Disabled</system-out></testcase>'
not_built='<testcase name="a_NOT_BUILT" classname="a_NOT_BUILT" time="0" status="notrun">
  <skipped message="Unable to find executable"/><system-out/></testcase>'

# expect STATUS TEXT TESTCASE...: what summarise_tests returns and prints for these test cases.
expect() {
  local want_status=$1 want=$2 got status=0
  shift 2
  printf '<?xml version="1.0"?>\n<testsuite name="t"\n\ttests="%d"\n\t>\n%s\n</testsuite>\n' \
    $# "$*" >"$junit"
  got=$(summarise_tests "$junit") || status=$?
  if [[ $got != "$want" || $status != "$want_status" ]]; then
    printf 'expected status %s:\n%s\ngot status %s:\n%s\n\n' "$want_status" "$want" "$status" "$got"
    faults=$((faults + 1))
  fi
}

expect 0 '1 passed, 0 failed, 0 skipped' "$passed"
expect 0 '2 passed, 0 failed, 0 skipped' "$passed" "$passed"
expect 1 '1 passed, 1 failed, 0 skipped' "$passed" "$failed"
expect 1 '0 passed, 1 failed, 0 skipped' "$not_built"
expect 1 '0 passed, 0 failed, 0 skipped'
expect 2 $'skipped: a.Skip\n1 passed, 0 failed, 1 skipped' "$skipped" "$passed"
expect 2 $'skipped: a.Skip\nskipped: a.Code\nskipped: a.Off\n0 passed, 0 failed, 3 skipped' \
  "$skipped" "$skip_code" "$disabled"
expect 1 $'skipped: a.Off\n1 passed, 2 failed, 1 skipped' \
  "$failed" "$disabled" "$not_built" "$passed"

exit $((faults > 0))
