#!/usr/bin/env python3
"""What frames and single requests need of a light field, and what is not computed.

docs/skipping.md says what is measured; docs/scale.md uses the byte ranges. Prints tables, writes
results.json and pictures, and compares all counts with the recorded run, but not CPU times.

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
    import result_file
    from measure import PROFILES, SCENES, Measure
    from process import HMLFC, built, machine, require, run_main, say
    from tables import tables
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy, python3-pil and python3-matplotlib")

PROGRAMS = (HMLFC, built("bench_skipping"), built("bench_skipping_exhaustive"))
GROUPS = ("paths", "geometry", "costs", "effort")


def measure(programs, work, quick):
    require("skipping", *programs)
    measuring = Measure(programs, work, quick)
    results = {"machine": machine(), "paths": [], "geometry": []}
    for scene in ("cards", "flat") if quick else SCENES:
        for profile in PROFILES:
            say(f"frames of {scene}, profile {profile}")
            results["paths"] += measuring.frames(scene, profile)
            results["geometry"] += measuring.geometry(scene, profile)
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


def write(results, path):
    """JSON, a path or a request a line."""
    lines = [f'"machine": {json.dumps(results["machine"])}']
    lines += [f'"{key}": [\n' + ",\n".join(map(json.dumps, results[key])) + "\n]" for key in GROUPS]
    path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


def settle(options):
    """Writes the recorded run's tables and pictures, or checks the tables. Returns the exit status."""
    results = result_file.read(options.recorded)
    if options.update:
        plots.draw(results, options.results.parent / "images", "skipping_")
    return result_file.settle_bench(options, "skipping", "Skipping", tables(results))


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="skipping", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    result_file.add_bench_arguments(parser, "skipping", "two scenes, fewer frames; compared with nothing")
    parser.add_argument(
        "--programs", type=Path, nargs=3, default=PROGRAMS, metavar="PROGRAM",
        help="hmlfc, bench_skipping and bench_skipping_exhaustive (default: those of ./run)",
    )
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
        for title, lines in tables(results):
            print("\n".join(["", title, "", *lines]))
    if options.record:
        write(results, options.recorded)
    if options.record or options.quick:
        return 0
    found = differences(counts(result_file.read(options.recorded)), counts(results))
    for difference in found:
        say(f"differs from the recorded run: {difference}")
    return 1 if found else 0


def main():
    options = parse_arguments()
    return settle(options) if options.check or options.update else run_bench(options)


if __name__ == "__main__":
    run_main("skipping", main)
