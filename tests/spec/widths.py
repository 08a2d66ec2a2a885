"""The width table of section 11: its formulas give its numbers, and values reach the ends of its
intervals but never leave them."""

import re
from functools import cache

from extremes import (
    DISPARITIES,
    Tried,
    eighths,
    most_images,
    most_tiles,
    reference_offsets,
    scaled_disparities,
    vector_components,
)
from specification import read, rows_after

HEADING = "## 11"
WIDTHS = {"bits at n = 8": 8, "bits at n = 12": 12}
DEPTHS = [3, 4, 5, 8, 9, 10, 11, 12]

# Each row of the table: (least, greatest) of plane 0 = Y or 1 = Co, Cg at a depth.
QUANTITIES = {
    "sample, parent P": lambda tried, plane: tried.samples[plane],
    "residual bound M": lambda tried, plane: (0, tried.bounds[plane]),
    "BISE value": lambda tried, plane: (0, max(tried.level_counts()) - 1),
    "bias": lambda tried, plane: tried.biases(),
    "residual before its clamp": lambda tried, plane: tried.unclamped_residual(),
    "residual, SRV reference": Tried.residual,
    "ref": Tried.reference,
    "P + sign * ref": Tried.phased,
    "A + residual": Tried.corrected,
    "vector component": lambda tried, plane: (-127, 127),
    "step * residual": Tried.stepped,
    "disparity": lambda tried, plane: DISPARITIES,
    "explicit_x, explicit_y": lambda tried, plane: (-(2**11), 2**11 - 1),
    "rk - r, ck - c": lambda tried, plane: reference_offsets(),
    "d * row_scale * (rk - r)": lambda tried, plane: scaled_disparities(),
    "vx, vy": lambda tried, plane: vector_components(),
    "u": lambda tried, plane: eighths(),
    "I": Tried.interpolated,
    "I_first + I_second + 64": Tried.two_interpolated,
    "t": lambda tried, plane: tried.ends(tried.t_values()),
    "G before its clamp": lambda tried, plane: tried.green(),
    "B before its clamp": lambda tried, plane: tried.blue(),
    "R before its clamp": lambda tried, plane: tried.red(),
    "image number": lambda tried, plane: (0, most_images() - 1),
    "tile number": lambda tried, plane: (0, most_tiles() - 1),
    "bit position in a tile record": lambda tried, plane: (0, tried.longest_record()),
}


def evaluate(formula, n):
    """The value of a formula such as 3(2^(n-1) - 1)."""
    expression = re.sub(r"(?<=[\dn)])\s*(?=\()", "*", formula.replace("^", "**"))
    return eval(expression, {"__builtins__": {}}, {"n": n})  # pylint: disable=eval-used


def interval(cell, n):
    """(lo, hi) of a cell: "[a, b]", or the greatest value alone."""
    match = re.fullmatch(r"\[(.*), (.*)\]", cell)
    if match:
        return evaluate(match.group(1), n), evaluate(match.group(2), n)
    return 0, evaluate(cell, n)


def needed_bits(lo, hi):
    """Bits of [lo, hi], in two's complement where lo is negative."""
    if lo >= 0:
        return hi.bit_length()
    return 1 + max(hi.bit_length(), (-lo - 1).bit_length())


def intervals(row, n):
    """The row's intervals: of Y, and of Co and Cg where the table has them."""
    cells = [row["Y"], row["Co, Cg"]]
    if not cells[0]:
        return [interval(row["formula"], n)]
    if cells[1] == "the same":
        cells[1] = cells[0]
    return [interval(cell, n) for cell in cells if cell]


def row_violations(row):
    for column, n in WIDTHS.items():
        found = intervals(row, n)
        bits = max(needed_bits(lo, hi) for lo, hi in found)
        if bits != int(row[column]):
            yield f"{column} should be {bits}, not {row[column]}: the interval is {found}"
    for n in DEPTHS:
        found = list(reach_violations(row, n))
        yield from found
        if found:
            return


@cache
def extremes(quantity, n, plane):
    return QUANTITIES[quantity](Tried(n), plane)


def reach_violations(row, n):
    for plane, (lo, hi) in enumerate(intervals(row, n)):
        least, most = extremes(row["quantity"], n, plane)
        if least < lo or most > hi:
            yield f"at n = {n} values reach [{least}, {most}], past [{lo}, {hi}]"
        elif (least, most) != (lo, hi):
            yield f"at n = {n} values reach [{least}, {most}] only, not [{lo}, {hi}]"


def table_violations(name, rows, known, of_row):
    """Those of each row by of_row(row); a table without a quantity of `known`, or with another, is at fault."""
    for row in rows:
        if row["quantity"] not in known:
            yield f"{name}: {row['quantity']} is not in the quantities of tests/spec"
        else:
            yield from (f"{name}: {row['quantity']}: {violation}" for violation in of_row(row))
    for quantity in known.keys() - {row["quantity"] for row in rows}:
        yield f"{name}: {quantity} is missing"


def violations(root):
    rows = rows_after(read(root), HEADING)
    yield from table_violations("widths", rows, QUANTITIES, row_violations)
