"""Reference groups against their definition by lists; IDX-1 against counting."""

import paths  # noqa: F401
import itertools
import unittest
from types import SimpleNamespace

from geometry import Geometry
from groups import Groups
from program import main


class GroupsTest(unittest.TestCase):
    def test_every_image_is_in_one_group_and_the_reference_in_the_middle(self):
        for count, size, balanced in itertools.product(range(1, 40), range(1, 12), (False, True)):
            groups = Groups(count, size, balanced)
            members = [[i for i in range(count) if groups.group_of(i) == k] for k in range(groups.count)]
            self.assertEqual(sum(members, []), list(range(count)))
            for group, images in enumerate(members):
                self.assertEqual(groups.first(group), images[0])
                self.assertEqual(groups.reference(group), images[(len(images) - 1) // 2])
                self.assertLessEqual(len(images), size)
            sizes = [len(images) for images in members]
            if balanced:
                self.assertLessEqual(max(sizes) - min(sizes), 1)
            else:
                self.assertEqual(set(sizes[:-1]) | {size}, {size})

    def test_image_numbers_count_from_the_top(self):
        header = SimpleNamespace(rows=5, cols=3, cluster_rows=2, cluster_cols=2, tree_height=2, block_log2=2,
                                 motion_tiles=False)
        geometry = Geometry(header)
        self.assertEqual(geometry.grids, [(5, 3), (3, 2), (2, 1)])
        numbers = [geometry.image_number(image) for image in geometry.images()]
        self.assertEqual(numbers, list(range(15 + 6 + 2)))


main()
