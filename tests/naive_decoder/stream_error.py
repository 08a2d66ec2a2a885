"""The errors of annex A, by name."""


class StreamError(Exception):
    """A stream that is not valid. `name` is the error's name in annex A, such as "bad_magic"."""

    def __init__(self, name):
        super().__init__(name)
        self.name = name


def require(condition, name):
    """Raises the error `name` unless the condition holds; the first check that fails ends all (CNV-7)."""
    if not condition:
        raise StreamError(name)
