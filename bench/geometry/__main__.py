#!/usr/bin/env python3
"""Depth that streams hold, and views rendered with it, against the truth.

Depth: encodes synthetic scenes and takes the disparity map of the middle view out of the streams. Measures are those of the 4D Light Field Benchmark (Honauer et al. 2016), which leaves
out 15 pixels at the borders: the share of pixels that are off by more than 0.07 pixels, and 100 times the
mean squared error. Of real light fields, Antinous is measured where its folder has the benchmark's
gt_disp_lowres.pfm, which has the other sign.

Withheld views: encodes the views of even rows and columns, renders those between with one focal plane, the
best of all, and with the geometry of the stream, and compares both with the views. --picture draws one.

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
    from process import HMLFC, require, run, run_main, say
    from sources import real_sources
    import withheld
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy and python3-pil")

SCENES = ("cards", "knights", "glass", "flat", "noise")  # noise has no depth
GRID, SIZE, BASELINE, NARROW = "9x9", {False: "320x240", True: "80x60"}, "4", "1"
CODINGS = {
    "extended, quality 60": ["--quality", "60"],
    "extended, quality 90": ["--quality", "90"],
    "main, method MC, quality 60": ["--profile", "main", "--method", "mc", "--quality", "60"],
}
TRUTH = "gt_disp_lowres.pfm"
HEAD = ("light field", "coding", "bytes", "known, %", "off, %", "100 * MSE", "plane: off, %", "plane: 100 * MSE")


def measure(hmlfc, work, quick):
    """A row for each light field and coding."""
    for scene, views, truth in scenes(hmlfc, work, quick):
        if scene != "noise":
            yield from codings(hmlfc, work, scene, views, read_pfm(truth / "04_04.pfm"))
    for source in real(quick):
        if source.name != "antinous":
            continue
        if (source.folder / TRUTH).exists():
            yield from codings(hmlfc, work, source.name, source.folder, -read_pfm(source.folder / TRUTH))
        else:
            say(f"antinous is skipped: its folder has no {TRUTH}")


def scenes(hmlfc, work, quick):
    """(name, folder of views, folder of disparities) of each scene."""
    for scene in SCENES[:1] if quick else SCENES:
        views, truth = work / scene, work / f"{scene}-truth"
        if not views.exists():
            synth(hmlfc, scene, BASELINE, quick, views, *([] if scene == "noise" else ["--disparity", truth]))
        yield scene, views, truth


def narrow_scenes(hmlfc, work, quick):
    """(name, folder of views) of scenes whose views are as near to each other as those behind a lens array."""
    for scene in [] if quick else SCENES[:3]:
        synth(hmlfc, scene, NARROW, quick, work / f"{scene}-narrow")
        yield f"scene {scene}, baseline {NARROW}", work / f"{scene}-narrow"


def synth(hmlfc, scene, baseline, quick, views, *options):
    run([hmlfc, "synth", "--scene", scene, "--grid", GRID, "--size", SIZE[quick], "--baseline", baseline,
         "-o", views, *options])


def real(quick):
    return [] if quick else list(real_sources(lambda name, why: say(f"{name}: {why}")))


def measure_withheld(hmlfc, work, quick):
    made = [(f"scene {scene}", views) for scene, views, _ in scenes(hmlfc, work, quick)]
    taken = [(source.name, source.folder) for source in real(quick)]
    yield from withheld.measure(hmlfc, work, taken, withheld.QUALITIES)
    made += narrow_scenes(hmlfc, work, quick)
    yield from withheld.measure(hmlfc, work, made, withheld.QUALITIES[:1])


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


def depth_table(rows):
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
    return title, [note, "", *result_file.table(HEAD, lines)]


def withheld_table(rows):
    title = "Views that the stream does not have, rendered"
    note = (f"Only the views of even rows and columns are encoded; up to {withheld.MOST_VIEWS} of those of odd rows and "
            "columns are rendered, and compared with the views. *Best plane*: the focus with the least error of all "
            "from -16 to 16, found with the views themselves; geometry takes it too, and in the last column 0. "
            f"{withheld.MARGIN} pixels at the borders are left out, since the focal plane moves them out of the views.")
    for row in rows:
        if row["light_field"] == withheld.FLAT and row["quality"] != withheld.LOSSLESS:
            note += (f" Scene flat is blank; its true plane, 0, has {row['plane_focus_0']:.2f} dB, less than geometry. The best "
                     "plane has less error only because it takes means of pixels, which removes coding noise: without "
                     "coding noise it has no lead.")
        if "stated_places" in row and row["quality"] == withheld.QUALITIES[0]:
            note += (f" The file names of {row['light_field']} say where its cameras stood. With cameras there, --focus 0 and "
                     f"quality {row['quality']} geometry has {row['stated_places']:.2f} dB, less than on the even grid, on "
                     "which frames are drawn whatever a rig says.")
    return title, [note, "", *result_file.table(*withheld.tables(rows))]


def tables(recorded):
    return [depth_table(recorded["depth"]), withheld_table(recorded["withheld"])]


def rounded(rows):
    """The rows as far as another machine's logarithms and sums agree."""
    return json.loads(json.dumps(rows), parse_float=lambda text: round(float(text), 6))


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="geometry", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    result_file.add_bench_arguments(parser, "geometry", "one small scene; compared with nothing")
    parser.add_argument("--picture", type=Path, metavar="FILE",
        help="only draw a withheld view of the scene knights: plane, geometry, truth")
    parser.add_argument("--program", type=Path, default=HMLFC, help="hmlfc (default: that of ./run)")
    return parser.parse_args()


def key(row):
    return row["light_field"], row.get("coding"), row.get("quality")


def run_bench(options):
    require("geometry", options.program)
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        if options.picture:
            views = next(views for scene, views, _ in scenes(options.program, work, False) if scene == "knights")
            withheld.picture(options.program, work, views, options.picture)
            return 0
        found = {
            "depth": rounded(list(measure(options.program, work, options.quick))),
            "withheld": rounded(list(measure_withheld(options.program, work, options.quick))),
        }
    if options.json:
        print(json.dumps(found, indent=2))
    else:
        for title, lines in tables(found):
            print("\n".join([title, "", *lines, ""]))
    if options.record:
        groups = (f'"{name}": [\n' + ",\n".join(map(json.dumps, rows)) + "\n]" for name, rows in found.items())
        options.recorded.write_text("{" + ",\n".join(groups) + "}\n", encoding="utf-8")
    if options.record or options.quick:
        return 0
    recorded = result_file.read(options.recorded)
    known = {(name, key(row)): row for name, rows in recorded.items() for row in rows}
    differing = [(name, row) for name, rows in found.items() for row in rows if known.get((name, key(row))) != row]
    for name, row in differing:
        say(f"differs from the recorded run: {name}, {' '.join(str(part) for part in key(row) if part)}")
    return 1 if differing else 0


def main():
    options = parse_arguments()
    if options.check or options.update:
        return result_file.settle_bench(options, "geometry", "Geometry", tables(result_file.read(options.recorded)))
    return run_bench(options)


if __name__ == "__main__":
    run_main("geometry", main)
