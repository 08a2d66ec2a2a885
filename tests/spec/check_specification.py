#!/usr/bin/env python3
"""Checks the specification against the model and against itself; prints each violation.

citations     every clause cited exists; every clause that a decoder follows is cited in its layers
errors        annex A has the numbers, names and meanings of the model
records       the tables of records have the fields that the model reads in the conformance vectors
widths        the numbers of section 11 follow from its formulas, and no value leaves its interval
frame_widths  the same for section 6 of docs/rendering.md
width_probes  the model watches every row of both width tables, and nothing else (./run stress)
"""

import argparse
import sys
from pathlib import Path

import citations
import error_table
import frame_widths
import records
import width_probes
import widths

CHECKS = {
    "citations": citations,
    "errors": error_table,
    "records": records,
    "widths": widths,
    "frame_widths": frame_widths,
    "width_probes": width_probes,
}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("check", choices=CHECKS)
    parser.add_argument("root", type=Path, help="the repository")
    arguments = parser.parse_args()
    found = list(CHECKS[arguments.check].violations(arguments.root.resolve()))
    for violation in found:
        print(violation)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
