#!/usr/bin/env python3
"""Writes and checks docs/results/stress.md, the tables of long runs of ./run stress.

usage: document.py --record REPORT... | --update | --check

--record: copies reports of `./run stress --minutes N --seed S --json` into tests/stress/recorded.json.
Exit status 1: with --check, the written tables differ.
"""

import argparse
import json
import sys
from pathlib import Path

from reached import Reached

import result_file  # found by the path that reached adds

RECORDED = Path(__file__).resolve().with_name("recorded.json")
FRAME_CLAUSES = ("GEO", "RAY", "REC", "SMP")  # of docs/rendering.md


def merged(reports):
    """The content of recorded.json: the runs, and what they reached together."""
    reached = Reached()
    runs = []
    for report in reports:
        own = Reached()
        own.add(report["rows"])
        reached.add(report["rows"])
        camera = report["cameras_against_double"]
        runs.append({
            "command": f"./run stress --minutes {report['minutes']:g} --seed {report['seed']}",
            "CPU minutes": round(report["cpu_seconds"] / 60, 1),
            "streams": report["streams"],
            "blocks decoded one by one": report["blocks"],
            "cameras": report["cameras"],
            "frames of these": report["frames"],
            "samples compared with double precision": camera["samples_compared"],
            "largest error, in parts of the bound of ERR-1": round(camera["worst_part_of_bound"], 3),
            "intervals not reached at both ends": len(own.gaps()),
            "findings": len(report["findings"]),
        })
    return {"runs": runs, "rows": list(reached.rows.values())}


def write(recorded):
    """Writes recorded.json, one run or row a line."""
    groups = (f'"{key}": [\n' + ",\n".join(map(json.dumps, rows)) + "\n]" for key, rows in recorded.items())
    RECORDED.write_text("{" + ",\n".join(groups) + "}\n", encoding="utf-8")


def spaced(number):
    """12 345 from 10000 on."""
    return f"{number:,}".replace(",", " ") if number >= 10_000 else str(number)


def runs_table(runs):
    """A column for each run."""
    columns = [list(run.values()) for run in runs]
    rows = [(name, *map(spaced, values)) for name, *values in zip(list(runs[0])[1:], *(c[1:] for c in columns))]
    return result_file.table(("", *(f"`{column[0]}`" for column in columns)), rows)


def reached_table(rows, of_frames):
    reached = Reached()
    reached.add([row for row in rows if (row["clause"].split("-")[0] in FRAME_CLAUSES) == of_frames])
    return reached.table()


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, usage=argparse.SUPPRESS, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--record", nargs="+", type=Path, default=[], metavar="REPORT")
    result_file.add_arguments(parser)
    options = parser.parse_args()
    if options.record:
        write(merged([json.loads(path.read_text(encoding="utf-8")) for path in options.record]))
    recorded = json.loads(RECORDED.read_text(encoding="utf-8"))
    tables = [
        ("Runs", runs_table(recorded["runs"])),
        ("Quantities of streams: proved and reached", reached_table(recorded["rows"], of_frames=False)),
        ("Quantities of frames: proved and reached", reached_table(recorded["rows"], of_frames=True)),
    ]
    text = result_file.result_text("Numerical stress", "tests/stress/document.py --update", tables)
    return result_file.settle(options.results / "stress.md", text, options.update or options.record)


if __name__ == "__main__":
    sys.exit(main())
