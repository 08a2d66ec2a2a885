#!/usr/bin/env python3
"""Short numerical stress: stress_test.py PROGRAMS_FOLDER."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from reached import Reached

FOLDER = Path(__file__).resolve().parent
VECTORS = FOLDER.parents[1] / "vectors"
WIDTHS = sorted(VECTORS.glob("boundary/widths-*.hmlfc"))
PROGRAMS = None


class Streams(unittest.TestCase):
    def run_program(self, *arguments, program="stress_streams"):
        with tempfile.TemporaryDirectory() as folder:
            command = [PROGRAMS / program]
            if program == "stress_streams":
                command += ["--folder", folder]
            result = subprocess.run([*command, *arguments], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout[-2000:] + result.stderr[-2000:])
        return json.loads(result.stdout)


class ExtremesTest(Streams):
    def test_intervals_are_reached_at_both_ends_and_not_left(self):
        reached = Reached()
        for command in (["files", *WIDTHS], ["geometry"]):
            report = self.run_program(*command)
            self.assertEqual(report["findings"], [])
            reached.add(report["rows"])
        self.assertEqual([row["quantity"] for row in reached.gaps()], [])

    def test_odd_streams_stay_within(self):
        odd = sorted(VECTORS.glob("stress/odd-*.hmlfc"))
        self.assertGreater(len(odd), 10)
        report = self.run_program("files", *odd)
        self.assertEqual(report["streams"], len(odd))
        self.assertEqual(report["findings"], [])

    def test_random_streams_stay_within(self):
        report = self.run_program("random", "--seed", "1", "--count", "40")
        self.assertEqual(report["streams"], 40)
        self.assertGreater(report["blocks"], 1000)


class CamerasTest(Streams):
    def test_intervals_of_frames_are_reached_except_where_no_frame_can(self):
        report = self.run_program("--count", "0", program="stress_cameras")
        self.assertEqual(report["findings"], [])
        reached = Reached()
        reached.add(report["rows"])
        gaps = {row["quantity"]: row for row in reached.gaps()}
        self.assertEqual(list(gaps), ["n * w", "wr, wc", "weight of a view"])
        for least, proved in zip(gaps["n * w"]["reached"], gaps["n * w"]["proved"]):
            self.assertLess(abs(proved - least), 715983262)  # one more n would leave the interval
        self.assertEqual(gaps["wr, wc"]["reached"], [1, 256])
        self.assertEqual(gaps["weight of a view"]["reached"], [1, 65536])

    def test_cameras_give_frames_or_errors(self):
        report = self.run_program("--count", "10000", program="stress_cameras")
        self.assertEqual(report["findings"], [])
        self.assertGreater(report["frames"], 5000)


if __name__ == "__main__":
    PROGRAMS = Path(sys.argv.pop(1)).resolve()
    unittest.main()
