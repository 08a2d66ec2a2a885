#!/usr/bin/env python3
"""Lines and branches of the decode path that the vectors reach, by file.

Runs vector_check on the suite and reads its counters with gcovr. Code that is not part of decoding is
in ../decode_path/not_decoding.json, lines that no vector reaches in unreached.json, lines with a branch
that none takes in untaken.json, each with the reason. Exit status 1: a line or branch is not explained,
an explanation fits none, or a vector fails.
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
    """gcovr's data of the decode path: file name to its lines."""
    command = [
        *("gcovr", "--root", str(root), "--json", "-", "--exclude-unreachable-branches"),
        *("--exclude-throw-branches", "--filter", f"{root}/model/({'|'.join(LAYERS)})/"),
        *("--object-directory", str(build), str(build / "tests/decode_path")),
    ]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    data = json.loads(result.stdout)
    return {entry["file"].removeprefix("model/"): entry["lines"] for entry in data["files"]}


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
        reached, taken = (sum(x["count"] > 0 for x in part) for part in (lines, branches))
        rows.append((name, len(lines), reached, len(branches), taken))
        lines_missed += [(name, l["line_number"]) for l in lines if l["count"] == 0]
        branches_missed += [
            (name, l["line_number"])
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
    """Splits `missed`, pairs (file, line number), into explained and open places. Third: explanations
    that fit none, as (file, text of the line)."""
    reasons = {
        (name, line): group["reason"]
        for group in json.loads((FOLDER / file).read_text())
        for name, lines in group["lines"].items()
        for line in lines
    }
    explained, open_places = [], []
    for name, number in missed:
        text = text_of(model, name, number)
        if (name, text) in reasons:
            explained.append((name, number, text, reasons[name, text]))
        else:
            open_places.append((name, number, text))
    used = {(name, text) for name, _, text, _ in explained}
    return explained, open_places, [key for key in reasons if key not in used]


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
    found = {
        "unreached": explain(model, lines, "unreached.json"),
        "untaken": explain(model, branches, "untaken.json"),
    }
    for kind, (explained, open_places, stale) in found.items():
        for name, number, text in open_places:
            print(f"{kind}, not explained: model/{name}:{number}: {text}")
        for name, text in stale:
            print(f"{kind}: explained, but reached or gone: model/{name}: {text}")
        if arguments.missed:
            for name, number, text, reason in explained:
                print(f"{kind}: model/{name}:{number}: {text}: {reason}")
        print(f"{kind}: {len(explained)} lines explained, {len(open_places)} not")
    wrong = any(open_places or stale for _, open_places, stale in found.values())
    return 1 if decoded.returncode or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
