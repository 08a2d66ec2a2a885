#!/usr/bin/env python3
"""The clauses of the specification by vectors and implementations, as the table of docs/verification.md.

A cell is filled where a file of the implementation cites the clause and it takes a vector of it: one
that its declaration in vectors/duts does not exclude, or, with --report, one that it passed. The
reasons of empty cells stand in tests/clauses/reasons.json. Exit status 1: a cell is empty without a
reason, a reason fits no cell, a clause is unknown, or, with --check, the table in the document is
another.
"""

import argparse
import json
import string
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/spec"))

from clause_cells import COLUMNS, VECTORS, ClauseCells  # noqa: E402  (its modules are found only now)
from implementations import FOLDERS, claimed_vectors, passed_vectors  # noqa: E402

DOCUMENT = ROOT / "docs/verification.md"
BEGIN, END = "<!-- ./run clauses --update -->\n", "<!-- end of clauses -->\n"
HEADS = {"model": "model", "naive": "naive", "rtl": "RTL", "gpu": "GPU"}


def markdown(cells):
    """The table, and below it the reasons by the letters that stand in its cells."""
    reasons = [entry["reason"] for entry in cells.reasons]
    letter = dict(zip(reasons, string.ascii_lowercase, strict=False))
    lines = [
        f"| clause | vectors | for example | {' | '.join(HEADS.values())} |",
        f"|---|---|---|{'---|' * len(HEADS)}",
    ]
    for clause in cells.clauses:
        row = [clause, *vector_cells(cells, clause, letter)]
        row += [implementation_cell(cells, name, clause, letter) for name in FOLDERS]
        lines.append(f"| {' | '.join(row)} |")
    lines.append("")
    lines += [f"- *{letter[reason]}*: {reason}." for reason in reasons]
    return "".join(f"{line}\n" for line in lines)


def vector_cells(cells, clause, letter):
    """How many vectors, and the most specific one."""
    vectors = cells.vectors(clause)
    if vectors:
        return str(len(vectors)), f"`{vectors[0]}`"
    return f"*{letter.get(cells.reason(VECTORS, clause), '')}*", ""


def implementation_cell(cells, name, clause, letter):
    """The file that is most about the clause; in brackets the vectors taken, where they are not all."""
    if cells.reason(name, clause):
        return f"*{letter[cells.reason(name, clause)]}*"
    files = cells.files(name, clause)
    if not files:
        return ""
    taken = len(cells.taken(name, clause))
    return f"`{Path(files[0]).name}`" + (f" ({taken})" if taken < len(cells.vectors(clause)) else "")


def as_json(cells):
    """Everything, for programs."""
    return [
        {
            "clause": clause,
            "vectors": cells.vectors(clause),
            "reasons": {c: cells.reason(c, clause) for c in COLUMNS if cells.reason(c, clause)},
            "implementations": {
                name: {"files": cells.files(name, clause), "vectors": len(cells.taken(name, clause))}
                for name in FOLDERS
            },
        }
        for clause in cells.clauses
    ]


def with_table(text, table):
    """The document `text` with another table between its two marks."""
    before, _, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        sys.exit(f"{DOCUMENT}: the lines {BEGIN.strip()} and {END.strip()} are missing")
    return f"{before}{BEGIN}{table}{END}{after}"


def main():
    parser = argparse.ArgumentParser(
        prog="./run clauses", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--program", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--json", action="store_true", help="for programs, with all vectors and files")
    parser.add_argument("--report", nargs="+", metavar="FILE", help="report.json of hmlfc conform: what passed counts")
    parser.add_argument("--update", action="store_true", help="write the table into docs/verification.md")
    parser.add_argument("--check", action="store_true", help="print no table, but compare it with the document")
    arguments = parser.parse_args()
    manifest = json.loads((ROOT / "vectors/manifest.json").read_text())
    taken = passed_vectors(arguments.report) if arguments.report else claimed_vectors(arguments.program, ROOT)
    cells = ClauseCells(ROOT, manifest, taken)
    complaints = list(cells.complaints())
    table = markdown(cells)
    document = with_table(DOCUMENT.read_text(), table)
    if arguments.check and document != DOCUMENT.read_text():
        complaints.append("docs/verification.md has another table: run ./run clauses --update")
    if arguments.update:
        DOCUMENT.write_text(document)
    if arguments.json:
        print(json.dumps({"clauses": as_json(cells), "complaints": complaints}, indent=2))
    elif not arguments.check:
        print(table)
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
