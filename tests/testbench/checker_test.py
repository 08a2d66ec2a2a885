#!/usr/bin/env python3
"""checker_test.py CMAKE BUILD LIBDIR: hmlfc_checker.sv from an installed copy, on its stand-in decoder.

Every planted fault is caught and named, a decoder without faults passes, with the same stream and with bad ones; what a
capability file rules out is skipped, and a wrong one says what to do. Exit 77: Verilator is not installed.
"""

import ctypes
import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VECTORS = ROOT / "vectors"
STREAM = VECTORS / "real" / "cards-main.hmlfc"
CMAKE, BUILD, LIBDIR = sys.argv[1:4]
WORK = Path(BUILD).resolve() / "tests" / "testbench" / "checker"
PREFIX = WORK / "prefix"
LIB = PREFIX / LIBDIR
SHARE = PREFIX / "share" / "hmlfc" / "checker"
SOURCES = [SHARE / name for name in ("example_bench.sv", "stand_in_decoder.sv", "hmlfc_checker.sv")]
VIEW = ["+row=1", "+col=2", "+blocks_x=10", "+blocks_y=8"]  # a view of STREAM
REQUESTS = 80 + 20 + 20 + 1  # RGB, Co, level 1, one that does not exist


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          timeout=240, check=False, **options)
    return done.returncode, done.stdout


def must(*command, **options):
    code, text = run(*command, **options)
    assert code == 0, f"{command}: exit status {code}\n{text}"
    return text


def build(name, tagged):
    """The bench's command."""
    folder = WORK / name
    folder.mkdir()
    link = f"-L{LIB} -lhmlfc_dpi -Wl,-rpath,{LIB}"
    must("verilator", "--binary", "--trace", "-Wall", "-Mdir", folder, f"-GTAGGED=1'b{tagged}", "-CFLAGS", "-O0",
         "-LDFLAGS", link, "--top-module", "example_bench", *SOURCES)
    return [folder / "Vexample_bench"]


def inspected(view, plane, block):
    return json.loads(must(PREFIX / "bin" / "hmlfc", "inspect", STREAM, "--view", view, "--plane", plane, "--block", block, "--json"))


class CheckerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        must(CMAKE, "--install", BUILD, "--prefix", PREFIX)
        cls.bench = build("in_order", 0)
        cls.tagged = build("tagged", 1)

    def check(self, *plusargs, passes, stream=STREAM, device=SHARE / "stand_in.device", bench=None, view=VIEW):
        """What a run prints."""
        code, text = run(*(bench or self.bench), f"+hmlfc_checker_stream={stream}", f"+hmlfc_checker_device={device}", *view, *plusargs,
                         cwd=WORK)
        self.assertEqual(code == 0, passes, text)
        return text

    def device(self, **changes):
        """The stand-in's capability file with other members; None removes one."""
        members = json.loads((SHARE / "stand_in.device").read_text()) | changes
        path = WORK / "changed.device"
        path.write_text(json.dumps({name: value for name, value in members.items() if value is not None}))
        return path

    def count(self, text, pattern):
        found = re.search(pattern, text)
        self.assertTrue(found, text)
        return int(found[1])

    def test_equal(self):
        text = self.check(passes=True)
        self.assertIn(f"passed: {REQUESTS} answers are the model's", text)
        self.assertEqual(self.count(text, r"status 25  (\d+)  bad_request"), 1)
        self.assertEqual(self.count(text, r"stage records +(\d+), compared 20"), 20)

    def test_faults(self):
        cases = {
            ("sample", 33): ("answer: sample", "request    33: view 1,2 plane RGB block 3,3", "lane 1, G (COL-2, COL-3), x 2, y 0"),
            ("status", 33): ("answer: status", "expected   status 0 (ok)", "actual     status 24 (limit_exceeded)"),
            ("swap", 33): ("answer: order", "request    33:", "answer to request 34: answers changed places, or one is missing"),
            ("missing", 33): ("answer: order", "request    33:", "answer to request 34: answers changed places, or one is missing"),
            ("extra", 33): ("answer: order", "request    34:", "answer to request 33 once more"),
            ("missing", REQUESTS - 1): ("answer: missing", f"request    {REQUESTS - 1}:", "1 without an answer"),
            ("extra", REQUESTS - 1): ("answer: extra", "no request is in flight", "status 25 (bad_request)"),
            ("stage", 85): ("stage: sample", "level 0 image 1,2 plane Co block 0,1, stage sample (DEC-3), x 0, y 0", "hmlfc inspect"),
        }
        for (fault, at), (rule, *parts) in cases.items():
            with self.subTest(fault=fault, at=at):
                text = self.check(f"+fault={fault}", f"+fault_at={at}", passes=False)
                self.assertEqual(re.findall(r"difference \d+ at clock \d+: (.*)", text), [rule], text)
                for part in parts:
                    self.assertIn(part, text)
                self.assertIn("FAILED: 1 differences", text)

    def test_values(self):
        text = self.check("+fault=stage", "+fault_at=85", passes=False)
        level = inspected("1,2", "Co", "0,1")["levels"][-1]
        value = level["stages"]["sample"]["values"][0][0]
        self.assertEqual(self.count(text, r"expected +(-?\d+)\n"), value)
        self.assertEqual(self.count(text, r"actual +(-?\d+)\n"), value ^ 1)

    def test_continue(self):
        text = self.check("+fault=sample", "+fault_at=33", "+hmlfc_checker_continue", passes=False)
        self.assertEqual(self.count(text, r"answers +(\d+), compared"), REQUESTS)
        self.assertIn("difference        1  answer: sample", text)

    def test_wave(self):
        text = self.check("+fault=sample", "+fault_at=33", passes=False)
        plusargs = re.search(r"run again with (.*)", text)[1].split()
        first, last = (int(word.split("=")[1]) for word in plusargs[1:])
        self.assertIn("difference 1 at clock", self.check("+fault=sample", "+fault_at=33", *plusargs, passes=False))
        times = [int(time) for time in re.findall(r"(?m)^#(\d+)$", (WORK / "hmlfc_checker.vcd").read_text())]
        self.assertEqual((min(times), max(times)), (first * 10 + 5, last * 10 + 5))

    def test_tags(self):
        device = self.device(tagged=True)
        text = self.check(passes=True, device=device, bench=self.tagged)
        self.assertIn(f"passed: {REQUESTS} answers", text)
        self.assertIn(": answer: order", self.check(passes=False, bench=self.tagged))
        text = self.check("+fault=extra", f"+fault_at={REQUESTS - 1}", passes=False, device=device, bench=self.tagged)
        self.assertIn("no answer: no request with tag", text)

    def test_bad_streams(self):
        text = self.check(passes=True, stream=VECTORS / "error" / "field-depth-13.hmlfc")
        self.assertIn("is refused: every request must be answered with status", text)
        text = self.check(passes=True, stream=VECTORS / "error" / "reference-block.hmlfc", view=[])
        self.assertGreater(self.count(text, r"(\d+)  bad_levels"), 0)

    def test_skipped(self):
        text = self.check(passes=True, device=self.device(rgb=False, stop_levels=False))
        self.assertIn("80  requests for RGB (rgb false)", text)
        self.assertIn("20  stop levels (stop_levels false)", text)
        self.assertEqual(self.count(text, r"compared (\d+)\n"), REQUESTS - 100)
        text = self.check(passes=True, device=self.device(stages=[], every_stage=None))
        self.assertIn("20  stage records (no stages)", text)
        for limits, reason in (({"width": 39}, "width 40, above 39"), ({"block_log2": [2]}, None)):
            text = self.check(passes=reason is None, device=self.device(limits=limits))
            self.assertIn("nothing was compared" if reason else "passed", text)
            self.assertIn(reason or "", text)
        text = self.check(passes=False, stream=VECTORS / "real" / "knights-extended.hmlfc", device=self.device(profile="main"))
        self.assertIn("is compared: profile extended", text)

    def test_bus_errors(self):
        self.assertIn(": answer: status", self.check("+fault=bus", "+fault_at=33", passes=False))
        text = self.check("+fault=bus", "+fault_at=33", passes=True, device=self.device(bus_errors=True))
        self.assertIn("1  answers of bus_error (bus_errors true)", text)
        self.assertIn(f"compared {REQUESTS - 1}\n", text)

    def test_reset(self):
        library = ctypes.CDLL(str(LIB / "libhmlfc_dpi.so"))
        library.hmlfc_checker_text.restype = ctypes.c_char_p
        checker = library.hmlfc_checker_open(str(STREAM).encode(), str(SHARE / "stand_in.device").encode(), 2)
        for clock in range(3):
            library.hmlfc_checker_request(checker, ctypes.c_longlong(clock), 0, 0, 3, clock, 0, 0, 0)
        library.hmlfc_checker_reset(checker, ctypes.c_longlong(3))
        self.assertEqual(library.hmlfc_checker_end(checker, ctypes.c_longlong(4), 1), -1)
        text = library.hmlfc_checker_text(checker).decode()
        self.assertIn("dropped by reset  3\n", text)
        self.assertIn("FAILED: nothing was compared", text)

    def test_wrong_capability_files(self):
        for changes, message in (
            ({"hight": 5}, 'has the unknown key "hight"'),
            ({"rgb": "maybe"}, '"rgb" is missing, of the wrong kind'),
            ({"level": 4}, '"level" is not an integer in [0, 3]'),
            ({"limits": {"block_log2": [1, 3]}}, '"block_log2" lacks 2'),
            ({"stages": ["samples"]}, '"samples" is none of residual, reference, prediction, sample'),
            ({"profile": None}, '"profile" is missing'),
        ):
            with self.subTest(changes=changes):
                device = self.device(**changes)
                text = self.check(passes=False, device=device)
                self.assertIn(f"{device}: ", text)
                self.assertIn(message, text)
        self.assertIn("+hmlfc_checker_device=FILE", self.check(passes=False, device="none"))
        self.assertIn("+hmlfc_checker_stream=FILE", self.check(passes=False, stream="none"))


if __name__ == "__main__":
    if shutil.which("verilator") is None:
        sys.exit(77)
    unittest.main(argv=[sys.argv[0]])
