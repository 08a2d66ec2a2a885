"""Answers the cases of examples/primitives with the naive decoder.

python3 tests/primitives/answers.py FILE... records the results of its cases anew, for inputs that were added
or a clause that has changed.
"""

import sys
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "naive_decoder"))

import bise
import colour
import crc32c
import disparity_map
import frame
import geometry
import groups
import integers
import interpolation
import motion
import ray
import references
import residual
import surface
import tile_mask
import view_sample
import view_weights
from bit_string import BitString, Cursor
from camera import FILTERS
from jpeg2000 import code_block, decoder as jpeg2000_decoder
from jpeg2000.markers import Codestream


def field(bits, position, data):
    unsigned = BitString(data).field(position, bits)
    return unsigned, integers.signed(unsigned, bits)


def count_bits(i, data):
    mask = int.from_bytes(data, "little")
    return integers.popcount(mask), integers.rank(mask, i)


def mask(mode, columns, rows, data):
    cursor = Cursor(BitString(data))
    tile = SimpleNamespace(blocks=lambda plane: (columns, rows))
    return tile_mask.read_mask(cursor, mode, tile_mask.blocks_in_plane(tile, 0, 0, 0)), cursor.position


def geometry_of(**fields):
    """Geometry of one level of one view, but for the fields that are given."""
    header = SimpleNamespace(
        rows=1, cols=1, width=1, height=1, tree_height=0, cluster_rows=1, cluster_cols=1, block_log2=1,
        chroma_format=0, levels=[(1, 1, 0)], balanced_groups=False, motion_tiles=False, chroma_motion=False,
    )  # fmt: skip
    vars(header).update(fields)
    return geometry.Geometry(header)


def image_number(rows, cols, tree_height, cluster_rows, cluster_cols, *image):
    tree = geometry_of(
        rows=rows, cols=cols, tree_height=tree_height, cluster_rows=cluster_rows, cluster_cols=cluster_cols
    )
    return (tree.image_number(image),)


def tile_number(width, height, chroma_format, block_log2, motion_tiles, motion_tile_log2, chroma_motion,
                image, plane, tile_x, tile_y):  # fmt: skip
    planes = geometry_of(
        width=width, height=height, chroma_format=chroma_format, block_log2=block_log2,
        motion_tiles=motion_tiles, motion_tile_log2=motion_tile_log2, chroma_motion=chroma_motion,
    )  # fmt: skip
    planes.image_number = lambda number: number
    tile = planes.tile_number(image, plane, tile_x, tile_y)
    return tile, *divmod(tile, 64)


def group(balanced, images, group_size, image):
    line = groups.Groups(images, group_size, balanced)
    return line.group_of(image), line.reference(line.group_of(image))


def reference_images(rows, cols, ref_rows, ref_cols, balanced, row, col, reference_set):
    level = geometry_of(rows=rows, cols=cols, levels=[(ref_rows, ref_cols, 0)], balanced_groups=balanced)
    found = references.references_of(level, (0, row, col), SimpleNamespace(reference_set=reference_set))
    return [number for _, *place in found for number in place]


def levels(code):
    count = bise.levels_of(code)
    return count, *bise.split(count)


def vector_fields(window):
    greatest_code = bise.least_code(2 * window + 1)
    return integers.least_bits(2 * window + 1), greatest_code, integers.least_bits(greatest_code + 1)


def sequence(code, count, start, data):
    return bise.read(BitString(data), start, count, bise.levels_of(code))


def sequence_value(code, count, start, i, data):
    return (bise.read_one(BitString(data), start, count, bise.levels_of(code), i),)


def interval(depth, plane):
    """[lo, hi] and M (STR-7)."""
    lo, hi = geometry_of(depth=depth).interval(plane)
    return lo, hi, hi - lo


def one_residual(depth, plane, level_code, value, bias, step_code):
    step, bound = residual.step_of(step_code), interval(depth, plane)[2]
    return (residual.residual_of(value, bise.levels_of(level_code), bias, step, bound),)


def prediction(depth, plane, parent, minus, reference):
    lo, hi, _ = interval(depth, plane)
    return (integers.clamp(parent + (-reference if minus else reference), lo, hi),)


def sample(depth, plane, predicted, correction):
    lo, hi, _ = interval(depth, plane)
    return (integers.clamp(predicted + correction, lo, hi),)


def vector(window, vector_precision, disparity_precision, row_scale, disparity, rows, cols):
    header = SimpleNamespace(
        window=window, vector_precision=vector_precision, disparity_precision=disparity_precision, row_scale=row_scale
    )
    entry = motion.Motion(0, motion.OWN_DISPARITY, 1)
    return references.vector_to(header, (0, 0, 0), (0, rows, cols), entry, disparity)


def explicit_vector(window, vector_precision, x, y):
    header = SimpleNamespace(window=window, vector_precision=vector_precision)
    return references.vector_to(header, None, None, motion.Motion(0, motion.EXPLICIT_VECTOR, 1, x, y), None)


def displacement(vector_precision, halved, component):
    u = interpolation.eighths(component, vector_precision, halved)
    return u >> 3, u - 8 * (u >> 3)


def interpolated(fx, fy, *samples):
    """I of MOT-9; `samples` are those at (0, 0), (1, 0), (0, 1) and (1, 1)."""
    return interpolation.interpolate(lambda x, y: samples[2 * y + x], 0, 0, fx, fy)


def one_reference(_depth, _plane, *reference):
    return (interpolation.predict([interpolated(*reference)]),)


def two_references(_depth, _plane, *both):
    return (interpolation.predict([interpolated(*both[:6]), interpolated(*both[6:])]),)


