"""The line protocol: what it alone catches, and decoders that break it."""

import json
import subprocess
import sys

from conform_case import ROOT, SUITE, ConformTest, main
from faulty_lines import ANSWERS, BLOCKS

FAULTY = ROOT / "tests" / "conform" / "faulty_lines.py"

# Each planted fault of single blocks, a vector that must catch it, and what the report says.
HUNTED_BY = {
    "choices_of_others": ("error/motion-choice-of-others", "bad_mode instead of samples"),
    "wrong_later_error": ("error/level-delta-28", "tile_overrun instead of bad_levels"),
    "error_spreads": ("error/level-delta-28", "bad_levels instead of samples"),
    "later_errors_hidden": ("error/level-delta-28", "samples instead of bad_levels"),
    "table_of_empty_tiles": ("error/group-table-cut-empty", "bad_group_record instead of samples"),
    "end_of_vectors_unchecked": ("error/overrun-vectors-alone", "samples instead of tile_overrun"),
    "stop_level_ignored": ("real/cards-main", "at stop level 1: value"),
    "stop_level_beyond": ("syntax/tree-3", "at stop level 1: value"),
    "errors_below_stop_level": ("error/reference-last-block", "at stop level 1: bad_levels instead of samples"),
}

# Each way to break the protocol, and what comes of it.
ANSWER_RESULTS = {
    "Other_version": ("fail", "wrong answer to 'hello 1': \"0 ok 2 view block\""),
    "No_abilities": ("fail", "neither view nor block"),
    "Banner": ("pass", ""),
    "Endless_banner": ("fail", "wrong answer to 'hello 1': none in 64 KiB"),
    "Endless_line": ("fail", "wrong answer to 'view 0 0': a line of more than"),
    "Ends_at_once": ("error", "exit status 0 without an answer at 'hello 1'"),
    "Cannot_run": ("skipped", "cannot run here: no board"),
    "Crashes": ("error", "signal 11 (Segmentation fault) at 'block 0 0 0 0 0 0'"),
    "Hangs": ("timeout", "s at 'view 0 0'"),
    "Ends_within_an_answer": ("error", "exit status 3 without an answer at 'view 0 0'"),
    "Says_it_twice": ("fail", "wrong answer to 'open "),
    "Wrong_number": ("fail", "wrong answer to 'view 0 0': \"12 ok"),
    "Garbage": ("fail", "wrong answer to 'block 0 0 0 0 0 0': \"Segfault? ?\", not"),
    "Too_few_samples": ("fail", "60 characters instead of 16 samples"),
    "Not_hexadecimal": ("fail", "\"x\" is not a hexadecimal digit"),
    "Sample_too_wide": ("fail", "wrong answer to 'view 0 0': sample 0 is 256, not of 8 bits"),
    "Other_shape": ("fail", "wrong answer to 'open': cols"),
    "Decodes_at_open": ("pass", ""),  # but not on a stream in which blocks fail
    "Crashes_once": ("error", "but passes as the first stream of a process"),
    "Something_stays": ("fail", "but passes as the first stream of a process"),
}

SMALLEST = "boundary/light-field-1x1"
NEXT = "boundary/view-1x1"


def lines(fault):
    return f"lines: {sys.executable} -B {FAULTY} {fault}"


