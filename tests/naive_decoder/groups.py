"""Reference groups along one axis: rows of groups, or columns (STR-4, EXT-3)."""

from integers import ceil_div


class Groups:
    """The groups of `count` images in a row, of `size` images each or, balanced, about so many."""

    def __init__(self, count, size, balanced):
        self.images, self.size, self.balanced = count, size, balanced
        self.count = ceil_div(count, size)

    def first(self, group):
        """The first image of a group."""
        if self.balanced:
            return group * self.images // self.count
        return group * self.size

    def group_of(self, image):
        """The group that holds an image."""
        if self.balanced:
            return ((image + 1) * self.count - 1) // self.images
        return image // self.size

    def length(self, group):
        """The number of images of a group."""
        end = self.first(group + 1) if self.balanced else min(self.first(group) + self.size, self.images)
        return end - self.first(group)

    def reference(self, group):
        """The reference image of a group."""
        return self.first(group) + ((self.length(group) - 1) >> 1)
