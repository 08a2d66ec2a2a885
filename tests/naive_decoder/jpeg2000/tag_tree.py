"""Tag trees (T.800 B.10.2)."""


class TagTree:
    """A tag tree over width x height leaves."""

    def __init__(self, width, height):
        self.sizes = [(width, height)]
        while self.sizes[-1] != (1, 1):
            width, height = (width + 1) // 2, (height + 1) // 2
            self.sizes.append((width, height))
        self.least = [[0] * (w * h) for w, h in self.sizes]
        self.known = [[False] * (w * h) for w, h in self.sizes]

    def at_most(self, x, y, bound, take_bit):
        """Whether the leaf's value is at most `bound`, reading as many bits as that takes."""
        least = 0
        for depth in range(len(self.sizes) - 1, -1, -1):
            node = (y >> depth) * self.sizes[depth][0] + (x >> depth)
            least = max(least, self.least[depth][node])
            while least <= bound and not self.known[depth][node]:
                if take_bit():
                    self.known[depth][node] = True
                else:
                    least += 1
            self.least[depth][node] = least
        return least <= bound

    def value(self, x, y, take_bit):
        """The leaf's value."""
        bound = 0
        while not self.at_most(x, y, bound, take_bit):
            bound += 1
        return bound
