#!/usr/bin/env python3
"""Depth that streams hold, and views rendered with it, against the truth.

Depth: encodes synthetic scenes and takes the disparity map of the middle view out of the streams. Of real light fields,
Antinous is measured where its folder has the benchmark's gt_disp_lowres.pfm, which has the other sign.

Withheld views: encodes the views of even rows and columns, renders those between with one focal plane, the
best of all, and with the geometry of the stream, and compares both with the views.

Exit status: 0 done, 1 a figure differs from the recorded run, 2 something cannot be measured.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import withheld
    from depth import measures, read_pfm
    from light_field import real_sources, scene
    from process import hmlfc, hmlfc_json, run_main, say
    from report import Report, columns
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy, python3-pil and python3-matplotlib")

SCENES = ("cards", "knights", "glass", "flat")
GRID, SIZE = "9x9", {False: "320x240", True: "80x60"}  # --quick
WIDE, NARROW = ("--baseline", "4"), ("--baseline", "1")  # the second as after a lens array
CODINGS = {
    "extended, quality 60": ["--quality", "60"],
    "extended, quality 90": ["--quality", "90"],
    "main, method MC, quality 60": ["--profile", "main", "--method", "mc", "--quality", "60"],
}
TRUTH = "gt_disp_lowres.pfm"
DEPTH = (
    f"Scenes of {GRID} views of {SIZE[False]} pixels with `--baseline 4`. *known*: blocks of all "
    "views with a disparity; *off*: pixels that are off by more than 0.07 pixels a column; *plane*: a map "
    "that is 0 everywhere. Both measures leave out 15 pixels at the borders, as those of the 4D Light Field "
    "Benchmark (Honauer et al. 2016) do.")
WITHHELD = (
    f"Only the views of even rows and columns are encoded; up to {withheld.MOST_VIEWS} of those of odd rows and "
    "columns are rendered, and compared with the views. *Best plane*: the focus with the least error of all "
    "from -16 to 16, found with the views themselves; geometry takes it too, and in the last column 0. "
    f"{withheld.MARGIN} pixels at the borders are left out, since the focal plane moves them out of the views. Scene flat is "
    "blank: the best plane has less error only because it takes means of pixels, which removes coding noise.")


def measure(options, work):
    """Groups depth and withheld."""
    names, size = SCENES[:1] if options.quick else SCENES, SIZE[options.quick]
    real = [] if options.quick else list(real_sources(say))
    made, depth = [], []
    for name in names:
        truth = work / f"{name}-truth"
        made.append((f"scene {name}", scene(work, name, GRID, size, *WIDE, "--disparity", truth)))
        depth += codings(work, name, made[-1][1], read_pfm(truth / "04_04.pfm"))
    for source in real:
        if (source.folder / TRUTH).exists():
            depth += codings(work, source.name, source.folder, -read_pfm(source.folder / TRUTH))
    if not options.quick:
        made.append(("scene noise", scene(work, "noise", GRID, size, *WIDE)))  # which has no depth
        made += [(f"scene {name}, baseline 1", scene(work, name, GRID, size, *NARROW)) for name in SCENES[:3]]
    rows = [*withheld.measure(work, [(s.name, s.folder) for s in real], withheld.QUALITIES),
            *withheld.measure(work, made, withheld.QUALITIES[:1])]
    return {"depth": depth, "withheld": rows}


def codings(work, name, views, truth):
    """A row for each of CODINGS."""
    for coding, options in CODINGS.items():
        say(f"{name}, {coding}")
        stream, out = work / "stream.hmlfc", work / "map.pfm"
        hmlfc("encode", views, "-o", stream, *options)
        hmlfc("disparity", stream, "-o", out, "--force")
        info, found = hmlfc_json("info", stream), read_pfm(out)
        yield {
            "light_field": name, "coding": coding, "bytes": info["bytes"],
            "known": info["disparity"]["known"] / info["disparity"]["blocks"],
            **measures(found, truth), **{f"plane_{key}": value for key, value in measures(0 * found, truth).items()},
        }


def tables(results):
    depth = columns(
        results["depth"], ("light field", "{light_field}"), ("coding", "{coding}"), ("bytes", "{bytes}"),
        ("known, %", lambda row: f"{100 * row['known']:.1f}"), ("off, %", "{bad:.1f}"), ("100 * MSE", "{mse:.2f}"),
        ("plane: off, %", "{plane_bad:.1f}"), ("plane: 100 * MSE", "{plane_mse:.2f}"))
    gain = lambda name: lambda row: f"{row[name] - row['plane']:+.2f}"
    views = columns(
        results["withheld"], ("light field", "{light_field}"), ("quality", "{quality}"),
        ("best plane, pixels a column", "{focus:g}"), ("plane, dB", "{plane:.2f}"), ("geometry, dB", "{geometry:.2f}"),
        ("gain, dB", gain("geometry")), ("gain with --focus 0, dB", gain("geometry_focus_0")))
    return [("The disparity map of the middle view against the truth", [DEPTH, "", *depth]),
            ("Views that the stream does not have, rendered", [WITHHELD, "", *views])]


if __name__ == "__main__":
    run_main("geometry", Report("geometry", __doc__, "one small scene; compared with nothing", measure, tables,
                                ("light_field", "coding", "quality"), "Geometry").main)