def coefficient(plane, minus, m):
    sign = 0 if m == 0 else -1 if minus else 1
    return (code_block.reconstructed(sign, m * 2**plane, plane),)


def key_plane(depth, plane, width, height, data):
    lo, hi, _ = interval(depth, plane)
    rows = jpeg2000_decoder.decode(Codestream(data, width, height, depth + (plane > 0), plane > 0))
    return [integers.clamp(sample, lo, hi) for row in rows for sample in row]


def direction(n0_hi, n0_lo, na_hi, na_lo, nb_hi, nb_lo, a, b):
    return (ray.direction((n0_hi, n0_lo), (na_hi, na_lo), (nb_hi, nb_lo), a, b),)


def slope(*n):
    found = ray.slopes(*n)
    return (1, 0, 0, 0) if found is None else (0, *found)


def place(u0, zu, sx, cols):
    u = u0 - ray.shift(zu, sx)
    if ray.misses(u, cols):
        return u, 1, 0, 0, 0
    inside = ray.in_grid(u, cols)
    return u, 0, inside, ray.nearest_view(inside), ray.near_grid(u, cols)


def picture_place(x0, gain, sx, dx, steps, width):
    xb = x0 + ray.shift(gain, sx)
    x = xb + dx * steps
    return xb, x, int(not ray.in_picture(x, width))


def weights_of_views(u, aperture, cols):
    weights = view_weights.weights_along(u, cols, aperture)
    return min(weights), *(weights[column] for column in sorted(weights))


def pixel_weights(x, width):
    nearest, _ = view_sample.part_of(x, width, False)
    return nearest, *view_sample.part_of(x, width, True)


def taps(_depth, fx, fy, *samples):
    """`samples` are those of (xi, yi), (xi + 1, yi), (xi, yi + 1) and (xi + 1, yi + 1)."""
    record = {"filter": FILTERS.index("quadrilinear"), "width": 2, "height": 2}
    sampled = view_sample.ViewSample(record, 16 * fx, 16 * fy)
    return sampled.q([[samples[2 * row + column]] for column, row, _ in sampled.taps])


def scaled_disparity(disparity_precision, apart, d):
    return (disparity_map.sixteen_bits(256 * Fraction(d, 2**disparity_precision * apart)),)


def vector_disparity(row_scale, kc, kr, cols, rows, u, v):
    header = SimpleNamespace(row_scale=row_scale, cluster_cols=kc, cluster_rows=kr)
    vector = Fraction(u, 8), Fraction(v, 8)
    number, confidence = disparity_map.along(header, (1, 0, 0), (1, rows, cols), vector)
    return disparity_map.sixteen_bits(256 * number), confidence


def displaced_place(displacement, pitch, row, place, y):
    down = ray.down_a_row(displacement, pitch)
    return down, y + ray.moved(down, row, place)


def median(*numbers):
    proposals = [SimpleNamespace(displacement=e, weight=w) for e, w in zip(numbers[::2], numbers[1::2]) if w > 0]
    return surface.agreed(proposals)


ANSWERS = {
    "field": field,
    "rank": count_bits,
    "crc": lambda count, data: (crc32c.crc32c(data),),
    "block-number": lambda i, j: (tile_mask.block_number(i, j),),
    "mask": mask,
    "image-number": image_number,
    "tile-number": tile_number,
    "group-small": group,
    "group": group,
    "references": reference_images,
    "levels": levels,
    "least-code": lambda count: (bise.least_code(count),),
    "vector-fields": vector_fields,
    "trits": lambda T: bise.trits(T),
    "quints": lambda Q: bise.quints(Q),
    "sequence-bits": lambda code, count: (bise.sequence_bits(count, bise.levels_of(code)),),
    "sequence-tail": lambda code, count, packed: bise.decode(packed, count, bise.levels_of(code)),
    "sequence": sequence,
    "sequence-value": sequence_value,
    "step": lambda code: (residual.step_of(code),),
    "residual": one_residual,
    "prediction": prediction,
    "sample": sample,
    "colour": lambda depth, y, co, cg: colour.to_rgb(y, co, cg, depth),
    "disparity-vector": vector,
    "explicit-vector": explicit_vector,
    "displacement": displacement,
    "interpolation": one_reference,
    "interpolation-two": two_references,
    "coefficient": coefficient,
    "key-plane": key_plane,
    "direction": direction,
    "slope": slope,
    "place": place,
    "picture-place": picture_place,
    "view-weights": weights_of_views,
    "pixel-weights": pixel_weights,
    "taps": taps,
    "frame-sample": lambda _depth, *pairs: frame.summed(pairs[::2], pairs[1::2]),
    "scaled-disparity": scaled_disparity,
    "vector-disparity": vector_disparity,
    "displaced-place": displaced_place,
    "surface-displacement": lambda *numbers: (surface.displacement_of(*numbers),),
    "median": median,
}
WITH_BYTES = {"field", "rank", "crc", "mask", "sequence", "sequence-value", "key-plane"}


def answered(name, line):
    """A line of the file of primitive `name` with the naive decoder's results; a comment as it is."""
    if line.startswith("#"):
        return line
    words = line.partition(" ->")[0].split()
    inputs = words[:-1] if name in WITH_BYTES else words
    data = [bytes.fromhex(words[-1].replace("-", ""))] if name in WITH_BYTES else []
    return " ".join([*words, "->", *map(str, ANSWERS[name](*map(int, inputs), *data))])


if __name__ == "__main__":
    for path in map(Path, sys.argv[1:]):
        lines = [answered(path.stem, line) for line in path.read_text().splitlines()]
        path.write_text("".join(line + "\n" for line in lines))
