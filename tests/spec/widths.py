"""The width tables, section 11 of the specification and section 6 of docs/rendering.md: their intervals give
their bits. That values reach both ends of each interval, and never leave it, is tested where they are
computed (./run stress)."""

import re

from specification import RENDERING, read, rows_after

HEADING = "## 11"
FRAME_HEADING = "## 6"
WIDTHS = {"bits at n = 8": 8, "bits at n = 12": 12}
DEEPEST = 12
FRAME_BITS = re.compile(r"(\d+)(?: unsigned)?( \(n = 12\))?")


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
    """The intervals of a row of section 11: of Y, and of Co and Cg where the table has them."""
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
            yield f"{row['quantity']}: {column} should be {bits}, not {row[column]}: the interval is {found}"


def frame_row_violations(row):
    found = interval(row["interval"], DEEPEST)
    bits, at_depth = FRAME_BITS.fullmatch(row["bits"]).groups()
    if needed_bits(*found) != int(bits):
        yield f"{row['quantity']}: bits should be {needed_bits(*found)}, not {row['bits']}: the interval is {found}"
    if ("n" in row["interval"]) != bool(at_depth):
        yield f"{row['quantity']}: bits name a depth where, and only where, the interval depends on it"


def violations(root):
    for row in rows_after(read(root), HEADING):
        yield from row_violations(row)
    for row in rows_after(read(root, RENDERING), FRAME_HEADING):
        yield from frame_row_violations(row)
