"""Reference images of a palette entry and the vector into each (MOT-7, MOT-8)."""

from integers import clamp, rshift
from motion import EXPLICIT_VECTOR

# K numbers by reference_set (MOT-7).
REFERENCE_SETS = [(0,), (0, 1), (0, 2), (1,), (2,), (1, 2), (0, 3), (3,)]


def next_group(groups, position):
    """The group next to the position's own, on its side of the reference image (MOT-7)."""
    own = groups.group_of(position)
    step = 1 if position >= groups.reference(own) else -1
    for group in (own + step, own - step):
        if 0 <= group < groups.count:
            return group
    return own


def candidates(geometry, image):
    """[K0, K1, K2, K3] (MOT-7)."""
    level, row, col = image
    rows, cols = geometry.row_groups(level), geometry.col_groups(level)
    i, j = rows.group_of(row), cols.group_of(col)
    i_next, j_next = next_group(rows, row), next_group(cols, col)

    def reference(group_row, group_col):
        return level, rows.reference(group_row), cols.reference(group_col)

    k0, h, v, k3 = reference(i, j), reference(i, j_next), reference(i_next, j), reference(i_next, j_next)
    beside_first = abs(col - k0[2]) >= abs(row - k0[1])
    return [k0, h, v, k3] if beside_first else [k0, v, h, k3]


def references_of(geometry, image, motion):
    """The one or two reference images of a palette entry."""
    images = candidates(geometry, image)
    return [images[k] for k in REFERENCE_SETS[motion.reference_set]]


def vector_to(header, image, reference, motion, disparity):
    """(vx, vy) in units of 2^-vector_precision samples (MOT-8); disparity is None for choice 11."""
    bound = header.window * 2**header.vector_precision
    if motion.choice == EXPLICIT_VECTOR:
        vx, vy = motion.explicit_x, motion.explicit_y
    else:
        shift = header.disparity_precision - header.vector_precision
        vx = rshift(disparity * (reference[2] - image[2]), shift)
        vy = rshift(disparity * header.row_scale * (reference[1] - image[1]), shift + 4)
    return clamp(vx, -bound, bound), clamp(vy, -bound, bound)
