#!/usr/bin/env python3
"""Lines and branches of the decode path that the vectors reach, by file.

Runs vector_check on the suite and reads its counters with gcovr. What is no part of decoding stands
in ../decode_path/not_decoding.json with the reason; lines that no vector reaches stand in
unreached.json, branches in untaken.json, with the reason. Exit status 1: a line is unreached and not explained, an
explanation fits no unreached line, or a vector fails.
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


def measure(build, root):
    """gcovr's data of the decode path, file name to its lines."""
    command = [
        *("gcovr", "--root", str(root), "--json", "-", "--exclude-unreachable-branches"),
        *("--exclude-throw-branches", "--filter", f"{root}/model/({'|'.join(LAYERS)})/"),
        *("--object-directory", str(build), str(build / "tests/decode_path")),
    ]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    data = json.loads(result.stdout)
    return {
        entry["file"].removeprefix("model/"): entry["lines"]
        for entry in data["files"]
    }


def summarise(files, skipped):
    """Rows (file, lines, reached, branches, taken), and unreached lines and branches by place."""
    rows, lines_missed, branches_missed = [], [], []
    for name in sorted(files, key=lambda n: (LAYERS.index(n.split("/")[0]), n)):
        skip = skipped.get(name, set())
        if skip is None:
            continue
        lines = [l for l in files[name] if l["line_number"] not in skip and not l["gcovr/noncode"]]
        if not lines:
            continue
        branches = [b for l in lines for b in l["branches"]]
        rows.append(
            (
                name,
                len(lines),
                sum(l["count"] > 0 for l in lines),
                len(branches),
                sum(b["count"] > 0 for b in branches),
            )
        )
        lines_missed += [(name, l["line_number"]) for l in lines if l["count"] == 0]
        branches_missed += [
            (name, l["line_number"], sum(b["count"] == 0 for b in l["branches"]))
            for l in lines
            if l["count"] > 0 and any(b["count"] == 0 for b in l["branches"])
        ]
    return rows, lines_missed, branches_missed


def percent(part, whole):
    return "-" if whole == 0 else f"{100 * part / whole:.1f} %"


def print_table(rows):
    print("| file | lines | reached | | branches | taken | |")
    print("|---|---|---|---|---|---|---|")
    total = ["all", *(sum(row[i] for row in rows) for i in range(1, 5))]
    for name, lines, reached, branches, taken in [*rows, total]:
        print(
            f"| {name} | {lines} | {reached} | {percent(reached, lines)} "
            f"| {branches} | {taken} | {percent(taken, branches)} |"
        )


def text_of(model, name, number):
    return (model / name).read_text().splitlines()[number - 1].strip()


def explain(model, missed, file):
    """Splits the places of `missed` into explained and not; entries that fit none come third."""
    entries = json.loads((FOLDER / file).read_text())
    used, explained, open_places = set(), [], []
    for place in missed:
        text = text_of(model, place[0], place[1])
        fits = [
            i for i, e in enumerate(entries) if e["file"] == place[0] and e["line"] == text
        ]
        used.update(fits)
        (explained if fits else open_places).append((*place, text))
    return explained, open_places, [e for i, e in enumerate(entries) if i not in used]


def main():
    parser = argparse.ArgumentParser(prog="./run coverage", description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--suite", type=Path, default=None, help="another suite than vectors/")
    parser.add_argument("--missed", action="store_true", help="list unreached lines and branches")
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
    rows, lines, branches = summarise(measure(arguments.build, root), not_decoding(root / "model"))
    print_table(rows)
    model = root / "model"
    _, unexplained, stale = explain(model, lines, "unreached.json")
    _, open_branches, stale_branches = explain(model, branches, "untaken.json")
    for name, number, text in unexplained:
        print(f"unreached: model/{name}:{number}: {text}")
    for entry in stale + stale_branches:
        print(f"explained, but reached or gone: model/{entry['file']}: {entry['line']}")
    if arguments.missed:
        for name, number, count, text in open_branches:
            print(f"untaken: model/{name}:{number}: {count}: {text}")
    print(f"{len(unexplained)} lines and {len(open_branches)} lines with branches not explained")
    return 1 if decoded.returncode or unexplained or stale else 0


if __name__ == "__main__":
    sys.exit(main())
