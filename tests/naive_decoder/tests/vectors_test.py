"""The naive decoder on every vector of the conformance suite."""

import paths  # noqa: F401
import unittest
from concurrent.futures import ProcessPoolExecutor

from program import main
from vector_check import FOLDER, check_vector, load_vectors


class VectorsTest(unittest.TestCase):
    def test_every_vector_is_decoded_as_the_manifest_says(self):
        vectors = load_vectors()
        self.assertGreater(len(vectors), 0)
        with ProcessPoolExecutor() as workers:
            for vector, wrong in zip(vectors, workers.map(check_vector, [FOLDER] * len(vectors), vectors)):
                with self.subTest(vector=vector["id"]):
                    self.assertEqual(wrong, [])


if __name__ == "__main__":
    main()
