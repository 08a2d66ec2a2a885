"""Byte ranges of a file, as HTTP range requests would ask for them."""


def merged(ranges, gap=0):
    """Ranges [offset, length], ascending and disjoint, joined where at most `gap` bytes lie between
    them, which then belong to the range."""
    joined = []
    for offset, length in sorted(ranges):
        if joined and offset - sum(joined[-1]) <= gap:
            joined[-1][1] = max(sum(joined[-1]), offset + length) - joined[-1][0]
        else:
            joined.append([offset, length])
    return joined


def without(ranges, held):
    """The bytes of `ranges` that are not in `held`."""
    left = []
    for offset, length in ranges:
        end = offset + length
        for other, size in held:
            if other + size <= offset or other >= end:
                continue
            if other > offset:
                left.append([offset, other - offset])
            offset = other + size
        if offset < end:
            left.append([offset, end - offset])
    return left


def bytes_of(ranges):
    return sum(length for _, length in ranges)
