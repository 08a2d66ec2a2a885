"""The width table of section 11: its formulas give its numbers, and values reach the ends of its
intervals but never leave them."""

import re

from extremes import quantities
from specification import read, rows_after

HEADING = "## 11"
WIDTHS = {"bits at n = 8": 8, "bits at n = 12": 12}
DEPTHS = [3, 4, 5, 8, 9, 10, 11, 12]


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


def reach_violations(row, n):
    for plane, (lo, hi) in enumerate(intervals(row, n)):
        least, most = quantities(n, plane)[row["quantity"]]
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
    yield from table_violations("widths", rows, quantities(12, 0), row_violations)
