#!/usr/bin/env python3
"""Checks the specification against the model and against itself; prints each violation.

citations     every clause cited exists; every clause that a decoder follows is cited in its layers
error_table   annex A has the numbers, names and meanings of the model
records       the tables of records have the fields that the model reads in the conformance vectors
widths        the bits of section 11, and of section 6 of docs/rendering.md, follow from their intervals
width_probes  the model watches every row of both width tables, and nothing else (./run stress)

usage: check_specification.py CHECK REPOSITORY
"""

import importlib
import sys
from pathlib import Path


def main():
    check, root = sys.argv[1:]
    found = list(importlib.import_module(check).violations(Path(root).resolve()))
    for violation in found:
        print(violation)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
