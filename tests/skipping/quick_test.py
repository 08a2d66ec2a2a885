#!/usr/bin/env python3
"""The small form of the skipping report. quick_test.py HMLFC BENCH_SKIPPING BENCH_SKIPPING_EXHAUSTIVE"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import find, main  # noqa: E402  (here and below: found only now)

BENCH = find("skipping", "numpy", "PIL", "matplotlib")

PROGRAMS = sys.argv[1:4]


class QuickTest(unittest.TestCase):
    """One run measures, all tests look at it."""

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-B", BENCH, "--quick", "--json", "-o", folder]
            command += ["--programs", *PROGRAMS]
            result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        cls.results = json.loads(result.stdout)

    def test_zero_blocks_follow_content(self):
        share = {
            scene: max(zero / needed for p in self.paths(scene)
                       for zero, needed in zip(p["frames"]["zero"], p["frames"]["needed"]))
            for scene in ("flat", "cards")
        }
        self.assertGreater(share["flat"], share["cards"])

    def test_frames_need_a_part_of_all_blocks(self):
        for scene in ("flat", "cards"):
            for path in self.paths(scene):
                self.assertGreater(min(path["frames"]["needed"]), 0)
                self.assertLess(max(path["frames"]["needed"]), path["blocks"])
                self.assertLessEqual(max(path["frames"]["bytes"]), path["file_bytes"])

    def test_warm_renderers_decode_less(self):
        for path in self.paths("cards"):
            if path["path"] == "dolly" and path["client"] == "warm":
                self.assertGreater(sum(path["frames"]["reused"]), 0)

    def test_file_size_does_not_matter(self):
        costs = [c for c in self.results["costs"] if c["by"] == "file size"]
        small, large = costs[0], costs[-1]
        self.assertGreater(large["file_bytes"], 1 << 32)
        self.assertLess(large["disk_bytes"], 1 << 20)
        for request in ("block", "view"):
            for key in ("bytes", "key_bytes", "requests"):
                self.assertEqual(small[request][key], large[request][key])

    def test_walks_are_bounded(self):
        for cost in self.results["costs"]:
            self.assertLessEqual(cost["block"]["walks"], 5 * 3 + 1)  # BND-2, tree of height 3

    def test_flat_encodes_faster_than_noise(self):
        cpu = {row["scene"]: row["cpu_seconds"] for row in self.results["effort"]}
        self.assertLess(2 * cpu["flat"], cpu["noise"])

    def paths(self, scene):
        return [p for p in self.results["paths"] if p["scene"] == scene]


if __name__ == "__main__":
    main()
