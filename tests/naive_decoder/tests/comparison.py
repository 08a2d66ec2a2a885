"""Results of the naive decoder in the form in which they are compared."""

from light_field import decode_view
from stream_error import StreamError
from trace import PLANE_NAMES


def attempt(action, *arguments):
    """What the action returns, or the name of the error that ends it."""
    try:
        return action(*arguments)
    except StreamError as error:
        return error.name


def naive_view(decoder, row, col):
    """Samples of a view, R, G, B pixel by pixel."""
    return [sample for line in decode_view(decoder, row, col) for pixel in line for sample in pixel]


def cropped(records, geometry):
    """Records of trace_block without the values outside the plane, which have no meaning (STR-6)."""
    if isinstance(records, str):
        return records
    plane, (block_x, block_y) = PLANE_NAMES.index(records[0]["plane"]), records[0]["block"]
    side = geometry.block
    width, height = geometry.plane_size(plane)
    cols, rows = min(side, width - block_x * side), min(side, height - block_y * side)
    inside = [side * y + x for y in range(rows) for x in range(cols)]
    stages = [{**record, "values": [record["values"][i] for i in inside]} for record in records[1:]]
    return records[:1] + stages
