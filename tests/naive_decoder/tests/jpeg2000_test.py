"""The JPEG 2000 decoder: lossless views come back, and its parts on inputs worked out by hand."""

import paths  # noqa: F401
import itertools
import random

from block import BlockDecoder
from jpeg2000.codestream_error import CodestreamError
from jpeg2000.decoder import clamp_samples
from jpeg2000.decoder import decode as decode_packets
from jpeg2000.markers import Codestream, COD, EOC, QCD, SIZ, SOC, SOD, SOT
from jpeg2000.tag_tree import TagTree
from jpeg2000.wavelet import synthesize
from light_field import decode_view
from opening import Stream
from pictures import read_png
from program import CliTest, main
from streams import render


def decode(data, *shape):
    """Rows of samples of a codestream of this shape."""
    return decode_packets(Codestream(data, *shape))


def u(size, *values):
    """Big-endian integers."""
    return b"".join(value.to_bytes(size, "big") for value in values)


def segment(marker, content):
    """A marker segment."""
    return u(2, marker, len(content) + 2) + content


def encode_nothing(width, height, depth, signed, decompositions=2):
    """A codestream whose packets are all empty: all coefficients are 0."""
    size = u(4, width, height, 0, 0, width, height, 0, 0)
    depth_byte = depth - 1 + (128 if signed else 0)
    head = u(2, SOC) + segment(SIZ, u(2, 0) + size + u(2, 1) + u(1, depth_byte, 1, 1))
    head += segment(COD, u(1, 0, 0) + u(2, 1) + u(1, 0, decompositions, 4, 4, 0, 1))
    exponents = [depth] + [depth + 1, depth + 1, depth + 2] * decompositions
    head += segment(QCD, u(1, 2 * 32, *(8 * exponent for exponent in exponents)))
    packets = bytes(decompositions + 1)
    tile_part = segment(SOT, u(2, 0) + u(4, 12 + 2 + len(packets)) + u(1, 0, 1))
    return head + tile_part + u(2, SOD) + packets + u(2, EOC)


def analyze(signal):
    """The forward 5/3 transform of one row, (low, high), with the extension written out."""
    n = len(signal)
    if n == 1:
        return signal, []
    at = lambda values, i: values[min(i, 2 * (n - 1) - i) if i >= 0 else -i]
    whole = list(signal)
    for i in range(1, n, 2):
        whole[i] = signal[i] - (at(signal, i - 1) + at(signal, i + 1)) // 2
    for i in range(0, n, 2):
        whole[i] = signal[i] + (at(whole, i - 1) + at(whole, i + 1) + 2) // 4
    return whole[0::2], whole[1::2]


class PartsTest(CliTest):
    def test_synthesis_inverts_analysis(self):
        rng = random.Random(3)
        for length in range(1, 20):
            signal = [rng.randint(-999, 999) for _ in range(length)]
            self.assertEqual(synthesize(*analyze(signal)), signal)

    def test_tag_tree_of_the_standards_example(self):
        """T.800 B.10.2: leaves 1 3 2 3 2 3 / 2 2 1 4 3 2 / 2 2 2 2 1 2 begin with the bits 01111 001 101."""
        bits = iter([0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 1])
        tree = TagTree(6, 3)
        take = lambda: next(bits)
        self.assertEqual([tree.value(x, 0, take) for x in range(3)], [1, 3, 2])
        self.assertEqual(list(bits), [])

    def test_a_codestream_of_empty_packets_is_flat(self):
        for signed, level in (False, 128), (True, 0):
            rows = decode(encode_nothing(5, 3, 8, signed), 5, 3, 8, signed)
            self.assertEqual(rows, [[level] * 5] * 3)

    def test_samples_are_clamped_to_the_interval_of_siz(self):
        self.assertEqual(clamp_samples([[-1, 0, 255, 256]], 8, False), [[0, 0, 255, 255]])
        self.assertEqual(clamp_samples([[-257, -256, 255, 256]], 9, True), [[-256, -256, 255, 255]])

    def test_every_cut_and_every_other_shape_is_refused(self):
        codestream = encode_nothing(5, 3, 8, False)
        for size in range(len(codestream)):
            with self.assertRaises(CodestreamError):
                decode(codestream[:size], 5, 3, 8, False)
        for shape in (4, 3, 8, False), (5, 4, 8, False), (5, 3, 9, False), (5, 3, 8, True):
            with self.assertRaises(CodestreamError):
                decode(codestream, *shape)


class LosslessTest(CliTest):
    def test_key_images_of_every_shape_come_back(self):
        shapes = [("1x1", 8), ("2x1", 8), ("1x7", 8), ("5x4", 12), ("33x3", 9), ("70x9", 8), ("66x67", 8)]
        for (size, depth), scene in zip(shapes, itertools.cycle(["noise", "cards", "glass"])):
            name = f"{size}.{depth}"
            render(self, name, scene, "1x1", size, depth)
            self.hmlfc("encode", name, "-o", f"{name}.hmlfc", "--lossless", "--profile", "main",
                       "--method", "rlfc", "--height", "0")
            decoder = BlockDecoder(Stream((self.folder / f"{name}.hmlfc").read_bytes()))
            view = [sample for line in decode_view(decoder, 0, 0) for pixel in line for sample in pixel]
            shift = 16 - depth if depth > 8 else 0
            original = read_png(self.folder / name / "00_00.png").samples
            self.assertEqual(view, [sample >> shift for sample in original], name)


main()
