#!/usr/bin/env python3
"""Coverage of the decode unit: runs a set of sequences on units that count, and prints what they reached.

The sequences are random streams of both profiles, intact and damaged, with directed and random
requests, faulty memory, resets and every kind of stall (rtl-random), from a stated seed on. Counts of
lines, branches and toggles are merged by verilator_coverage and summed over the instances and
parameter sets of a module; functional points come from the test bench.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

KINDS = ("line", "branch", "toggle")
SEEDS_AT_ONCE = 10  # between two merges
POINT = re.compile("\x01([^\x02]+)\x02([^\x01']*)")


def parse_points(text):
    """Maps (kind, module, line, column, what) to the count over all instances in a merged file."""
    points = defaultdict(int)
    for line in text.splitlines():
        if not line.startswith("C '"):
            continue
        fields = dict(POINT.findall(line))
        kind = fields["page"].split("/")[0].removeprefix("v_")
        key = (kind, Path(fields["f"]).stem, int(fields["l"]), int(fields["n"]), fields["o"])
        points[key] += int(line.rsplit(" ", 1)[1])
    return points


def summarise(points):
    """Maps module to kind to (covered, all)."""
    table = defaultdict(lambda: {kind: [0, 0] for kind in KINDS})
    for (kind, module, *_), count in points.items():
        if kind in KINDS:
            table[module][kind][0] += count > 0
            table[module][kind][1] += 1
    return {module: table[module] for module in sorted(table)}


def missed(points, kind):
    """What was never reached, as "module.sv:line: what"."""
    return [
        f"{module}.sv:{line}: {what}"
        for (its_kind, module, line, _, what), count in sorted(points.items())
        if its_kind == kind and count == 0
    ]


def percent(covered, total):
    return 100.0 * covered / total if total else 100.0


def show(summary, functional):
    """The table for people."""
    total = {kind: [sum(row[kind][i] for row in summary.values()) for i in (0, 1)] for kind in KINDS}
    print(f"{'module':<26}" + "".join(f"{kind:>24}" for kind in KINDS))
    for module, row in [*summary.items(), ("all", total)]:
        cells = (f"{covered:>8} /{points:>6} {percent(covered, points):6.1f} %" for covered, points in row.values())
        print(f"{module:<26}" + "".join(cells))
    print(f"functional points: {sum(count > 0 for count in functional.values())} of {len(functional)}")
    for name in [name for name, count in functional.items() if count == 0]:
        print(f"  not met: {name}")


def merge(folder, merged):
    """Merges the data files of folder, and what is merged already, into one file."""
    files = sorted(folder.glob("*.dat"))
    if merged.exists():
        files.append(merged)
    result = folder / "merged"
    subprocess.run(
        ["verilator_coverage", "--write", result, *files], check=True, stdout=subprocess.DEVNULL
    )
    for file in folder.glob("*.dat"):
        file.unlink()
    result.rename(merged)


def run_seeds(program, seed, count, work, merged, functional):
    """Runs rtl-random on these seeds; adds to merged and functional."""
    points_file = work / "points.json"
    environment = dict(os.environ, HMLFC_RTL_COVERAGE_DIR=str(work))
    command = [program, "random", "--seed", str(seed), "--count", str(count), "--points", points_file]
    result = subprocess.run(command, env=environment, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"rtl-coverage: the decode unit differs from the model:\n{result.stdout}{result.stderr}")
    for name, hits in json.loads(points_file.read_text()).items():
        functional[name] = functional.get(name, 0) + hits
    merge(work, merged)


def main():
    parser = argparse.ArgumentParser(prog="./run rtl-coverage", description=__doc__)
    parser.add_argument("program", help=argparse.SUPPRESS)  # testbench of the build with coverage
    parser.add_argument("--seed", type=int, default=0, help="of the first stream (default 0)")
    parser.add_argument("--count", type=int, default=60, help="how many seeds (default 60)")
    parser.add_argument("--missed", choices=KINDS, help="also list what was not reached")
    options = parser.parse_args()
    functional = {}
    with tempfile.TemporaryDirectory(prefix="hmlfc-coverage-") as name:
        work = Path(name)
        merged = work / "all.merged"
        end = options.seed + options.count
        for seed in range(options.seed, end, SEEDS_AT_ONCE):
            count = min(SEEDS_AT_ONCE, end - seed)
            if sys.stderr.isatty():
                print(f"\r\033[Kseeds from {seed} of {end}", end="", file=sys.stderr, flush=True)
            run_seeds(options.program, seed, count, work, merged, functional)
        if sys.stderr.isatty():
            print("\r\033[K", end="", file=sys.stderr)
        points = parse_points(merged.read_text(errors="replace"))
    print(f"replay: ./run rtl-coverage --seed {options.seed} --count {options.count}")
    show(summarise(points), functional)
    for place in missed(points, options.missed) if options.missed else []:
        print(place)


if __name__ == "__main__":
    main()
