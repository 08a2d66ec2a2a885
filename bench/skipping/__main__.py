#!/usr/bin/env python3
"""Skipping: what frames and single requests need of a light field, and what is not computed.

docs/skipping.md says what is measured; docs/scale.md uses the byte ranges. Prints tables, writes
results.json and pictures, and compares all counts with the recorded run; CPU times are printed, not
compared.

Exit status: 0 done, 1 a count differs from the recorded run, 2 something cannot be measured, or a
cold renderer decoded other blocks than are needed, or the exhaustive search gave another stream.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import plots
    import tables
    from bench_error import BenchError
    from document_tables import with_tables
    from measure import PROFILES, SCENES, Measure
    from process import machine
    from sources import ROOT
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy, python3-pil and python3-matplotlib")

RECORDED = Path(__file__).resolve().with_name("recorded.json")
BUILT = ROOT / "build" / "release"
PROGRAMS = (
    BUILT / "model" / "hmlfc",
    BUILT / "bench" / "bench_skipping",
    BUILT / "bench" / "bench_skipping_exhaustive",
)


def say(text):
    print(text, file=sys.stderr, flush=True)


def measure(programs, work, quick):
    for program in programs:
        if not program.is_file():
            raise BenchError(f"no program {program}: ./run bench skipping builds it")
    measuring = Measure(programs, work, quick)
    results = {"machine": machine(), "quick": quick, "paths": []}
    for scene in ("cards", "flat") if quick else SCENES:
        for profile in PROFILES:
            say(f"frames of {scene}, profile {profile}")
            results["paths"] += measuring.frames(scene, profile)
    say("cost of one request")
    results["costs"] = list(measuring.costs())
    say("effort of encoding")
    results["effort"] = list(measuring.effort())
    return results


def counts(value):
    """The value without CPU times and what depends on the file system."""
    if isinstance(value, dict):
        left = {k: v for k, v in value.items() if "cpu" not in k and k not in ("machine", "disk_bytes")}
        return {key: counts(item) for key, item in left.items()}
    return [counts(item) for item in value] if isinstance(value, list) else value


def differences(old, new, place=""):
    """Places in which two results differ."""
    if isinstance(old, dict) and isinstance(new, dict):
        keys = sorted({*old, *new})
        return [d for k in keys for d in differences(old.get(k), new.get(k), f"{place}.{k}")]
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        pairs = enumerate(zip(old, new))
        return [d for k, (a, b) in pairs for d in differences(a, b, f"{place}[{k}]")]
    return [] if old == new else [f"{place.lstrip('.')}: {old} -> {new}"]


def read(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise BenchError(f"{path}: {error}") from error


def write(results, path):
    """JSON, a frame or a request a line."""
    lines = ["{"]
    for key in ("machine", "quick"):
        lines.append(f'"{key}": {json.dumps(results[key])},')
    groups = ("paths", "costs", "effort")
    for key in groups:
        rows = ",\n".join(json.dumps(row) for row in results[key])
        lines += [f'"{key}": [', rows, "]" + ("," if key != groups[-1] else "")]
    path.write_text("\n".join([*lines, "}", ""]), encoding="utf-8")


def documents(results, folder):
    """(Path, its text, its text with the tables of `results`) of each document."""
    for name, places in tables.DOCUMENTS.items():
        text = (folder / name).read_text(encoding="utf-8")
        yield folder / name, text, with_tables(text, lambda table: tables.make(table, results), places)


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="skipping", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("--quick", action="store_true", help="two scenes, fewer frames; compared with nothing")
    add("--record", action="store_true", help="make this the recorded run, in place of comparing")
    add("--write-document", action="store_true",
        help="measure nothing: put the recorded run's tables and pictures into the documents")
    add("--check-document", action="store_true",
        help="measure nothing: exit status 1 where the documents' tables are not the recorded run's")
    add("--json", action="store_true", help="print the results as JSON")
    add("-o", "--output", type=Path, default=ROOT / "out" / "skipping", metavar="FOLDER",
        help="default out/skipping")
    add("--recorded", type=Path, default=RECORDED, metavar="FILE",
        help="default bench/skipping/recorded.json")
    add("--documents", type=Path, default=ROOT / "docs", metavar="FOLDER", help="default docs")
    add("--programs", type=Path, nargs=3, default=PROGRAMS, metavar="PROGRAM",
        help="hmlfc, bench_skipping and bench_skipping_exhaustive (default: those of ./run)")
    return parser.parse_args()


def run_bench(options):
    options.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=options.output) as work:
        results = measure(options.programs, Path(work), options.quick)
    write(results, options.output / "results.json")
    plots.draw(results, options.output)
    if options.json:
        print(json.dumps(results, indent=2))
    else:
        for name in dict.fromkeys(n for names in tables.DOCUMENTS.values() for n in names):
            print("\n".join(["", name, "", *tables.make(name, results)]))
    if options.record:
        write(results, options.recorded)
    if options.record or options.quick:
        return 0
    found = differences(counts(read(options.recorded)), counts(results))
    for difference in found:
        say(f"differs from the recorded run: {difference}")
    return 1 if found else 0


def main():
    options = parse_arguments()
    try:
        if not options.check_document and not options.write_document:
            return run_bench(options)
        results = read(options.recorded)
        stale = [entry for entry in documents(results, options.documents) if entry[1] != entry[2]]
        if options.check_document:
            for path, _, _ in stale:
                say(f"the tables of {path} are not those of {options.recorded}: "
                    "./run bench skipping --write-document puts them there")
            return 1 if stale else 0
        for path, _, text in stale:
            path.write_text(text, encoding="utf-8")
        plots.draw(results, options.documents / "images", "skipping_")
        return 0
    except BenchError as error:
        say(f"skipping: {error}")
        return 2


if __name__ == "__main__":
    sys.exit(main())
