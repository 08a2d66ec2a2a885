#!/usr/bin/env python3
"""Parts of the benches whose mistakes no figure shows: codecs of their own, counting, comparison with a recorded run.
parts_test.py BUILD"""

import struct
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

from bench import find, main

find(sys.argv[1], "access", "geometry")

import haar  # noqa: E402  (here and below: found only now)
import numpy as np  # noqa: E402
import ranges  # noqa: E402
import sparse  # noqa: E402
import store  # noqa: E402
import vq  # noqa: E402
from depth import measures, read_pfm  # noqa: E402
from light_field import bpp_at  # noqa: E402
from methods import search  # noqa: E402
from process import BenchError, run_measured  # noqa: E402
from regions import regions, whole_pictures  # noqa: E402
from x265 import picture_bytes, to_rgb, to_ycbcr  # noqa: E402

SHAPE = (3, 9, 10, 13)  # no side fits a tile


def light_field(noise):
    row, col, y, x = np.indices(SHAPE)
    waves = [128 + 60 * np.sin((x + col) / 5 + k) + 40 * np.cos((y + row) / 4) for k in range(3)]
    wave = np.stack(waves, axis=-1) + np.random.default_rng(3).normal(0, noise, (*SHAPE, 3))
    return np.clip(wave, 0, 255).astype(np.uint8)


class Codecs(unittest.TestCase):
    def assert_same_pixels(self, reader, whole):
        for place in np.random.default_rng(4).integers(0, SHAPE, (150, 4)):
            self.assertEqual(list(reader.pixel(*map(int, place))), list(whole[tuple(place)]), place)

    def test_quantisation(self):
        """Single pixels are those of the whole; with a word for each tile nothing is lost."""
        for tile in vq.TILES:
            layer = vq.Layer(vq.encode(light_field(4), tile, 32))
            self.assert_same_pixels(layer, layer.views())
        field = np.zeros((*SHAPE, 3), np.uint8)
        field[:, :, :, 6:] = (10, 200, 90)
        field[:, :, 4:, :] += 20
        self.assertTrue((vq.Layer(vq.encode(field, (1, 1, 2, 2), 64)).views() == field).all())

    def test_nearest_word_is_that_of_the_definition(self):
        rng = np.random.default_rng(5)
        tiles, words = rng.integers(0, 256, (90, 48)), rng.integers(0, 256, (40, 48))
        words[7] = words[3]  # the first of equals
        distances = ((tiles[:, None] - words[None]) ** 2).sum(axis=2)
        self.assertEqual(list(vq.nearest(tiles, words)), list(distances.argmin(axis=1)))

    def test_wavelet(self):
        """Single pixels, read from bytes, are those of the inverse of the whole; with the finest steps that is the
        light field, but for rounding."""
        for noise, step in ((6, haar.LEAST_STEP), (6, 60), (0, 400), (0, haar.MOST_STEP)):
            coefficients = haar.quantised(light_field(noise), step)
            whole = haar.views_of(coefficients, SHAPE, step)
            self.assert_same_pixels(haar.Reader(haar.pack(coefficients, SHAPE, step)), whole)
            if step == haar.LEAST_STEP:
                self.assertLessEqual(abs(whole.astype(int) - light_field(noise)).max(), 2)
        extremes = np.where(np.indices(SHAPE).sum(axis=0)[..., None] % 2, 0, (255, 255, 255)).astype(np.uint8)
        extremes[0, 0] = (255, 0, 255)
        self.assert_same_pixels(haar.Reader(haar.encode(extremes, haar.LEAST_STEP)), extremes)

    def test_what_the_wavelet_reads_is_counted_once(self):
        reader = haar.Reader(haar.encode(light_field(6), 60))
        reader.pixel(1, 2, 3, 4)
        once = reader.bytes, reader.samples
        self.assertTrue(0 < once[0] < len(reader.file) / 20)
        reader.pixel(1, 2, 3, 4)
        self.assertEqual((reader.bytes, reader.samples), once)

    def test_video(self):
        view = light_field(6)[0, 0]
        self.assertLessEqual(abs(to_rgb(to_ycbcr(view)).astype(int) - view).max(), 2)
        start = b"\0\0\1"
        units = [start + b"\x40\1head", start + b"\x26\1\x80first", start + b"\x26\1\x00more", start + b"\x02\1\x80second"]
        self.assertEqual(picture_bytes(b"".join(units)), [sum(map(len, units[:3])), len(units[3])])


