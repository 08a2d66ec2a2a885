"""Checks cases of examples/primitives: a beginning, to which your decoder's functions are added.

python3 examples/primitives.py colour
"""

import sys
from pathlib import Path


def clamp(x, lo, hi):
    return min(max(x, lo), hi)


def colour(depth, y, co, cg):  # COL-2
    t = y - (cg >> 1)
    g, b = cg + t, t - (co >> 1)
    return [clamp(value, 0, 2**depth - 1) for value in (b + co, g, b)]


def block_number(i, j):  # TIL-2
    return [4 * (4 * (j >> 1) + (i >> 1)) + 2 * (j & 1) + (i & 1)]


FUNCTIONS = {"colour": colour, "block-number": block_number}

name, *files = sys.argv[1:]
path = Path(files[0]) if files else Path(__file__).parent / "primitives" / f"{name}.txt"
cases = [line.partition("->") for line in path.read_text().splitlines() if line[0] != "#"]
for inputs, _, results in cases:
    found = FUNCTIONS[name](*map(int, inputs.split()))
    if found != [int(result) for result in results.split()]:
        sys.exit(print(f"{name} {inputs}-> {found} instead of{results}") or 1)
print(f"{name}: {len(cases)} cases, all right")
