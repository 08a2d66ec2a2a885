#!/usr/bin/env python3
"""The program of README.md prints the samples that hmlfc inspect has of the same block.

usage: check_example.py EXAMPLE HMLFC FILE.hmlfc
"""

import json
import subprocess
import sys


def main():
    example, hmlfc, stream = sys.argv[1:]
    place = ["--view", "3,2", "--plane", "Y", "--block", "2,5", "--json"]
    report = json.loads(subprocess.run([hmlfc, "inspect", stream, *place], check=True, stdout=subprocess.PIPE).stdout)
    rows = report["levels"][-1]["stages"]["sample"]["values"]
    expected = [value for row in rows for value in row]
    printed = subprocess.run([example, stream], check=True, stdout=subprocess.PIPE, text=True).stdout
    if [int(word) for word in printed.split()] != expected or len(expected) != 16:
        print(f"README's program prints\n{printed}\nnot\n{expected}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