class Counting(unittest.TestCase):
    FIELD = SimpleNamespace(rows=2, cols=2, width=16, height=16)

    def test_regions(self):
        asked = regions(self.FIELD)
        self.assertEqual(asked["block"][5], ([(1, 1, 4, 4, 4, 4)], [(1, 1, 8, 4, 4, 4)]))
        self.assertEqual(asked["frame"][0][0], [(0, 0, 0, 0, 8, 8), (0, 1, 8, 0, 8, 8), (1, 0, 0, 8, 8, 8), (1, 1, 8, 8, 8, 8)])

    def test_whole_pictures(self):
        sizes, order = [1, 10, 100, 1000], [0, 1, 3, 2]
        for alone, cold, warm in ((True, (100, 768, 768), (1000, 768, 1536)), (False, (111, 2304, 2304), (1000, 768, 3072))):
            client = whole_pictures(self.FIELD, sizes, order, alone)
            costs = [client([(1, col, 0, 0, 1, 1)]) for col in (1, 0)]
            self.assertEqual([(cost.bytes, cost.samples, cost.held) for cost in costs], [cold, warm])

    def test_ranges_against_sets_of_bytes(self):
        members = lambda found: {byte for offset, length in found for byte in range(offset, offset + length)}
        a, b = [[0, 4], [6, 2], [20, 9]], [[2, 5], [22, 2], [25, 1]]
        self.assertEqual(members(ranges.merged([*a, *b])), members(a) | members(b))
        self.assertEqual(members(ranges.without(a, b)), members(a) - members(b))
        self.assertEqual(ranges.merged(a, 2), [[0, 8], [20, 9]])

    def test_search(self):
        for target, found in ((0, 0), (5.5, 6), (9, 9), (20, 9)):
            self.assertEqual(search(lambda p: (p,), range(10), target), (found, found))

    def test_bits_at_a_psnr_lie_between_points(self):
        curve = [(34.0, 1.0), (38.0, 4.0)]
        self.assertAlmostEqual(bpp_at(curve, 36), 2)
        self.assertIsNone(bpp_at(curve, 39))

    def test_checksum(self):
        self.assertEqual(sparse.crc32c(b"123456789"), 0xE3069283)


class Depth(unittest.TestCase):
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

    def test_pfm(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "map.pfm"
            for order, scale in (("<", b"-1.0"), (">", b"1")):
                path.write_bytes(b"Pf\n2 2\n" + scale + b"\n" + struct.pack(f"{order}4f", 3, 4, 1, 2))
                self.assertEqual(read_pfm(path).tolist(), [[1, 2], [3, 4]])
            path.write_bytes(b"PF\n2 2\n-1.0\n" + bytes(48))
            with self.assertRaises(BenchError):
                read_pfm(path)


class Comparison(unittest.TestCase):
    def differences(self, **changes):
        row = {"scene": "a", "bytes": 100, "psnr": 36.5, "cpu_seconds": 2.0, "calibration_seconds": 0.1, "counts": [1, 2]}
        results = lambda row: {"machine": "m", "rows": [row]}
        found = store.differences(results(row), results({**row, **changes}), ("scene",))
        return [(difference.name, difference.new) for difference in found]

    def test_what_differs_from_the_record(self):
        for changes, names in (
            ({}, []), ({"bytes": 101}, ["bytes"]), ({"psnr": 36.50001}, []), ({"psnr": 36.51}, ["psnr"]),
            ({"counts": [1, 3]}, ["counts"]), ({"cpu_seconds": 2.4}, []), ({"cpu_seconds": 3.0}, ["cpu_seconds"]),
            ({"cpu_seconds": 4.0, "calibration_seconds": 0.2}, []),  # a slower machine
        ):
            self.assertEqual([name for name, _ in self.differences(**changes)], names, changes)
        self.assertEqual(self.differences(scene="b", bytes=7), [])  # not recorded

    def test_results_come_back_from_a_file(self):
        results = {"machine": "m", "rows": [{"scene": "a", "psnr": float("inf"), "bytes": 1}, {"scene": "b", "bytes": 2}]}
        with tempfile.TemporaryDirectory() as folder:
            store.write(results, Path(folder) / "results.json")
            self.assertEqual(store.read(Path(folder) / "results.json"), results)
        new = {"machine": "n", "rows": [{"scene": "b", "bytes": 3}, {"scene": "c", "bytes": 4}]}
        made = store.merged(results, new, ("scene",))
        self.assertEqual([made["machine"], *(row["bytes"] for row in made["rows"])], ["n", 1, 3, 4])


class Programs(unittest.TestCase):
    def test_peak_memory_is_the_childs_own(self):
        held = bytearray(200 << 20)
        said, cost = run_measured([sys.executable, "-S", "-c", "print(len(bytearray(60 << 20)))"])
        self.assertEqual(int(said), 60 << 20)
        self.assertTrue(60 << 20 < cost.peak_bytes < 150 << 20 and cost.cpu_seconds > 0)
        del held

    def test_a_program_that_fails_says_why(self):
        with self.assertRaisesRegex(BenchError, "no room"):
            run_measured(["sh", "-c", "echo no room >&2; exit 3"])
        with self.assertRaisesRegex(BenchError, "no program"):
            run_measured(["/a-program-that-is-not-there"])


if __name__ == "__main__":
    main()
