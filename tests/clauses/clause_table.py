#!/usr/bin/env python3
"""The clauses of the specification by vectors and implementations, as docs/results/clauses.md.

A cell is filled where a file of the implementation cites the clause and it takes a vector of it: one
that its declaration in vectors/duts does not exclude. The reasons of empty cells stand in
tests/clauses/reasons.json. Exit status 1: a cell is empty without a reason, a reason fits no cell, a
clause is unknown, or, with --check, the written table is another.
"""

import argparse
import json
import string
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/spec"), str(ROOT / "bench/common")]

import result_file  # noqa: E402  (its modules are found only now)
from clause_cells import FRAMES, ClauseCells  # noqa: E402
from implementations import claimed_vectors  # noqa: E402

INTRODUCTION = """Every clause of the [specification](../specification.md): how many vectors exercise it
(`hmlfc vectors list --clause` names them), the most specific of them, and in each implementation the file
that cites it most. A number in brackets says how many of the vectors the implementation takes where it does
not take all. A letter stands for the reason why a cell is empty."""
FRAMES_INTRODUCTION = """The clauses of [rendering](../rendering.md) by frames of the suite
(`hmlfc vectors list --frames --clause`) and renderers."""
HEADS = {"model": "model", "naive": "naive", "rtl": "RTL", "gpu": "GPU"}


def markdown(cells):
    """The lines of the table, and below it the reasons by the letters that stand in its cells."""
    reasons = list(dict.fromkeys(entry["reason"] for entry in cells.reasons))
    letter = dict(zip(reasons, string.ascii_lowercase, strict=False))
    rows = [
        (clause, *vector_cells(cells, clause, letter),
         *(implementation_cell(cells, name, clause, letter) for name in cells.implementations))
        for clause in cells.clauses
    ]
    lines = result_file.table(("clause", cells.kind, "for example", *(HEADS[name] for name in cells.implementations)), rows)
    return [*lines, "", *(f"- *{letter[reason]}*: {reason}." for reason in reasons)]


def vector_cells(cells, clause, letter):
    """How many vectors, and the most specific one."""
    vectors = cells.vectors(clause)
    if vectors:
        return str(len(vectors)), f"`{vectors[0]}`"
    return f"*{letter.get(cells.reason(cells.kind, clause), '')}*", ""


def implementation_cell(cells, name, clause, letter):
    """The file that is most about the clause; in brackets the vectors taken, where they are not all."""
    if cells.reason(name, clause):
        return f"*{letter[cells.reason(name, clause)]}*"
    files = cells.files(name, clause)
    if not files:
        return ""
    taken = len(cells.taken(name, clause))
    return f"`{Path(files[0]).name}`" + (f" ({taken})" if taken < len(cells.vectors(clause)) else "")


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="./run clauses", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--program", type=Path, required=True, help=argparse.SUPPRESS)
    result_file.add_arguments(parser)
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    manifest = json.loads((ROOT / "vectors/manifest.json").read_text())
    cells = ClauseCells(ROOT, manifest, claimed_vectors(arguments.program, ROOT))
    frames = ClauseCells(ROOT, manifest, claimed_vectors(arguments.program, ROOT, frames=True), FRAMES)
    complaints = [*cells.complaints(), *frames.complaints()]
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    status = 1 if complaints else 0
    if arguments.check or arguments.update:
        tables = [
            ("The table", [INTRODUCTION, "", *markdown(cells)]),
            ("Rendering", [FRAMES_INTRODUCTION, "", *markdown(frames)]),
        ]
        text = result_file.result_text("Clauses, vectors and implementations", "./run clauses --update", tables)
        return max(status, result_file.settle(arguments.results / "clauses.md", text, arguments.update))
    print("\n".join([*markdown(cells), "", *markdown(frames)]))
    return status


if __name__ == "__main__":
    sys.exit(main())
