"""Faults that a decoder may have, to be planted into the naive one."""

import bise
import block
import light_field
import references
import residual
import tile_head
from bit_string import Cursor
from geometry import Geometry
from groups import Groups
from integers import clamp
from jpeg2000 import code_block, decoder as jpeg2000_decoder, wavelet

RIGHT_TRITS, RIGHT_QUINTS, RIGHT_JOIN = bise.trits, bise.quints, wavelet.join
RIGHT_REF, RIGHT_VECTOR = block.BlockDecoder._ref, block.read_vector
RIGHT_SIGN_CONTEXT = code_block.sign_context


def low_trit(T):
    """The lowest trit loses its value 2 (BISE-8)."""
    return [RIGHT_TRITS(T)[0] % 2, *RIGHT_TRITS(T)[1:]]


def reversed_quints(Q):
    """The greatest quint first (BISE-9)."""
    return RIGHT_QUINTS(Q)[::-1]


def full_last_group(count, levels):
    """The last group is not cut (BISE-3)."""
    plain, digits = bise.split(levels)
    return plain * count + {1: 0, 3: -(-count // 5) * 8, 5: -(-count // 3) * 7}[digits]


def ref_without_border(blocks, image, plane, x, y):
    """0 right of the plane in place of its last column (DEC-5)."""
    return 0 if x >= blocks.stream.geometry.plane_size(plane)[0] else RIGHT_REF(blocks, image, plane, x, y)


def ref_border_off_by_one(blocks, image, plane, x, y):
    """The last row is never read (DEC-5)."""
    last = max(0, blocks.stream.geometry.plane_size(plane)[1] - 2)
    return RIGHT_REF(blocks, image, plane, x, min(y, last))


def vector_without_sign(*arguments):
    """Every sign is + (TIL-6)."""
    return 1, RIGHT_VECTOR(*arguments)[1]


def truncated_prediction(interpolated):
    """Truncates in place of rounding (MOT-9)."""
    return sum(interpolated) >> 5 + len(interpolated)


def late_reference(groups, group):
    """n >> 1 in place of (n - 1) >> 1 (STR-4)."""
    members = [image for image in range(groups.images) if groups.group_of(image) == group]
    return members[len(members) >> 1]


def colour_towards_zero(y, co, cg, depth):
    """Halves rounded towards 0 (COL-2)."""
    t = y - int(cg / 2)
    b = t - int(co / 2)
    return tuple(clamp(sample, 0, 2**depth - 1) for sample in (b + co, cg + t, b))


def unbalanced_group_of(groups, image):
    """Balanced groups taken for others (EXT-3)."""
    return min(image // groups.size, groups.count - 1)


def join_without_detail(ll, hl, lh, hh):
    """The upper right coefficients are taken as 0."""
    return RIGHT_JOIN(ll, [[0] * len(row) for row in hl], lh, hh)


SWAPPED_SETS = [(0,), (0, 2), (0, 1), (2,), (1,), (1, 2), (0, 3), (3,)]

# Name, object, attribute, faulty replacement.
FAULTS = [
    ("low trit", bise, "trits", low_trit),
    ("reversed quints", bise, "quints", reversed_quints),
    ("last group not cut", bise, "sequence_bits", full_last_group),
    ("no border", block.BlockDecoder, "_ref", ref_without_border),
    ("border off by one", block.BlockDecoder, "_ref", ref_border_off_by_one),
    ("sign of vectors", block, "read_vector", vector_without_sign),
    ("block numbers row by row", block, "block_number", lambda i, j: 8 * j + i),
    ("prediction without rounding", block, "predict", truncated_prediction),
    ("vectors without rounding", references, "rshift", lambda x, k: x >> k),
    ("K1 and K2 swapped", references, "REFERENCE_SETS", SWAPPED_SETS),
    ("vectors of chroma not halved", block, "eighths", lambda v, precision, _: v * 2 ** (3 - precision)),
    ("odd steps", residual, "step_of", lambda code: 2 ** (code // 2)),
    ("unsigned fields", Cursor, "take_signed", Cursor.take),
    ("reference image", Groups, "reference", late_reference),
    ("balanced groups", Groups, "group_of", unbalanced_group_of),
    ("no level keyed but the top", Geometry, "is_keyed", lambda geometry, level: level == geometry.top),
    ("halves of colours", light_field, "to_rgb", colour_towards_zero),
    ("mask outside accepted", tile_head, "blocks_in_plane", lambda *_: 2**64 - 1),
    ("detail lost", jpeg2000_decoder, "join", join_without_detail),
    ("sign contexts", code_block, "sign_context", lambda *sums: (RIGHT_SIGN_CONTEXT(*sums)[0], 0)),
]
