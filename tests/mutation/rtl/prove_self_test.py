#!/usr/bin/env python3
"""Whether the proofs tell mutants whose end is known.

usage: prove_self_test.py FOLDER

FOLDER is that of plant.py. Exit: 0 all as known, 1 not (each wrong answer is printed).
"""

import pathlib
import sys

import prove
import units

SECONDS = 60


def planted(module: str, cell: str, port: str, bit: int) -> dict:
    """A mutant with a bit of a port of a cell inverted, in the first variant of a module."""
    variant = next(number for number, unit in enumerate(units.VARIANTS) if unit.module == module)
    return {"variant": variant, "command": f"mutate -mode inv -module top -cell {cell} -port {port} -portbit {bit}"}


# What registers hold before they are first written must not count as a difference, nor a bit of the stream's shape that the module
# inside does not use.
KNOWN = [
    (planted("motion_blocks", "place", "stream", 121), prove.EQUIVALENT),
    (planted("tile_vectors", "reader_x", "window", 0), prove.DIFFERS),
    (planted("bise_unpack", "gen_trits[0].decode", "trits", 0), prove.DIFFERS),  # a pipeline
]


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    wrong = 0
    for mutant, known in KNOWN:
        found = prove.prove(mutant, pathlib.Path(arguments[0]).resolve(), SECONDS)
        wrong += found != known
        print(f"{mutant['command']}: {found}{'' if found == known else ', must be ' + known}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
