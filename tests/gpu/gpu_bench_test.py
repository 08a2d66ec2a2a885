#!/usr/bin/env python3
"""The bench of a GPU on a small stream, and what it refuses. gpu_bench_test.py HMLFC BENCH_GPU VECTORS"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

HMLFC, BENCH, VECTORS = sys.argv[1:4]
SKIPPED = 77
DEVICE = os.environ.get("HMLFC_GPU_DEVICE", "")
QUICK = ["--side", "48", "--side", "64", "--frames", "6", "--seconds", "0.05"]
KERNELS = {"mark", "compact", "walk", "samples", "render"}


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


def bench(*arguments, device=DEVICE):
    return run(BENCH, *QUICK, "--device", device, *arguments)


class GpuBenchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        views, cls.stream = f"{cls.folder.name}/views", f"{cls.folder.name}/stream.hmlfc"
        for arguments in (["synth", "--scene", "knights", "--grid", "3x3", "--size", "64x48", "-o", views],
                          ["encode", views, "-o", cls.stream]):  # fmt: skip
            done = run(HMLFC, *arguments)
            assert done.returncode == 0, done.stderr

    def check_frames(self, path):
        kernels = KERNELS | ({"surface"} if path["geometry"] else set())
        for held in ("cold", "moving", "warm"):
            row = path[held]
            self.assertGreater(row["frames"], 1)
            self.assertGreater(row["frames_a_second"], 0)
            self.assertGreater(row["frames_a_second_99"], 0)
            self.assertEqual(set(row["stage_ms"]) & {*KERNELS, "surface"}, kernels, held)
            self.assertGreater(row["blocks_needed"], 0)
        self.assertEqual(path["cold"]["blocks_decoded"], path["cold"]["blocks_needed"])
        self.assertTrue(0 < path["moving"]["blocks_decoded"] < path["moving"]["blocks_needed"])
        self.assertEqual(path["warm"]["blocks_decoded"], 0)
        self.assertGreaterEqual(path["views_a_pixel"], 3.5)
        self.assertTrue(path["host_us"] > 0 and path["recorded_host_us"] > 0)

    def test_figures(self):
        done = bench(self.stream, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertTrue(report["device"] and report["driver"])
        self.assertEqual("say nothing" in report.get("note", ""), report["kind"] == "CPU")
        (stream,) = report["streams"]
        self.assertGreater(stream["decode"]["gigapixels_a_second_to_host"], 0)
        self.assertEqual(list(stream["decode"]["stage_ms"]), ["expand", "walk", "samples", "colour"])
        sizes = [(path["side"], path["geometry"]) for path in stream["paths"]]
        self.assertEqual(sizes, [(48, False), (48, True), (64, False), (64, True)])
        for path in stream["paths"]:
            self.check_frames(path)

    def test_tables(self):
        done = bench(self.stream, self.stream)
        self.assertEqual(done.returncode, 0, done.stderr)
        for text, count in (("goal 10000 frames/s", 1), ("paper 160", 1), ("| 64x64, geometry     | warm ", 2), ("Gpixel/s on", 2)):
            self.assertEqual(done.stdout.count(text), count, done.stdout)

    def test_refuses(self):
        for arguments, reason in (
            ([f"{VECTORS}/manifest.json"], "bad_magic"),
            ([f"{VECTORS}/error/bias-bits-11.hmlfc"], "does not decode"),
            ([self.stream, "--side", "0"], "--side"),
        ):
            done = bench(*arguments)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(reason, done.stdout + done.stderr)
        done = bench(self.stream, device="no such device")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn('no Vulkan device "no such device"', done.stderr)


def main():
    if "Vulkan" in (missing := bench(f"{VECTORS}/manifest.json").stderr):
        print(missing)
        return SKIPPED
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    return 0 if result.wasSuccessful() and result.testsRun else 1


if __name__ == "__main__":
    sys.exit(main())
