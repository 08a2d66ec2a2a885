#!/usr/bin/env python3
"""Seconds that the tests of each label took, from the JUnit report of ./run test.

usage: label_costs.py BUILD             print them
       label_costs.py BUILD --update    write them into the table of CONTRIBUTING.md
       label_costs.py BUILD --check     exit status 1 where a label of the tests is not in the table
"""

import json
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

DOCUMENT = Path(__file__).resolve().parents[2] / "CONTRIBUTING.md"
ROW = re.compile(r"^\| ([a-z_, ]+) \| (.*) \| [\d ]*\|$", re.MULTILINE)


def times(junit):
    """Seconds by test."""
    return {test.get("name"): float(test.get("time"))
            for test in ElementTree.parse(junit).getroot().iter("testcase")}


def cost(seconds, labels, wanted):
    """Seconds of all tests with one of the labels `wanted`; None where none ran."""
    taken = [time for test, time in seconds.items() if set(labels.get(test, [])) & set(wanted)]
    return sum(taken) if taken else None


def updated(text, seconds, labels):
    """CONTRIBUTING.md with the costs; a row none of whose tests ran has an empty cell."""
    def row(match):
        taken = cost(seconds, labels, match[1].split(", "))
        return f"| {match[1]} | {match[2]} | {'' if taken is None else f'{taken:.0f} '}|"
    return ROW.sub(row, text)


def missing(text, labels):
    """The labels without a row."""
    rows = {label for match in ROW.finditer(text) for label in match[1].split(", ")}
    return sorted(set(labels) - rows)


def labels_of(build):
    """Labels by test."""
    command = ["ctest", "--test-dir", str(build), "--show-only=json-v1"]
    tests = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["tests"]
    return {test["name"]: entry["value"] for test in tests
            for entry in test.get("properties", []) if entry["name"] == "LABELS"}


def main():
    build = Path(sys.argv[1])
    text = DOCUMENT.read_text(encoding="utf-8")
    labels = labels_of(build)
    if sys.argv[2:] == ["--check"]:
        lost = missing(text, sum(labels.values(), []))
        print("".join(f"CONTRIBUTING.md: no row for label {label}\n" for label in lost), end="")
        return 1 if lost else 0
    seconds = times(build / "junit.xml")
    if sys.argv[2:] == ["--update"]:
        DOCUMENT.write_text(updated(text, seconds, labels), encoding="utf-8")
    else:
        for label in sorted(set(sum(labels.values(), []))):
            print(f"{label:12} {cost(seconds, labels, [label]) or 0:8.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
