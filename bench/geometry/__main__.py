#!/usr/bin/env python3
"""Depth that streams hold, against the truth that synth knows.

Encodes synthetic scenes and takes the disparity map of the middle view out of the streams. Measures are those of the 4D Light Field Benchmark (Honauer et al. 2016), which leaves
out 15 pixels at the borders: the share of pixels that are off by more than 0.07 pixels, and 100 times the
mean squared error. Of real light fields, Antinous is measured where its folder has the benchmark's
gt_disp_lowres.pfm, which has the other sign.

Exit status: 0 done, 1 a figure differs from the recorded run, 2 something cannot be measured.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import result_file
    from depth import measures, read_pfm
    from process import HMLFC, BenchError, require, run, say
    from sources import real_sources
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy and python3-pil")

SCENES = ("cards", "knights", "glass", "flat")
GRID, SIZE, BASELINE = "9x9", {False: "320x240", True: "80x60"}, "4"
CODINGS = {
    "extended, quality 60": ["--quality", "60"],
    "extended, quality 90": ["--quality", "90"],
    "main, method MC, quality 60": ["--profile", "main", "--method", "mc", "--quality", "60"],
}
TRUTH = "gt_disp_lowres.pfm"
HEAD = ("light field", "coding", "bytes", "known, %", "off, %", "100 * MSE", "plane: off, %", "plane: 100 * MSE")


def measure(hmlfc, work, quick):
    """A row for each light field and coding."""
    require("geometry", hmlfc)
    for scene in SCENES[:1] if quick else SCENES:
        views, truth = work / scene, work / f"{scene}-truth"
        run([hmlfc, "synth", "--scene", scene, "--grid", GRID, "--size", SIZE[quick], "--baseline", BASELINE,
             "-o", views, "--disparity", truth])
        yield from codings(hmlfc, work, scene, views, read_pfm(truth / "04_04.pfm"))
    for source in [] if quick else real_sources(lambda name, why: say(f"{name}: {why}")):
        if source.name != "antinous":
            continue
        if (source.folder / TRUTH).exists():
            yield from codings(hmlfc, work, source.name, source.folder, -read_pfm(source.folder / TRUTH))
        else:
            say(f"antinous is skipped: its folder has no {TRUTH}")


def codings(hmlfc, work, name, views, truth):
    for coding, options in CODINGS.items():
        say(f"{name}, {coding}")
        stream, out = work / "stream.hmlfc", work / "map.pfm"
        run([hmlfc, "encode", views, "-o", stream, *options])
        run([hmlfc, "disparity", stream, "-o", out])
        info = json.loads(run([hmlfc, "info", stream, "--json"])[0])
        found = read_pfm(out)
        yield {
            "light_field": name,
            "coding": coding,
            "bytes": info["bytes"],
            "known": info["disparity"]["known"] / info["disparity"]["blocks"],
            **measures(found, truth),
            "without": measures(0 * found, truth),
        }


def tables(rows):
    lines = [
        (row["light_field"], row["coding"], row['bytes'], f"{100 * row['known']:.1f}",
         f"{row['bad']:.1f}", f"{row['mse']:.2f}", f"{row['without']['bad']:.1f}", f"{row['without']['mse']:.2f}")
        for row in rows
    ]
    title = "The disparity map of the middle view against the truth"
    note = (f"Scenes of {GRID} views of {SIZE[False]} pixels with `--baseline {BASELINE}`. *known*: blocks of all "
            "views with a disparity; *off*: pixels that are off by more than 0.07 pixels a column; *plane*: a map "
            "that is 0 everywhere. Both measures leave out 15 pixels at the borders, as those of the 4D Light Field "
            "Benchmark (Honauer et al. 2016) do.")
    return [(title, [note, "", *result_file.table(HEAD, lines)])]


def rounded(rows):
    """The rows as far as another machine's logarithms and sums agree."""
    return json.loads(json.dumps(rows), parse_float=lambda text: round(float(text), 6))


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="geometry", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    result_file.add_bench_arguments(parser, "geometry", "one small scene; compared with nothing")
    parser.add_argument("--program", type=Path, default=HMLFC, help="hmlfc (default: that of ./run)")
    return parser.parse_args()


def read(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise BenchError(f"{path}: {error}") from error


def run_bench(options):
    with tempfile.TemporaryDirectory() as work:
        rows = rounded(list(measure(options.program, Path(work), options.quick)))
    if options.json:
        print(json.dumps(rows, indent=2))
    else:
        print("\n".join(tables(rows)[0][1]))
    if options.record:
        options.recorded.write_text("[\n" + ",\n".join(map(json.dumps, rows)) + "\n]\n", encoding="utf-8")
    if options.record or options.quick:
        return 0
    recorded = {(row["light_field"], row["coding"]): row for row in read(options.recorded)}
    differing = [row for row in rows if recorded.get((row["light_field"], row["coding"])) != row]
    for row in differing:
        say(f"differs from the recorded run: {row['light_field']}, {row['coding']}")
    return 1 if differing else 0


def main():
    options = parse_arguments()
    try:
        if options.check or options.update:
            text = result_file.result_text("Geometry", "./run bench geometry --update", tables(read(options.recorded)))
            return result_file.settle(options.results / "geometry.md", text, options.update)
        return run_bench(options)
    except BenchError as error:
        say(f"geometry: {error}")
        return 2


if __name__ == "__main__":
    sys.exit(main())
