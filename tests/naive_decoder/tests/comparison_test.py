"""The naive decoder and the program under test agree: views, stages of blocks, names of errors."""

import paths  # noqa: F401
import random

from comparison import Answers
from damage import KINDS, damaged
from golden import Golden
from program import CliTest, main
from streams import encoded_streams, random_streams

BLOCKS_OF_STREAM = 4
DAMAGED_COPIES = 50


class ComparisonTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.encoded = encoded_streams(cls)
        cls.random = random_streams(3000)

    def compare(self, name, data, blocks=BLOCKS_OF_STREAM):
        answers = Answers(Golden(self, name, data), data, blocks)
        with self.subTest(stream=name):
            self.assertEqual(answers.differences(), [])
        return answers

    def test_encoded_streams_decode_to_the_same_samples(self):
        for name, data in self.encoded.items():
            self.assertEqual(self.compare(name, data).error, "ok")

    def test_random_streams_decode_to_the_same_samples_or_errors(self):
        outcomes = [self.compare(name, data).error for name, data in self.random.items()]
        self.assertGreater(outcomes.count("ok"), len(outcomes) // 4)

    def test_damaged_streams_give_the_same_errors(self):
        rng = random.Random(1)
        errors = set()
        for number in range(DAMAGED_COPIES):
            data = rng.choice(list(self.encoded.values()))
            kind = KINDS[number % len(KINDS)]
            answers = self.compare(f"{kind}{number}", damaged(data, rng, kind), blocks=1)
            errors.add(answers.error)
        self.assertGreater(len(errors), 8, errors)


main()
