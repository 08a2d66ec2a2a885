#!/usr/bin/env python3
"""The parts of the skipping bench that measure nothing: ranges, checksums, checks and differences."""

import importlib.util
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import find, main  # noqa: E402  (here and below: found only now)

BENCH = find("skipping", "numpy", "PIL", "matplotlib")

import ranges  # noqa: E402
import sparse  # noqa: E402
from measure import check, traced  # noqa: E402
from process import BenchError  # noqa: E402

spec = importlib.util.spec_from_file_location("skipping", BENCH / "__main__.py")
skipping = importlib.util.module_from_spec(spec)
spec.loader.exec_module(skipping)


def frame(**changes):
    return {"needed": 5, "decoded": 5, "reused": 0, "reads": [[8, 4], [0, 4]], **changes}


class RangesTest(unittest.TestCase):
    def test_ranges_join_across_gaps(self):
        found = [[0, 4], [6, 2], [20, 1]]
        self.assertEqual(ranges.merged(found, 0), found)
        self.assertEqual(ranges.merged(found, 2), [[0, 8], [20, 1]])
        self.assertEqual(ranges.merged(found, 12), [[0, 21]])

    def test_against_sets_of_bytes(self):
        a, b = [[0, 4], [6, 2], [20, 9]], [[2, 5], [22, 2], [25, 1]]
        self.assertEqual(members(ranges.merged([*a, *b])), members(a) | members(b))
        self.assertEqual(members(ranges.without(a, b)), members(a) - members(b))
        self.assertEqual(members(ranges.without(b, a)), members(b) - members(a))

    def test_a_warm_client_asks_once(self):
        cold = list(traced([frame(), frame()], "cold"))
        warm = list(traced([frame(), frame()], "warm"))
        self.assertEqual([f["fetched"][0] for f in cold], [8, 8])
        self.assertEqual([f["fetched"][0] for f in warm], [8, 0])


def members(found):
    return {byte for offset, length in found for byte in range(offset, offset + length)}


class ChecksumTest(unittest.TestCase):
    def test_known_value(self):
        self.assertEqual(sparse.crc32c(b"123456789"), 0xE3069283)

    def test_zeros_without_bytes(self):
        for count in (0, 1, 2, 63, 1000):
            register = sparse.advance(sparse.START, b"before")
            self.assertEqual(sparse.advance_zeros(register, count),
                             sparse.advance(register, bytes(count)))


class CheckTest(unittest.TestCase):
    def test_cold_renderers_decode_what_is_needed(self):
        check("cold", [frame()])
        with self.assertRaises(BenchError):
            check("cold", [frame(decoded=4, reused=1)])
        with self.assertRaises(BenchError):
            check("warm", [frame(decoded=6)])

    def test_differences_are_named_and_times_are_not(self):
        old = {"paths": [{"needed": 5, "cpu_seconds": 1.0}], "machine": "a"}
        new = {"paths": [{"needed": 6, "cpu_seconds": 2.0}], "machine": "b"}
        found = skipping.differences(skipping.counts(old), skipping.counts(new))
        self.assertEqual(found, ["paths[0].needed: 5 -> 6"])
        self.assertEqual(skipping.differences(old, old), [])


if __name__ == "__main__":
    main()
