"""The check of the vectors finds each fault of a list that is planted into the naive decoder."""

import paths  # noqa: F401
import unittest
from unittest.mock import patch

from faults import FAULTS
from program import main
from vector_check import FOLDER, check_vector, load_vectors


def caught(vector):
    """Whether the decoder, as it is now, fails the vector or crashes on it."""
    try:
        return check_vector(FOLDER, vector) != []
    except Exception:  # pylint: disable=broad-except # a faulty decoder may end in any way
        return True


class PlantedFaultsTest(unittest.TestCase):
    def test_every_fault_is_caught(self):
        smallest_first = load_vectors()[::-1]
        for name, place, attribute, replacement in FAULTS:
            with self.subTest(fault=name), patch.object(place, attribute, replacement):
                self.assertTrue(any(map(caught, smallest_first)))


main()
