"""The naive decoder and the program under test agree on streams that the suite does not have: encoded
views, and damaged copies of them; samples and names of errors."""

import paths  # noqa: F401
import random

from block import BlockDecoder
from comparison import attempt, naive_view
from damage import KINDS, damaged
from golden import Golden
from opening import Stream
from program import CliTest, main
from streams import encoded_streams

DAMAGED_COPIES = 50


def summary(view):
    """A view for a message: its error, or a checksum."""
    return view if isinstance(view, str) else f"samples with sum {sum(view)}"


class ComparisonTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.encoded = encoded_streams(cls)

    def compare(self, name, data):
        """The name of the first error, or "ok"."""
        golden, stream = Golden(self, name, data), attempt(Stream, data)
        if isinstance(stream, str):
            self.assertEqual(stream, golden.opens(), name)
            return stream
        decoder, views = BlockDecoder(stream), golden.views(stream.header)
        for place, expected in views.items():
            actual = attempt(naive_view, decoder, *place)
            if actual != expected:
                self.fail(f"{name}, view {place}: naive {summary(actual)}, program {summary(expected)}")
        return next((view for view in views.values() if isinstance(view, str)), "ok")

    def test_encoded_streams_decode_to_the_same_samples(self):
        for name, data in self.encoded.items():
            with self.subTest(stream=name):
                self.assertEqual(self.compare(name, data), "ok")

    def test_damaged_streams_give_the_same_errors(self):
        rng = random.Random(1)
        errors = set()
        for number in range(DAMAGED_COPIES):
            data = rng.choice(list(self.encoded.values()))
            kind = KINDS[number % len(KINDS)]
            with self.subTest(kind=kind, number=number):
                errors.add(self.compare(f"{kind}{number}", damaged(data, rng, kind)))
        self.assertGreater(len(errors), 8, errors)


main()
