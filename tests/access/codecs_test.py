#!/usr/bin/env python3
"""The codecs of the access bench: bytes and back without loss, single pixels as in the whole, faults found."""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import find, main  # noqa: E402  (here and below: found only now)

find("rate_distortion", "numpy", "PIL", "hmlfc")
find("access")

import haar  # noqa: E402
import numpy as np  # noqa: E402
import vq  # noqa: E402
from methods import search  # noqa: E402
from regions import Cost, pairs, regions, whole_pictures  # noqa: E402
from x265 import picture_bytes  # noqa: E402

SHAPE = (3, 9, 10, 13)  # no side fits a tile


def light_field(noise):
    row, col, y, x = np.indices(SHAPE)
    waves = [128 + 60 * np.sin((x + col) / 5 + k) + 40 * np.cos((y + row) / 4) for k in range(3)]
    wave = np.stack(waves, axis=-1) + np.random.default_rng(3).normal(0, noise, (*SHAPE, 3))
    return np.clip(wave, 0, 255).astype(np.uint8)


def assert_same_pixels(test, reader, whole):
    for place in np.random.default_rng(4).integers(0, SHAPE, (150, 4)):
        test.assertEqual(list(reader.pixel(*map(int, place))), list(whole[tuple(place)]), place)


class Quantisation(unittest.TestCase):
    def test_pixels_alone_are_those_of_the_whole(self):
        for tile in vq.TILES:
            file = vq.encode(light_field(4), tile, 32)
            layer = vq.Layer(file)
            assert_same_pixels(self, layer, layer.views())
            self.assertEqual(vq.encode(light_field(4), tile, 32), file)

    def test_a_light_field_of_few_tiles_is_exact(self):
        """With a word for each tile nothing is lost, whatever was in the file's head, codebook and layer."""
        field = np.zeros((*SHAPE, 3), np.uint8)
        field[:, :, :, 6:] = (10, 200, 90)
        field[:, :, 4:, :] += 20
        self.assertTrue((vq.Layer(vq.encode(field, (1, 1, 2, 2), 64)).views() == field).all())

    def test_nearest_is_that_of_the_definition(self):
        rng = np.random.default_rng(5)
        tiles, words = rng.integers(0, 256, (90, 48)), rng.integers(0, 256, (40, 48))
        words[7] = words[3]  # the first of equals
        distances = ((tiles[:, None] - words[None]) ** 2).sum(axis=2)
        self.assertEqual(list(vq.nearest(tiles, words)), list(distances.argmin(axis=1)))
        with self.assertRaises(ValueError):
            vq.nearest(np.zeros((1, 2 * vq.MOST_SAMPLES)), np.zeros((1, 2 * vq.MOST_SAMPLES)))

    def test_training_sees_all_rows_and_columns(self):
        for count, width in ((8 * 8 * 64 * 64, 64), (8 * 8 * 64 * 64, 64 * 64), (9 * 9 * 60 * 44, 44), (5, 1)):
            chosen = vq.spread(count)
            self.assertGreater(len(chosen), min(count, vq.TRAINED_TILES) * 0.9)
            self.assertEqual(len(set(chosen % width)), width)

    def test_words_are_means(self):
        samples = np.array([[0] * 12, [3] * 12, [100] * 12, [104] * 12])
        self.assertEqual(vq.train(samples, 2)[:, 0].tolist(), [2, 102])

    def test_damage_is_found(self):
        file = vq.encode(light_field(4), vq.TILES[0], 16)
        content = vq.zlib.decompress(file[vq.HEAD.size :])
        layers = [content + b"x", content[:-1], content[:-2] + b"\x10\0", b""]
        damaged = [file[: vq.HEAD.size] + vq.zlib.compress(layer) for layer in layers]
        for other in (b"VQ5D" + file[4:], file[:-9] + bytes(9), *damaged):
            with self.assertRaises((ValueError, vq.zlib.error)):
                vq.Layer(other)


