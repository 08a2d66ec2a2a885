#!/usr/bin/env python3
"""Seconds that the tests of each label took, from the JUnit report of ./run test.

usage: label_costs.py JUNIT [--update]    --update: into the table of CONTRIBUTING.md, else printed
"""

import re
import sys
from pathlib import Path
from xml.etree import ElementTree

DOCUMENT = Path(__file__).resolve().parents[2] / "CONTRIBUTING.md"
ROW = re.compile(r"^\| ([a-z_, ]+) \| (.*) \| [\d ]*\|$", re.MULTILINE)


def costs(junit):
    """Seconds by label."""
    seconds = {}
    for test in ElementTree.parse(junit).getroot().iter("testcase"):
        for entry in test.iter("property"):
            if entry.get("name") == "cmake_labels":
                for label in filter(None, entry.get("value").split(";")):
                    seconds[label] = seconds.get(label, 0) + float(test.get("time"))
    return seconds


def updated(text, seconds):
    """CONTRIBUTING.md with the costs; a row without a test that ran has none."""
    def row(match):
        found = [seconds[label] for label in match[1].split(", ") if label in seconds]
        return f"| {match[1]} | {match[2]} | {f'{sum(found):.0f} ' if found else ''}|"
    return ROW.sub(row, text)


def main():
    seconds = costs(sys.argv[1])
    if sys.argv[2:] == ["--update"]:
        DOCUMENT.write_text(updated(DOCUMENT.read_text(encoding="utf-8"), seconds), encoding="utf-8")
    else:
        for label in sorted(seconds, key=seconds.get, reverse=True):
            print(f"{label:12} {seconds[label]:8.1f}")


if __name__ == "__main__":
    main()
