"""The comparison finds each fault of a list that is planted into the naive decoder."""

import paths  # noqa: F401
from unittest.mock import patch

from comparison import Answers
from faults import FAULTS
from golden import Golden
from program import CliTest, main
from streams import encoded_streams, random_streams

BLOCKS_OF_STREAM = 3


def caught(answers):
    """Whether the decoder, as it is now, answers differently or crashes."""
    try:
        return answers.differences() != []
    except Exception:  # pylint: disable=broad-except # a faulty decoder may end in any way
        return True


class PlantedFaultsTest(CliTest):
    @classmethod
    def prepare(cls):
        streams = {**encoded_streams(cls), **random_streams(20000)}
        cls.answers = [
            Answers(Golden(cls, name, data), data, BLOCKS_OF_STREAM)
            for name, data in sorted(streams.items(), key=lambda item: len(item[1]))
        ]

    def test_without_a_fault_nothing_differs(self):
        for answers in self.answers:
            self.assertEqual(answers.differences(), [])

    def test_every_fault_is_caught(self):
        for name, place, attribute, replacement in FAULTS:
            with self.subTest(fault=name), patch.object(place, attribute, replacement):
                self.assertTrue(any(map(caught, self.answers)))


main()
