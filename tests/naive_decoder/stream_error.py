"""The errors of annex A, by name."""


class StreamError(Exception):
    """A stream that is not valid. `name` is the error's name in annex A, such as "bad_magic".

    `place` is the block that a frame needs and that has the error, as (level, row, col, plane, block_x,
    block_y), or None.
    """

    def __init__(self, name, place=None):
        super().__init__(name)
        self.name, self.place = name, place


def require(condition, name):
    """Raises the error `name` unless the condition holds; the first check that fails ends all (CNV-7)."""
    if not condition:
        raise StreamError(name)
