#!/usr/bin/env python3
"""Tables of docs/stress.md from recorded runs, tests/stress/recorded.json.

usage: document.py --check | --update

recorded.json is a list of what `./run stress --minutes N --seed S --json` printed.
Exit status 1: with --check, the document has other tables.
"""

import json
import sys
from pathlib import Path

from reached import Reached

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
sys.path.insert(0, str(ROOT / "bench/common"))

from document_tables import check_or_update  # noqa: E402  (found only now)

DOCUMENT = ROOT / "docs/stress.md"
FRAME_CLAUSES = ("RAY", "REC", "SMP")  # of docs/rendering.md


def cells_of(report):
    """Name to text of what a run came to."""
    camera = report["cameras_against_double"]
    gaps = Reached()
    gaps.add(report["rows"])
    return {
        "CPU minutes": f"{report['cpu_seconds'] / 60:.1f}",
        "streams": spaced(report["streams"]),
        "blocks decoded one by one": spaced(report["blocks"]),
        "cameras": spaced(report["cameras"]),
        "frames of these": spaced(report["frames"]),
        "samples compared with double precision": spaced(camera["samples_compared"]),
        "largest error, in parts of the bound of ERR-1": f"{camera['worst_part_of_bound']:.3f}",
        "intervals not reached at both ends": str(len(gaps.gaps())),
        "findings": str(len(report["findings"])),
    }


def runs_table(reports):
    """What the runs were, and what each came to."""
    commands = [f"`./run stress --minutes {r['minutes']:g} --seed {r['seed']}`" for r in reports]
    yield "| | " + " | ".join(commands) + " |"
    yield "|---|" + "---|" * len(reports)
    columns = [cells_of(report) for report in reports]
    for name in columns[0]:
        yield f"| {name} | " + " | ".join(cells[name] for cells in columns) + " |"


def spaced(number):
    """12 345 from 10000 on."""
    return f"{number:,}".replace(",", " ") if number >= 10_000 else str(number)


def is_of_frames(row):
    return row["clause"].split("-")[0] in FRAME_CLAUSES


def reached_table(rows):
    reached = Reached()
    reached.add(rows)
    return reached.table()


def tables(reports):
    """Name to the lines of each table."""
    rows = [row for report in reports for row in report["rows"]]
    return {
        "runs": list(runs_table(reports)),
        "streams": list(reached_table([row for row in rows if not is_of_frames(row)])),
        "frames": list(reached_table([row for row in rows if is_of_frames(row)])),
    }


def main():
    made = tables(json.loads((FOLDER / "recorded.json").read_text(encoding="utf-8")))
    return check_or_update(__doc__, DOCUMENT, made.get, list(made))


if __name__ == "__main__":
    sys.exit(main())
