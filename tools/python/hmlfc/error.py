"""What is raised for streams that are refused, and what is warned of."""


class Error(ValueError):
    """A stream, or a block of it, is corrupt or beyond this decoder.

    name: the error of annex A of the specification, such as "bad_magic"
    section: "header", "TOP", "ROOT", "GROUP" or "TILE"
    offset: byte of the file at which it was found
    """

    def __init__(self, message: str, name: str, section: str, offset: int) -> None:
        super().__init__(message)
        self.name, self.section, self.offset = name, section, offset

    def __reduce__(self):
        return Error, (str(self), self.name, self.section, self.offset)


class Note(UserWarning):
    """What the program says on standard error, although nothing failed: what reading pictures changed or left out,
    or a target that was missed."""