class Wavelet(unittest.TestCase):
    def test_bytes_and_back(self):
        for noise, step in ((6, haar.LEAST_STEP), (6, 60), (0, 400), (0, haar.MOST_STEP)):
            coefficients = haar.quantised(light_field(noise), step)
            file = haar.pack(coefficients, SHAPE, step)
            for coded, read in zip(coefficients, haar.Reader(file).coefficients(), strict=True):
                self.assertTrue((coded == read).all(), step)
            assert_same_pixels(self, haar.Reader(file), haar.Reader(file).views())

    def test_values_of_each_width(self):
        for value in (1, -1, 127, -128, 128, -129, 32767, -32768):
            coefficients = [np.full(3, 1 << 20), *[np.zeros((3, *[16] * level, 15), np.int64) for level in range(3)]]
            coefficients[3][2, 5, 15, 14] = coefficients[1][1, 0] = value
            read = haar.Reader(haar.pack(coefficients, (8, 8, 8, 8), 9)).coefficients()
            self.assertTrue(all((a == b).all() for a, b in zip(coefficients, read, strict=True)), value)

    def test_colours_round_to_the_nearest(self):
        for luma, grey in ((2047, 0), (2048, 1), (6143, 1), (-9999, 0), (300 << 12, 255)):
            self.assertEqual(haar.rgb((luma, 0, 0)).tolist(), [grey] * 3)

    def test_extremes_fit(self):
        field = np.where(np.indices(SHAPE).sum(axis=0)[..., None] % 2, 0, (255, 255, 255)).astype(np.uint8)
        field[0, 0] = (255, 0, 255)
        self.assertTrue((haar.Reader(haar.encode(field, haar.LEAST_STEP)).views() == field).all())

    def test_transform_is_that_of_the_definition(self):
        """Without quantisation to speak of, the inverse gives the views back; a detail at a time, it is a checkerboard."""
        field = light_field(0)
        error = haar.views_of(haar.quantised(field, haar.LEAST_STEP), SHAPE, haar.LEAST_STEP).astype(int) - field
        self.assertLessEqual(abs(error).max(), 2)
        details = [np.zeros((3, *[16] * level, 15), np.int64) for level in range(3)]
        details[0][0, 0] = 256  # 256 * 5 steps of 1 over sqrt(8^4), a quarter of which is R; the lowest bit: x
        view = haar.views_of([np.full(3, 0), *details], (8, 8, 8, 8), 16)
        self.assertEqual({tuple(pixel) for pixel in view[..., :4, :].reshape(-1, 3)}, {(5, 5, 5)})
        self.assertEqual(view[..., 4:, :].max(), 0)

    def test_what_is_read_is_counted_once(self):
        file = haar.encode(light_field(6), 60)
        reader = haar.Reader(file)
        reader.pixel(1, 2, 3, 4)
        once = reader.bytes, reader.samples
        self.assertTrue(0 < once[0] < len(file) / 20)
        reader.pixel(1, 2, 3, 4)
        self.assertEqual((reader.bytes, reader.samples), once)
        for place in np.ndindex(SHAPE):
            reader.pixel(*place)
        self.assertLessEqual(reader.bytes, len(file) - haar.HEAD.size)

    def test_damage_changes_pixels(self):
        file = haar.encode(light_field(6), 60)
        with self.assertRaises(ValueError):
            haar.Reader(b"HW5D" + file[4:])
        record = int.from_bytes(file[haar.HEAD.size : haar.HEAD.size + 4], "little")
        damaged = file[:record] + bytes([file[record] ^ 16]) + file[record + 1 :]
        self.assertFalse((haar.Reader(damaged).views() == haar.Reader(file).views()).all())


class Counting(unittest.TestCase):
    FIELD = SimpleNamespace(rows=2, cols=2, width=16, height=16)

    def test_regions(self):
        asked = regions(self.FIELD)
        self.assertEqual(asked["block"][5], ([(1, 1, 4, 4, 4, 4)], [(1, 1, 8, 4, 4, 4)]))
        self.assertEqual(asked["frame"][0][0], [(0, 0, 0, 0, 8, 8), (0, 1, 8, 0, 8, 8), (1, 0, 0, 8, 8, 8), (1, 1, 8, 8, 8, 8)])
        self.assertEqual([x for _, _, x, *_ in asked["frame"][0][1]], [4, 8, 4, 8])  # not beyond the views

    def test_whole_pictures(self):
        sizes, order = [1, 10, 100, 1000], [0, 1, 3, 2]
        for alone, cold, warm in ((True, (100, 768, 768), (1000, 768, 1536)), (False, (111, 2304, 2304), (1000, 768, 3072))):
            client = whole_pictures(self.FIELD, sizes, order, alone)
            costs = [client([(1, col, 0, 0, 1, 1)]) for col in (1, 0)]
            self.assertEqual([(cost.bytes, cost.samples, cost.held) for cost in costs], [cold, warm])

    def test_means_over_places(self):
        number = iter(range(68))
        found = pairs(self.FIELD, lambda: lambda request: Cost(next(number), len(request), 0))
        self.assertEqual([cost.bytes for costs in found.values() for cost in costs], [15, 16, 47, 48, 64, 65, 66, 67])
        self.assertEqual(found["frame"][0].samples, 4)

    def test_pictures_of_a_video(self):
        start = b"\0\0\1"
        units = [start + b"\x40\1head", start + b"\x26\1\x80first", start + b"\x26\1\x00more", start + b"\x02\1\x80second"]
        self.assertEqual(picture_bytes(b"".join(units)), [sum(map(len, units[:3])), len(units[3])])

    def test_search(self):
        for target, found in ((0, 0), (5.5, 6), (9, 9), (20, 9)):
            self.assertEqual(search(lambda p: (p,), range(10), target), ((found,), found))


if __name__ == "__main__":
    main()