class Lines(ConformTest):
    def run_on(self, dut, *vectors, arguments=()):
        """The result of the last of the vectors, which one process has after the other."""
        filters = [word for vector in vectors for word in ("--filter", vector)]
        _, report = self.conform(dut, *filters, "--jobs", "1", *arguments, suite=SUITE)
        return self.results(report)[vectors[-1]]

    def test_every_fault_is_run(self):
        self.assertEqual(set(HUNTED_BY), set(BLOCKS))
        self.assertEqual(set(ANSWER_RESULTS), set(ANSWERS))

    def test_faults_that_only_the_protocol_catches(self):
        for fault, (vector, reason) in HUNTED_BY.items():
            with self.subTest(fault=fault):
                self.assertEqual(self.run_on(lines("none"), vector)["status"], "pass")
                dut = self.folder / f"{fault}.json"
                command = f"{sys.executable} -B {FAULTY} {fault} {{input}} -o {{output}}"
                dut.write_text(json.dumps({"name": fault, "command": command, "error_names": True}))
                self.assertEqual(self.run_on(dut, vector)["status"], "pass")
                result = self.run_on(lines(fault), vector)
                self.assertEqual(result["status"], "fail", result)
                self.assertIn(reason, result["reason"])

    def test_answers(self):
        for fault, (status, reason) in ANSWER_RESULTS.items():
            with self.subTest(fault=fault):
                limits = ("--timeout", "3") if status == "timeout" else ()
                result = self.run_on(lines(fault), SMALLEST, NEXT, arguments=limits)
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result.get("reason", ""))

    def test_errors_of_blocks_at_open(self):
        """Whatever the error, it is one cause."""
        ids = ("error/sign-mode-3", "error/level-delta-28")
        filters = [word for vector in ids for word in ("--filter", vector)]
        _, report = self.conform(lines("Decodes_at_open"), *filters, suite=SUITE)
        causes = report["runs"][0]["begin"]["causes"]
        self.assertEqual([(c["cause"], len(c["vectors"])) for c in causes], [("refused at 'open' where only blocks fail", 2)])

    def test_failures_cost_few_processes(self):
        """Only some of many are run again in a new one."""
        starts = self.folder / "starts"
        program = f"{sys.executable} -B {FAULTY} Other_shape"
        dut = f"lines: sh -c 'echo >>{starts}; exec {program}'"
        _, report = self.conform(dut, "--filter", "syntax/bise-*", "--jobs", "1", suite=SUITE)
        reasons = [result["reason"] for result in self.results(report).values() if result["status"] == "fail"]
        self.assertGreater(len(reasons), 20)
        self.assertEqual({reason.partition("cols")[0] for reason in reasons}, {"wrong answer to 'open': "})
        self.assertIn(len(starts.read_text()), range(9, 16))

    def test_a_crash_is_one_result(self):
        _, report = self.conform(
            lines("Crashes_once"), "--jobs", "1", *(word for name in (SMALLEST, NEXT, "boundary/view-2x2") for word in ("--filter", name)), suite=SUITE
        )  # fmt: skip
        results = self.results(report)
        self.assertEqual([results[name]["status"] for name in (SMALLEST, NEXT)], ["pass", "error"])

    def test_first_wrong_stage(self):
        """At a stop level as well: the values of another level are not those of this one's sample."""
        result = self.run_on(lines("stop_level_ignored"), "real/cards-main")
        self.assertRegex(result["stage"], r"^stage |agree in the decoder's trace")

    def test_session_of_the_document(self):
        """The example answers as docs/line_protocol.md shows."""
        text = (ROOT / "docs" / "line_protocol.md").read_text().replace("/suite/", f"{SUITE}/")
        session = text[text.index("0 hello 1") :].partition("```")[0].splitlines()
        command = [sys.executable, "-B", ROOT / "examples" / "line_decoder.py"]
        requests = "".join(line + "\n" for line in session[::2])
        done = subprocess.run(command, input=requests, stdout=subprocess.PIPE, text=True, check=True)
        self.assertEqual(done.stdout.splitlines(), session[1::2])
        self.assertGreater(len(session), 8)

    def test_small_suite(self):
        for dut in ("naive", "model-library"):
            with self.subTest(dut=dut):
                status, report = self.conform(SUITE / "duts" / f"{dut}.json")
                self.assertEqual(status, 0, report)
                self.assertEqual({result["status"] for result in self.results(report).values()}, {"pass"})

    def test_fuzz_and_minimise(self):
        text = self.hmlfc("fuzz-dut", "--dut", lines("none"), "--count", "1", "--seed", "11", "-o", "clean")
        self.assertIn("1 streams, 0 failures", text)
        stream = SUITE / "boundary" / "view-3x5.hmlfc"
        self.hmlfc("minimise", stream, "--dut", lines("Crashes"), "--trials", "5", "-o", "small.hmlfc")
        self.assertLess((self.folder / "small.hmlfc").stat().st_size, stream.stat().st_size)


if __name__ == "__main__":
    main()
