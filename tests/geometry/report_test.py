#!/usr/bin/env python3
"""The depth report: its measures on maps made by hand, and its small form: report_test.py PROGRAM."""

import json
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import find, main  # noqa: E402  (here and below: found only now)

BENCH = find("geometry", "numpy", "PIL", "hmlfc")

import numpy as np  # noqa: E402
from depth import measures, read_pfm  # noqa: E402
from process import BenchError  # noqa: E402
from withheld import stated_places  # noqa: E402

PROGRAM = Path(sys.argv.pop(1)).resolve()


class Measures(unittest.TestCase):
    def test_known_errors(self):
        truth = np.zeros((40, 50))
        found = truth.copy()
        found[:15] = 9  # the border does not count
        found[20, 20:25] = 0.5
        found[21, 20:25] = -0.07
        # 5 of 10 x 20 pixels are off; the squares are 5 * 0.25 and 5 * 0.0049.
        result = measures(found, truth)
        self.assertAlmostEqual(result["bad"], 2.5)
        self.assertAlmostEqual(result["mse"], 100 * (1.25 + 0.0245) / 200)
        with self.assertRaises(BenchError):
            measures(found, truth[1:])

    def test_pfm(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "map.pfm"
            for order, scale in (("<", b"-1.0"), (">", b"1")):
                path.write_bytes(b"Pf\n2 2\n" + scale + b"\n" + struct.pack(f"{order}4f", 3, 4, 1, 2))
                self.assertEqual(read_pfm(path).tolist(), [[1, 2], [3, 4]])
            for content in (b"PF\n2 2\n-1.0\n" + bytes(48), b"Pf\n2 2\n-1.0\n" + bytes(15), b""):
                path.write_bytes(content)
                with self.assertRaises(BenchError):
                    read_pfm(path)


class StatedPlaces(unittest.TestCase):
    def test_names_of_the_stanford_archive(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(stated_places(Path(folder)), {})
            for row, y in ((0, -5), (1, -7.5)):
                for col, x in ((0, 30), (1, 20), (2, 4)):  # y and x fall; the steps of x are 10 and 16
                    (Path(folder) / f"out_{row:02}_{col:02}_{y:.6f}_{x:.6f}.jpg").touch()
            (Path(folder) / "rig.json").touch()
            places = stated_places(Path(folder))
        # Of columns: mean x is 18; the sum of (x - 18) * (col - 1) is -26, that of (x - 18)^2 is 344.
        self.assertEqual(sorted(places), [(row, col) for row in (0, 1) for col in (0, 1, 2)])
        for (row, col), place in places.items():
            for found, known in zip(place, (row, 1 - 26 / 344 * ((30, 20, 4)[col] - 18))):
                self.assertAlmostEqual(found, known)


class Report(unittest.TestCase):
    def test_quick(self):
        command = [sys.executable, "-B", BENCH, "--quick", "--json", "--program", PROGRAM]
        report = json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)
        rows = report["depth"]
        self.assertEqual(len(rows), 3)
        for row in rows[:2]:
            self.assertEqual(row["known"], 1)
            self.assertLess(row["bad"], row["without"]["bad"])
            self.assertLess(row["mse"], row["without"]["mse"])
        self.assertEqual([row["views"] for row in report["withheld"]], [12])
        self.assertGreater(report["withheld"][0]["geometry"], report["withheld"][0]["plane"] + 1)

    def test_a_recorded_figure_that_differs_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            recorded = Path(folder) / "recorded.json"
            recorded.write_text((BENCH / "recorded.json").read_text().replace('"bad": ', '"bad": 1', 1))
            check = [sys.executable, "-B", BENCH, "--check", "--recorded", recorded]
            self.assertEqual(subprocess.run(check, capture_output=True, check=False).returncode, 1)


if __name__ == "__main__":
    main()
