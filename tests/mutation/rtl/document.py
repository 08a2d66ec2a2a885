#!/usr/bin/env python3
"""Writes and checks docs/results/rtl_mutants.md: what became of the mutants of the decode unit and the
view unit, by recorded.json and survivors.json.

Exit status 1: with --check, the written tables are others.
"""

import argparse
import collections
import json
import re
import sys
from pathlib import Path

import record
import refute

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[2] / "bench/common"))

import result_file  # noqa: E402  (found only now)

COLUMNS = ("module", "mutants", "found by a vector", "by a test of the bench", "by a proof of the module", "equivalent",
           "other clocks alone", "survive, explained", "not explained", "no result yet")
COMMAND = re.compile(
    r"mutate -mode (?P<mode>\w+) -module top -cell (?P<cell>\S+) -port (?P<port>\S+)"
    r" -portbit (?P<bit>\d+)(?: -ctrlbit (?P<control>\d+))?"
)
# Yosys names cells after the line that they come from; the table has a column for it.
PLACE_IN_NAME = re.compile(r"\$hmlfc_\w+\.svh?:\d+\$\d+$")
LINE = re.compile(r"-src hmlfc_\w+\.sv:(\d+)")
MODES = {
    "inv": "inverted",
    "const0": "0",
    "const1": "1",
    "cnot0": "inverted where bit {control} is 0",
    "cnot1": "inverted where bit {control} is 1",
}


def survivor(entry):
    """Of the lines that Yosys names for a bit, the last is the one that it is most about."""
    command = COMMAND.match(entry["command"])
    lines = [line for line in LINE.findall(entry["command"]) if line != "0"]
    cell = PLACE_IN_NAME.sub("", command["cell"].lstrip("$"))
    bit = f"`{cell}.{command['port']}[{command['bit']}]`"
    mode = MODES[command["mode"]].format(control=command["control"])
    return entry["module"], lines[-1] if lines else "", bit, mode, entry["reason"]


def outcomes(recorded):
    """Rows of module, mutants, found by a vector, by a test of the bench, by a proof of the module,
    equivalent, of other clocks, surviving with a reason, without a reason, and without a result yet."""
    rows, total = [], collections.Counter()
    for kept in recorded.values():
        by_check = record.found_by(kept)
        for module, made in kept["made"].items():
            checks = [by_check[number] for number in made if number in by_check]
            proofs = sum(check.startswith(refute.PREFIX) for check in checks)
            tests = sum("." in check for check in checks) - proofs  # no vector has one in its name
            ends = [len(set(made) & set(kept[end])) for end in record.ENDS]
            counts = [len(made), len(checks) - tests - proofs, tests, proofs, *ends, len(made) - len(checks) - sum(ends)]
            rows.append((module, *counts))
            total.update(dict(enumerate(counts)))
    return rows + [("all", *(total[at] for at in range(len(COLUMNS) - 1)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    result_file.add_arguments(parser)
    options = parser.parse_args()
    recorded = record.read()
    survivors = json.loads((FOLDER / "survivors.json").read_text(encoding="utf-8"))
    why = ("module", "line", "bit of a cell's port", "is", "why it survives")
    tables = [
        ("Mutants by module", result_file.table(COLUMNS, outcomes(recorded))),
        ("Survivors", result_file.table(why, map(survivor, survivors))),
    ]
    text = result_file.result_text("Mutants of the decode unit and the view unit", "tests/mutation/rtl/document.py --update", tables)
    return result_file.settle(options.results / "rtl_mutants.md", text, options.update)


if __name__ == "__main__":
    sys.exit(main())
