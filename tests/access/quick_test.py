#!/usr/bin/env python3
"""The small form of the access bench, and its error messages. quick_test.py HMLFC BENCH_ACCESS"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import find, main  # noqa: E402

BENCH = find("access", "numpy", "PIL", "hmlfc")
PROGRAMS = ["--hmlfc", sys.argv[1], "--bench", sys.argv[2]]
METHODS = ["extended", "main", "rlfc", "mc", "haar", "jpeg", *(["x265-inter"] if shutil.which("x265") else []), "vq"]
# Stands in for the reference software: keeps the views as they are.
PLENO = '#!/bin/sh\ncp "$1"/* "$3"/ && head -c 1000 /dev/zero > "$2"\n'


def bench(*arguments):
    command = [sys.executable, "-B", BENCH, "--quick", "--json", *PROGRAMS, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def hmlfc(*arguments):
    return subprocess.run([sys.argv[1], *arguments], capture_output=True, text=True, check=True).stdout


class QuickTest(unittest.TestCase):
    def test_access(self):
        done = bench("--methods", *METHODS)
        self.assertEqual(done.returncode, 0, done.stderr)
        field = json.loads(done.stdout)["light_fields"][0]
        self.assertEqual(list(field["methods"]), METHODS)
        for name, row in field["methods"].items():
            if name != "vq":
                self.assertGreaterEqual(row["psnr"], field["target"], name)
            for region, (cold, warm) in row["regions"].items():
                self.assertTrue(0 < cold["bytes"] <= row["bytes"], (name, region))
                if region != "frame":  # whose blocks move
                    self.assertLessEqual(warm["bytes"], cold["bytes"], (name, region))
                self.assertLessEqual(cold["held"], warm["held"], (name, region))
        read = {name: row["regions"]["block"] for name, row in field["methods"].items()}
        self.assertLess(read["haar"][0]["bytes"], read["extended"][0]["bytes"])
        self.assertLess(read["extended"][1]["bytes"], read["extended"][0]["bytes"])
        self.assertEqual(read["vq"][0]["bytes"], field["methods"]["vq"]["bytes"])
        self.assertEqual([read[name][1]["bytes"] for name in ("vq", "jpeg")], [0, 0])

    def test_all_views_read_the_whole_stream(self):
        """Nothing but the header is read at opening; the sizes of sections come from their table."""
        with tempfile.TemporaryDirectory() as folder:
            views, stream = f"{folder}/views", f"{folder}/stream"
            hmlfc("synth", "--scene", "glass", "--grid", "4x4", "--size", "64x64", "-o", views)
            everything = " ".join(f"{row} {col} 0 0 64 64" for row in range(4) for col in range(4))
            for profile in ("main", "extended"):
                hmlfc("encode", views, "-o", stream, "--profile", profile, "--chroma", "444")
                info = json.loads(hmlfc("info", stream, "--json"))
                done = subprocess.run([sys.argv[2], stream], input=everything, capture_output=True, text=True, check=True)
                cost = json.loads(done.stdout)["requests"][0]
                self.assertEqual(cost["bytes"], info["bytes"] - info["sections"]["header"])
                keys = sum(level["key_images"] for level in info["levels"])
                self.assertEqual(cost["held"], keys * 3 * 64 * 64 * 2)

    def test_pleno(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "pleno"
            program.write_text(PLENO)
            program.chmod(0o755)
            done = bench("--methods", "pleno", "--pleno", program)
            self.assertEqual(done.returncode, 0, done.stderr)
            row = json.loads(done.stdout)["light_fields"][0]["methods"]["pleno"]
            self.assertEqual((row["bytes"], row["psnr"]), (1000, float("inf")))
            program.write_text("#!/bin/sh\n")
            for arguments in (("--pleno", program), ("--pleno", f"{program}s"), ()):
                done = bench("--methods", "pleno", *arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn("pleno", done.stderr.splitlines()[-1])


if __name__ == "__main__":
    main()
