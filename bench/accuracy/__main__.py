#!/usr/bin/env python3
"""Time against error: what encodings and rendered frames cost, and how wrong they are.

Measures the light fields of HMLFC_DATA_DIR and the built-in scenes by studies; docs/accuracy.md says
what each measures. Writes points.csv, points.json and a picture for each study, prints the tables, and
compares with the recorded run: bytes and errors as they are, times after division by the CPU time of
fixed work. A point that is already in the folder, of the same programs, is not measured again.

Exit status: 0 done, 1 something is worse than in the recorded run, 2 something cannot be measured.
"""

import argparse
import json
import resource
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import plots
    import result_file
    import studies
    from comparison import compare
    from process import HMLFC, built, require, run_main
    from results import read_json, write_csv, write_json
    from run import Run
    from tables import TITLES, Tables
except ImportError as error:
    names = "python3-numpy, python3-pil, python3-matplotlib and python3-skimage"
    sys.exit(f"{error}: install the Debian packages {names}")


def cpu_seconds():
    """Of this process and the programs that it ran."""
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return sum(usage.ru_utime + usage.ru_stime for usage in map(resource.getrusage, who))


def settle(options):
    """Writes the recorded run's tables and pictures, or checks the tables. Returns the exit status."""
    recorded = read_json(options.recorded)
    tables = Tables(recorded, quick=False).all()
    status = result_file.settle_bench(options, "accuracy", "Time against error", tables)
    if options.update:
        plots.draw(recorded, False, options.results.parent / "images", "accuracy_")
    return status


def report(run):
    """Writes the files of a run, prints tables and changes. Returns the exit status."""
    output, options = run.options.output, run.options
    write_csv(run.results, output / "points.csv")
    write_json(run.results, output / "points.json")
    plots.draw(run.results, options.quick, output)
    recorded = read_json(options.recorded)
    changes, compared = compare(recorded, run.results)
    if options.json:
        print_json(run, changes, compared)
    else:
        print_tables(run, changes, compared)
    if options.record:
        recorded.merge(run.results)
        write_json(recorded, options.recorded)
    if run.failed:
        return 2
    return 1 if not options.record and any(change.worse for change in changes) else 0


def print_tables(run, changes, compared):
    tables = Tables(run.results, run.options.quick)
    for name, title in TITLES.items():
        if name in ("run", *run.options.studies):
            print("\n".join(["", title, "", *tables.make(name)]))
    print(f"\n{run.measured} points measured, {run.reused} taken from {run.store.path}, "
          f"{cpu_seconds():.0f} CPU s")
    print(f"compared with {compared} points of {run.options.recorded}:")
    for change in changes:
        print(f"  {change.text()}")
    if not changes:
        print("  nothing differs beyond noise")
    for title, entries in (("skipped", run.skipped), ("FAILED", run.failed)):
        for entry in entries:
            print(f"{title}: {entry['what']}: {entry['why']}")


def print_json(run, changes, compared):
    counts = {"measured": run.measured, "reused": run.reused, "compared": compared}
    counts["cpu_seconds"] = cpu_seconds()
    listed = [{**vars(change), "text": change.text()} for change in changes]
    lists = {"changes": listed, "skipped": run.skipped, "failed": run.failed}
    print(json.dumps({**counts, **lists}, indent=2))


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="accuracy", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("--studies", nargs="+", choices=studies.NAMES, metavar="STUDY",
        default=list(studies.NAMES), help="of: " + " ".join(studies.NAMES) + " (default all)")
    add("--light-field", nargs="+", metavar="NAME", default=[],
        help="of: chess antinous knights synth-cards synth-knights synth-glass synth-flat "
             "synth-noise (default all)")
    result_file.add_bench_arguments(parser, "accuracy", "two small scenes, fewer points")
    add("--hmlfc", type=Path, default=HMLFC, help="the program (default: that of ./run)")
    add("--bench", type=Path, default=built("bench_accuracy"),
        help="the program beside it (default: that of ./run)")
    return parser.parse_args()


def main():
    options = parse_arguments()
    if options.check or options.update:
        return settle(options)
    require("accuracy", options.hmlfc, options.bench)
    options.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=options.output) as work:
        run = Run(options, Path(work))
        run.measure()
        return report(run)


if __name__ == "__main__":
    run_main("accuracy", main)
