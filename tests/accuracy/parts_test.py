#!/usr/bin/env python3
"""The parts of the accuracy bench that measure nothing: fronts, comparison, store, files, tables."""

import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import find, main  # noqa: E402  (here and below: found only now)

BENCH = find("accuracy", "numpy", "PIL", "skimage", "matplotlib", "hmlfc")

import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

import coding  # noqa: E402
import prediction  # noqa: E402
from comparison import compare  # noqa: E402
from process import BenchError, run_measured  # noqa: E402
from results import Point, Results, on_front, read_json, write_csv, write_json  # noqa: E402
from store import Store  # noqa: E402
from tables import Tables  # noqa: E402

SCENE = {"rows": 2, "cols": 2, "width": 8, "height": 8, "chroma": "444", "at": 36.0}
SECTIONS = {"sections.index": 10, "sections.motion": 20, "sections.residual": 50, "sections.top": 20}


def encoding(threshold=75, calibration=0.1, **changes):
    values = {
        "bytes": 100, "bpp": 3.125, "psnr_rgb": 36.5, "psnr_y": 38.0, "ssim_y": 0.95,
        "max_abs_error": 9, **SECTIONS, "encode_cpu_seconds": 2.0,
        "encode_peak_bytes": 1 << 24, "decode_cpu_seconds": 0.5,
        "decode_peak_bytes": 1 << 23, "reference_bytes": 4096, **changes,
    }
    made = coding.main("444", threshold=threshold)
    return Point("scene", made, None, calibration, values)


def results(*points):
    return Results("machine", {"scene": SCENE}, points)


class FrontsTest(unittest.TestCase):
    def test_points_that_others_beat_are_off_the_front(self):
        costs = [(1, 5), (2, 4), (2, 5), (3, 3), (3, 4), (1, 5)]
        self.assertEqual(on_front(costs), [True, True, False, True, False, True])


class ComparisonTest(unittest.TestCase):
    def changes(self, old, new):
        found, compared = compare(results(old), results(new))
        self.assertEqual(compared, 1)
        return {change.value: change.worse for change in found}

    def test_changes_beyond_noise_are_found_and_judged(self):
        for what, new, expected in (
            ("the same", encoding(), {}),
            ("one byte more", encoding(bytes=101), {"bytes": True}),
            ("less error", encoding(psnr_rgb=36.51, max_abs_error=8), {"psnr_rgb": False, "max_abs_error": False}),
            ("time within noise", encoding(encode_cpu_seconds=2.4), {}),
            ("time beyond noise", encoding(encode_cpu_seconds=3.0), {"encode_cpu_seconds": True}),
            ("a slower machine", encoding(calibration=0.2, encode_cpu_seconds=4.0, decode_cpu_seconds=1.0), {}),
        ):
            with self.subTest(what):
                self.assertEqual(self.changes(encoding(), new), expected)
        lossless = encoding(psnr_rgb="inf")
        self.assertEqual(self.changes(lossless, lossless), {})

    def test_a_point_that_was_not_recorded_is_not_compared(self):
        self.assertEqual(compare(results(encoding(50)), results(encoding(75))), ([], 0))


