"""Results of a benchmark: groups of rows by name, each row one measurement, in JSON and CSV.

A row is a dict of names and values: numbers, texts, lists of numbers. Its keys, which the benchmark names, tell which
measurement it is.
"""

import csv
import json
import math
from dataclasses import dataclass

from process import BenchError

DIGITS = 7
TOLERANCE = 2e-6  # of the value; compilers round double-precision frames differently
MACHINE = ("seconds", "peak", "disk")  # in names of values that depend on the machine
LEAST_SECONDS, NOISE = 0.05, 1.35  # times below the first are not compared; within this ratio they are the same


def read(path):
    """The results of a file."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise BenchError(f"{path}: {error}") from error


def write(results, path):
    """One row a line, floats with DIGITS digits."""
    parts = [f"{json.dumps(name)}: {_lines(rows)}" for name, rows in results.items()]
    path.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")


def write_csv(results, folder):
    """GROUP.csv for each group."""
    for group, rows in _groups(results):
        names = list(dict.fromkeys(name for row in rows for name in row))
        with open(folder / f"{group}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, names, restval="")
            writer.writeheader()
            writer.writerows(rows)


def merged(recorded, results, keys):
    """The recorded results with the rows of `results`, which replace those of the same keys."""
    made = dict(recorded)
    for name, value in results.items():
        if isinstance(value, list):
            rows = {identity(row, keys): row for row in [*recorded.get(name, []), *value]}
            value = list(rows.values())
        made[name] = value
    return made


@dataclass
class Difference:
    """A value of one measurement that is not the recorded one."""

    row: tuple
    name: str
    old: object
    new: object

    def __str__(self):
        return f"{', '.join(map(str, self.row))}: {self.name} {self.old} -> {self.new}"


def differences(recorded, results, keys):
    """The Differences of rows that both results have.

    Values that depend on the machine are left out, but for CPU times of rows with calibration_seconds, the CPU time of
    fixed work: they are compared after division by it, up to NOISE."""
    found = []
    for group, rows in _groups(results):
        known = {identity(row, keys): row for row in recorded.get(group, [])}
        for row in rows:
            old = known.get(identity(row, keys), {})
            found += [Difference(identity(row, keys), name, old[name], row[name])
                      for name in row.keys() & old.keys() if not _same(name, old, row)]
    return sorted(found, key=str)


def identity(row, keys):
    """The values of the keys that the row has."""
    return tuple(row[key] for key in keys if key in row)


def _groups(results):
    return [(name, rows) for name, rows in results.items() if isinstance(rows, list)]


def _same(name, old_row, new_row):
    old, new = old_row[name], new_row[name]
    if name.endswith("cpu_seconds") and "calibration_seconds" in new_row:
        ratio = new / new_row["calibration_seconds"] / (old / old_row["calibration_seconds"])
        return max(old, new) < LEAST_SECONDS or 1 / NOISE <= ratio <= NOISE
    if any(part in name for part in MACHINE):
        return True
    if isinstance(old, float) and isinstance(new, float):
        return math.isclose(old, new, rel_tol=TOLERANCE)
    return old == new


def _lines(rows):
    if not isinstance(rows, list):
        return json.dumps(rows)
    return "[\n" + ",\n".join(json.dumps({name: _rounded(value) for name, value in row.items()}) for row in rows) + "\n]"


def _rounded(value):
    if isinstance(value, list):
        return [_rounded(item) for item in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
