#!/usr/bin/env python3
"""Lines of the decode path that the vectors reach, by file, and those that they do not.

Runs vector_check on the suite and reads its counters with gcovr. Code that is not part of decoding is in
../decode_path/not_decoding.json. Exit status 1: fewer lines than LEAST are reached, or a vector fails.
"""

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "decode_path"))

from scope import LAYERS, not_decoding  # noqa: E402

LEAST = 0.99  # of all lines


def measure(build, root):
    """gcovr's data of the decode path: file name to its lines."""
    command = [
        *("gcovr", "--root", str(root), "--json", "-"),
        *("--filter", f"{root}/model/({'|'.join(LAYERS)})/"),
        *("--object-directory", str(build), str(build / "tests/decode_path")),
    ]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    data = json.loads(result.stdout)
    return {entry["file"].removeprefix("model/"): entry["lines"] for entry in data["files"]}


def summarise(files, skipped):
    """Rows (file, lines, reached), and the unreached lines as (file, line number)."""
    rows, missed = [], []
    for name in sorted(files, key=lambda n: (LAYERS.index(n.split("/")[0]), n)):
        skip = skipped.get(name, set())
        if skip is None:
            continue
        lines = [l for l in files[name] if l["line_number"] not in skip and not l["gcovr/noncode"]]
        if not lines:
            continue
        unreached = [(name, l["line_number"]) for l in lines if l["count"] == 0]
        rows.append((name, len(lines), len(lines) - len(unreached)))
        missed += unreached
    return rows, missed


def print_table(rows):
    print("| file | lines | reached | |")
    print("|---|---|---|---|")
    for name, lines, reached in rows:
        print(f"| {name} | {lines} | {reached} | {100 * reached / lines:.1f} % |")


def main():
    parser = argparse.ArgumentParser(prog="./run coverage", description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--suite", type=Path, default=None, help="another suite than vectors/")
    arguments = parser.parse_args()
    root = FOLDER.parents[1]
    if not shutil.which("gcovr"):
        print("gcovr is missing", file=sys.stderr)
        return 77
    for counters in arguments.build.rglob("*.gcda"):
        counters.unlink()
    suite = arguments.suite or root / "vectors"
    check = arguments.build / "tests/decode_path/vector_check"
    decoded = subprocess.run([str(check), str(suite)], stdout=sys.stderr, check=False)
    model = root / "model"
    rows, missed = summarise(measure(arguments.build, root), not_decoding(model))
    total = ("all", *(sum(row[i] for row in rows) for i in (1, 2)))
    print_table([*rows, total])
    for name, number in missed:
        text = (model / name).read_text().splitlines()[number - 1].strip()
        print(f"unreached: model/{name}:{number}: {text}")
    return 1 if decoded.returncode or total[2] < LEAST * total[1] else 0


if __name__ == "__main__":
    sys.exit(main())