class StoreTest(unittest.TestCase):
    def test_a_point_is_kept_as_soon_as_it_is_added(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "measured.json"
            Store(path).add("a", {"value": 1})
            Store(path).add("b", {"value": 2})
            self.assertEqual(Store(path).get("a"), {"value": 1})
            self.assertIsNone(Store(path).get("c"))
            self.assertEqual([file.name for file in Path(folder).iterdir()], [path.name])


class FilesTest(unittest.TestCase):
    def test_results_come_back_as_they_were(self):
        frame = encoding()
        frame.frame, frame.values = "nearest:4:256:cpu", {"mse.total": 2.5}
        lossless = Point("scene", coding.lossless(), None, 0.1, encoding(psnr_rgb="inf").values)
        whole = results(encoding(), lossless, frame)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "points.json"
            write_json(whole, path)
            back = read_json(path)
            self.assertEqual(back.points, whole.points)
            self.assertEqual(back.scenes, whole.scenes)
            write_csv(results(encoding(), lossless), Path(folder) / "points.csv")
            rows = (Path(folder) / "points.csv").read_text().splitlines()
            self.assertEqual(len(rows), 3)
            self.assertIn("sections.index", rows[0])

    def test_no_file_is_an_empty_run(self):
        self.assertEqual(read_json(Path("nowhere.json")).points, {})


class TablesTest(unittest.TestCase):
    def test_an_error_of_one_step_is_48_db(self):
        frame = encoding()
        frame.frame = "quadrilinear:4:256:cpu"
        frame.values = {
            "cpu_ms.median": 1.0, "cpu_ms.p95": 2.0, "blocks_needed": 10, "blocks_decoded": 5,
            "mse.total": 1.0, "mse.stream": 1.0, "mse.filter": 0.0, "mse.fixed": 0.25,
            "largest_fixed": 0.5, "bound_fixed": 3.2,
        }
        row = Tables(results(frame), quick=False).make("renderer")[-1]
        self.assertIn("| -, -, 48.13 | -, -, -, 48.13 | 48.13 | -, - | 54.15 | 0.50 (3.20) |", row)

    def test_rows_are_interpolated_at_one_psnr(self):
        low = encoding(150, psnr_rgb=34.0, bpp=1.0)
        high = encoding(50, psnr_rgb=38.0, bpp=4.0)
        row = Tables(results(low, high), quick=False).make("methods")[2]
        self.assertEqual(row, "| scene | 36 | - | 2.000 | - | - | - | - |")


class PredictionTest(unittest.TestCase):
    def error(self, x_from):
        """Of a picture against itself with one block taken from another place."""
        picture = np.random.default_rng(7).integers(0, 256, (64, 64)).astype(np.float64)
        moved = picture.copy()
        moved[32:36, 32:36] = picture[25:29, x_from : x_from + 4]
        return prediction.compensated_error(picture, moved)

    def test_a_block_is_found_within_the_window_alone(self):
        self.assertEqual(self.error(x_from=32 - prediction.WINDOW), 0)
        self.assertGreater(self.error(x_from=32 - prediction.WINDOW - 1), 0)

    def test_means_of_a_grid_whose_rows_differ(self):
        with tempfile.TemporaryDirectory() as folder:
            for row in range(4):
                for col in range(4):
                    picture = np.full((8, 8, 3), 100 + 10 * row, np.uint8)
                    Image.fromarray(picture).save(Path(folder) / f"{row:02d}_{col:02d}.png")
            measured = prediction.measure(folder)
        # Means of two rows are 5 away from each; those of four, 15, 5, 5 and 15: of the views
        # measured, three are in row 0, two in row 1 and three in row 3.
        self.assertAlmostEqual(measured["mean_2"], 10 * math.log10(255**2 / 25))
        mean_4 = (6 * 15**2 + 2 * 5**2) / 8
        self.assertAlmostEqual(measured["mean_4"], 10 * math.log10(255**2 / mean_4))


class ProcessTest(unittest.TestCase):
    def test_peak_memory_is_the_childs_own(self):
        held = bytearray(200 << 20)
        said, cost = run_measured([sys.executable, "-S", "-c", "print(len(bytearray(60 << 20)))"])
        self.assertEqual(int(said), 60 << 20)
        self.assertGreater(cost.peak_bytes, 60 << 20)
        self.assertLess(cost.peak_bytes, 150 << 20)
        self.assertGreater(cost.cpu_seconds, 0)
        self.assertTrue(math.isfinite(cost.cpu_seconds))
        del held

    def test_a_program_that_fails_says_why(self):
        with self.assertRaisesRegex(BenchError, "no room"):
            run_measured(["sh", "-c", "echo no room >&2; exit 3"])
        with self.assertRaisesRegex(BenchError, "does not start"):
            run_measured(["a-program-that-is-not-there"])


if __name__ == "__main__":
    main()
