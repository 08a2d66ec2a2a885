#!/usr/bin/env python3
"""Writes and checks docs/results/rtl_mutants.md: what became of the mutants of the decode unit, by
recorded.json and survivors.json.

Exit status 1: with --check, the written tables are others.
"""

import argparse
import collections
import json
import re
import sys
from pathlib import Path

import plant
import units

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[2] / "bench/common"))

import result_file  # noqa: E402  (found only now)

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


def outcomes(recorded, survivors):
    """Rows of module, mutants, found, equivalent, surviving. What no vector finds and has no reason to
    survive is proved equivalent, or `./run mutate rtl` fails."""
    of_number = [unit.module for unit, share in zip(units.VARIANTS, plant.shares(recorded["mutants"]))
                 for _ in range(share)]
    made = collections.Counter(of_number)
    found = collections.Counter(
        of_number[number - 1] for numbers in recorded["found"].values() for number in numbers
    )
    alive = collections.Counter(entry["module"] for entry in survivors)
    for counts in (made, found, alive):
        counts["all"] = counts.total()
    return [(name, made[name], found[name], made[name] - found[name] - alive[name], alive[name])
            for name in made]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    result_file.add_arguments(parser)
    options = parser.parse_args()
    recorded, survivors = (
        json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8")) for name in ("recorded", "survivors")
    )
    head = ("module", "mutants", "found by a vector", "equivalent", "survive")
    why = ("module", "line", "bit of a cell's port", "is", "why it survives")
    tables = [
        ("Mutants by module", result_file.table(head, outcomes(recorded, survivors))),
        ("Survivors", result_file.table(why, map(survivor, survivors))),
    ]
    text = result_file.result_text("Mutants of the decode unit", "tests/mutation/rtl/document.py --update", tables)
    return result_file.settle(options.results / "rtl_mutants.md", text, options.update)


if __name__ == "__main__":
    sys.exit(main())
