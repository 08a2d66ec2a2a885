"""Answers cases of `hmlfc primitives gen`: a beginning, to which your decoder's functions are added.

./run primitives gen colour | python3 examples/primitives.py colour | ./run primitives check colour
"""

import sys


def clamp(x, lo, hi):
    return min(max(x, lo), hi)


def colour(depth, y, co, cg):  # COL-2
    t = y - (cg >> 1)
    g, b = cg + t, t - (co >> 1)
    return [clamp(value, 0, 2**depth - 1) for value in (b + co, g, b)]


def block_number(i, j):  # TIL-2
    return [4 * (4 * (j >> 1) + (i >> 1)) + 2 * (j & 1) + (i & 1)]


FUNCTIONS = {"colour": colour, "block-number": block_number}

for line in sys.stdin:
    results = FUNCTIONS[sys.argv[1]](*map(int, line.split()))
    print(line.strip(), *results)
