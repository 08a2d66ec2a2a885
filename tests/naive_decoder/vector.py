"""Sign and vector of one block of a tile record (TIL-6, TIL-7)."""

import bise
from integers import popcount, rank
from stream_error import require


def read_vector(head, window, block):
    """(sign, (dx, dy)) of a block of the motion mask; sign is 1 or -1."""
    m = rank(head.motion_mask, block)
    count = popcount(head.motion_mask)
    negative = head.record.field(head.signs + m, 1) if head.sign_mode == 2 else head.sign_mode
    vector = []
    for least, levels, position in zip(head.least, head.levels, head.vectors):
        component = least + bise.read_one(head.record, position, count, levels, m)
        require(-window <= component <= window, "vector_range")
        vector.append(component)
    return (-1 if negative else 1), tuple(vector)
