"""The error that a benchmark ends with."""


class BenchError(Exception):
    """Something the caller can put right; the text says what."""
