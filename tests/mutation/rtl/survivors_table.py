#!/usr/bin/env python3
"""The mutants of survivors.json as the table `rtl_survivors` of docs/verification.md.

usage: survivors_table.py --check | --update

Exit status 1: with --check, the document has another table.
"""

import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "bench/common"))

from document_tables import check_or_update  # noqa: E402  (found only now)

DOCUMENT = ROOT / "docs/verification.md"
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


def row(entry):
    """Of the lines that Yosys names for a bit, the last is the one that it is most about."""
    command = COMMAND.match(entry["command"])
    lines = [line for line in LINE.findall(entry["command"]) if line != "0"]
    cell = PLACE_IN_NAME.sub("", command["cell"].lstrip("$"))
    bit = f"`{cell}.{command['port']}[{command['bit']}]`"
    mode = MODES[command["mode"]].format(control=command["control"])
    cells = [entry["module"], lines[-1] if lines else "", bit, mode, entry["reason"]]
    return f"| {' | '.join(cells)} |"


def table(survivors):
    head = ["| module | line | bit of a cell's port | is | why it survives |", "|---|---|---|---|---|"]
    return head + [row(entry) for entry in survivors]


def main():
    survivors = json.loads(Path(__file__).with_name("survivors.json").read_text(encoding="utf-8"))
    return check_or_update(__doc__, DOCUMENT, lambda name: table(survivors), ["rtl_survivors"])


if __name__ == "__main__":
    sys.exit(main())
