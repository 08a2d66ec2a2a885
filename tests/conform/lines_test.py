"""The line protocol: what it alone catches, and decoders that break it."""

import subprocess
import sys

from conform_case import ROOT, SUITE, ConformTest, main

BROKEN = ROOT / "tests" / "conform" / "broken_lines.py"
SMALLEST = "boundary/light-field-1x1"
NEXT = "boundary/view-1x1"

# Decoders whose single blocks are wrong where a view is right: a vector, and what the report says.
BLOCKS = {
    "another_later_error": ("error/level-delta-28", "tile_overrun instead of bad_levels"),
    "stop_level_ignored": ("real/cards-main", "at stop level 1: value"),
    "errors_below_stop_level": ("error/reference-last-block", "at stop level 1: bad_levels instead of samples"),
}

# Each way to break the protocol, and what comes of it.
ANSWERS = {
    "other_version": ("fail", "wrong answer to 'hello 1': \"0 ok 2 view block\""),
    "no_abilities": ("fail", "neither view nor block"),
    "banner": ("pass", ""),
    "endless_banner": ("fail", "wrong answer to 'hello 1': none in 64 KiB"),
    "endless_line": ("fail", "wrong answer to 'view 0 0': a line of more than"),
    "ends_at_once": ("error", "exit status 0 without an answer at 'hello 1'"),
    "cannot_run": ("skipped", "cannot run here: no board"),
    "crashes": ("error", "signal 11 (Segmentation fault) at 'block 0 0 0 0 0 0'"),
    "hangs": ("timeout", "s at 'view 0 0'"),
    "ends_within_an_answer": ("error", "exit status 3 without an answer at 'view 0 0'"),
    "says_it_twice": ("fail", "wrong answer to 'open "),
    "wrong_number": ("fail", "wrong answer to 'view 0 0': \"12 ok"),
    "garbage": ("fail", "wrong answer to 'block 0 0 0 0 0 0': \"Segfault? ?\", not"),
    "too_few_samples": ("fail", "60 characters instead of 16 samples"),
    "not_hexadecimal": ("fail", "\"x\" is not a hexadecimal digit"),
    "sample_too_wide": ("fail", "wrong answer to 'view 0 0': sample 0 is 256, not of 8 bits"),
    "other_shape": ("fail", "wrong answer to 'open': cols"),
    "decodes_at_open": ("pass", ""),  # but not on a stream in which blocks fail
    "crashes_once": ("error", "but passes as the first stream of a process"),
    "something_stays": ("fail", "but passes as the first stream of a process"),
}


def lines(fault):
    return f"lines: {sys.executable} -B {BROKEN} {fault}"


class Lines(ConformTest):
    def run_on(self, dut, *vectors, arguments=()):
        """The results of the vectors, which one process has one after the other."""
        filters = [word for vector in vectors for word in ("--filter", vector)]
        _, report = self.conform(dut, *filters, "--jobs", "1", *arguments, suite=SUITE)
        return [self.results(report)[vector] for vector in vectors]

    def test_wrong_blocks(self):
        for fault, (vector, reason) in BLOCKS.items():
            with self.subTest(fault=fault):
                self.assertEqual(self.run_on(lines("none"), vector)[0]["status"], "pass")
                (result,) = self.run_on(lines(fault), vector)
                self.assertEqual(result["status"], "fail", result)
                self.assertIn(reason, result["reason"])
                if "value" in reason:
                    self.assertRegex(result["stage"], r"^stage |agree in the decoder's trace")

    def test_answers(self):
        for fault, (status, reason) in ANSWERS.items():
            with self.subTest(fault=fault):
                limits = ("--timeout", "3") if status == "timeout" else ()
                first, last = self.run_on(lines(fault), SMALLEST, NEXT, arguments=limits)
                self.assertEqual(last["status"], status, last)
                self.assertIn(reason, last.get("reason", ""))
                if "first stream" in reason:  # a crash is one result
                    self.assertEqual(first["status"], "pass")

    def test_errors_of_blocks_at_open(self):
        """Whatever the error, it is one cause."""
        filters = [word for vector in ("error/sign-mode-3", "error/level-delta-28") for word in ("--filter", vector)]
        _, report = self.conform(lines("decodes_at_open"), *filters, suite=SUITE)
        causes = report["runs"][0]["begin"]["causes"]
        self.assertEqual([(c["cause"], len(c["vectors"])) for c in causes], [("refused at 'open' where only blocks fail", 2)])

    def test_failures_cost_few_processes(self):
        """Only some of many are run again in a new one."""
        starts = self.folder / "starts"
        dut = f"lines: sh -c 'echo >>{starts}; exec {sys.executable} -B {BROKEN} other_shape'"
        _, report = self.conform(dut, "--filter", "syntax/bise-*", "--jobs", "1", suite=SUITE)
        self.assertGreater(report["runs"][0]["counts"]["fail"], 20)
        self.assertEqual(len(starts.read_text()), 9)

    def test_session_of_the_document(self):
        """The example answers as docs/line_protocol.md shows."""
        text = (ROOT / "docs" / "line_protocol.md").read_text().replace("/suite/", f"{SUITE}/")
        session = text[text.index("0 hello 1") :].partition("```")[0].splitlines()
        command = [sys.executable, "-B", ROOT / "examples" / "line_decoder.py"]
        requests = "".join(line + "\n" for line in session[::2])
        done = subprocess.run(command, input=requests, stdout=subprocess.PIPE, text=True, check=True)
        self.assertEqual(done.stdout.splitlines(), session[1::2])
        self.assertGreater(len(session), 8)

    def test_naive_decoder(self):
        """The small suite; conform.model and conform.model-library run the whole one."""
        status, report = self.conform(SUITE / "duts" / "naive.json")
        self.assertEqual((status, report["runs"][0]["verdict"]), (0, "conforms"), report)
        self.assertEqual({result["status"] for result in self.results(report).values()}, {"pass"})

    def test_minimise(self):
        stream = SUITE / "boundary" / "view-3x5.hmlfc"
        self.hmlfc("minimise", stream, "--dut", lines("crashes"), "--trials", "5", "-o", "small.hmlfc")
        self.assertLess((self.folder / "small.hmlfc").stat().st_size, stream.stat().st_size)


if __name__ == "__main__":
    main()
