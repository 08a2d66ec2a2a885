#!/usr/bin/env python3
"""The small form of a report: it runs, its figures are possible and say of each other what they must.
report_test.py NAME BUILD"""

import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from bench import ROOT, find, main

NAME, BUILD = sys.argv[1:3]
find(BUILD, NAME)

METHODS = ("extended", "main", "rlfc", "mc", "haar", "jpeg", "vq")  # of access: those that need no package of their own
ARGUMENTS = {"access": ("--methods", *METHODS)}


class ReportTest(unittest.TestCase):
    """One run measures, all tests look at it."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        done = cls.run_bench("--quick", "--record", "--json", *ARGUMENTS.get(NAME, ()))
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        cls.results = json.loads(done.stdout)

    @classmethod
    def run_bench(cls, *options):
        command = [sys.executable, "-B", ROOT / "bench" / NAME, "-o", cls.folder, "--recorded", cls.folder / "recorded.json"]
        return subprocess.run([*command, *options], capture_output=True, text=True, check=False,
                              env={**os.environ, "HMLFC_BUILD": BUILD})

    def test_the_page_is_made_of_the_record(self):
        made = ("--results", self.folder / "docs" / "results")
        (self.folder / "docs").mkdir()
        for options, status in ((("--check",), 1), (("--update",), 0), (("--check",), 0)):
            done = self.run_bench(*options, *made)
            self.assertEqual(done.returncode, status, done.stderr)
        recorded = self.folder / "recorded.json"
        recorded.write_text(re.sub(r'bytes": (\d)', r'bytes": 1\1', recorded.read_text()))
        self.assertEqual(self.run_bench("--check", *made).returncode, 1)

    def test_figures(self):
        getattr(self, NAME)()

    def rows(self, group, **wanted):
        return [row for row in self.results[group] if all(row[name] == value for name, value in wanted.items())]

    def falls(self, numbers):
        self.assertTrue(all(a >= b for a, b in itertools.pairwise(numbers)), numbers)

    def accuracy(self):
        from studies import METHODS, QUICK, extended, label, main as main_profile

        encodings = {(row["light_field"], row["coding"]): row for row in self.results["encodings"]}
        for row in encodings.values():
            self.assertLess(sum(row[f"{part}_bytes"] for part in ("index", "motion", "residual", "top")), row["bytes"])
            self.assertTrue(0 < row["ssim_y"] <= 1 and row["encode_cpu_seconds"] > 0 and row["decode_cpu_seconds"] > 0)
            self.assertGreater(row["decode_peak_bytes"], row["bytes"])
        for field in ("synth-cards", "synth-noise"):
            of = lambda codings, field=field: [encodings[field, label(coding)] for coding in codings]
            for method in METHODS:
                curve = of([main_profile(method, threshold=t) for t in QUICK["threshold"]])
                self.falls([row["bytes"] for row in curve])
                self.falls([row["psnr_rgb"] for row in curve])
                self.assertEqual(method == "hmlfc", any(row["reference_bytes"] for row in curve))
            for preset in QUICK["preset"]:
                curve = of([extended(preset=preset, quality=q) for q in QUICK["quality"][::-1]])
                for name in ("bytes", "psnr_rgb", "ssim_y"):
                    self.falls([row[name] for row in curve])
        for row in self.results["frames"]:
            quadrilinear = row["frame"].startswith("quadrilinear")
            self.assertEqual(row["mse_filter"] == 0, quadrilinear)
            self.assertLess(row["mse_fixed"], 1)
            if quadrilinear:
                self.assertLessEqual(row["largest_fixed"], row["bound_fixed"])
        for levels, coding in ((4, main_profile()), (1, extended())):
            by = {row["frame"]: row for row in self.rows("frames", light_field="synth-cards", coding=label(coding))}
            self.falls([by[f"quadrilinear:{level}:256"]["mse_total"] for level in range(1, levels + 1)])
            self.assertGreater(*(by[f"quadrilinear:{levels}:{cache}"]["blocks_decoded"] for cache in (0, 256)))
        self.assertGreater(len(list(self.folder.glob("*.png"))), 2)

    def skipping(self):
        for row in self.results["paths"]:
            self.assertTrue(0 < min(row["needed"]) and max(row["needed"]) < row["blocks"])
            self.assertLessEqual(max(row["bytes"]), row["file_bytes"])
            if row["path"] == "dolly" and row["client"] == "warm":
                self.assertGreater(sum(row["reused"]), 0)
        zero = lambda scene: max(sum(row["zero"]) / sum(row["needed"]) for row in self.rows("paths", scene=scene))
        self.assertGreater(zero("flat"), zero("cards"))
        small, large = self.rows("costs", by="file size")
        self.assertGreater(large["file_bytes"], 1 << 32)
        self.assertLess(large["disk_bytes"], 1 << 20)
        for name in ("block_bytes", "block_key_bytes", "block_requests", "view_bytes", "view_key_bytes", "view_requests"):
            self.assertEqual(small[name], large[name])
        for row in self.results["costs"]:
            self.assertLessEqual(row["block_walks"], 5 * 3 + 1)  # BND-2, tree of height 3
        flat, noise, _ = self.results["effort"]
        self.assertLess(2 * flat["cpu_seconds"], noise["cpu_seconds"])

    def access(self):
        sizes = {}
        for row in self.results["rates"]:
            sizes[row["method"]] = row["bytes"]
            if row["method"] != "vq":
                self.assertGreaterEqual(row["psnr_rgb"], row["target"], row)
        self.assertEqual(tuple(sizes), METHODS)
        for row in self.results["costs"]:
            self.assertTrue(0 < row["cold_bytes"] <= sizes[row["method"]], row)
            self.assertLessEqual(row["cold_held"], row["warm_held"], row)
        read = {row["method"]: row for row in self.rows("costs", region="block")}
        self.assertLess(read["haar"]["cold_bytes"], read["extended"]["cold_bytes"])
        self.assertLess(read["extended"]["warm_bytes"], read["extended"]["cold_bytes"])
        self.assertEqual(read["vq"]["cold_bytes"], sizes["vq"])
        self.assertEqual([read[name]["warm_bytes"] for name in ("vq", "jpeg")], [0, 0])

    def geometry(self):
        for row in self.results["depth"][:2]:  # of profile extended
            self.assertEqual(row["known"], 1)
            self.assertLess(row["bad"], row["plane_bad"])
            self.assertLess(row["mse"], row["plane_mse"])
        (row,) = self.results["withheld"]
        self.assertEqual(row["views"], 12)
        self.assertGreater(row["geometry"], row["plane"] + 1)


if __name__ == "__main__":
    main()
