#!/usr/bin/env python3
"""What frames and single requests need of a light field, and what is not computed.

docs/skipping.md says what is measured. Counts are compared with the recorded run, CPU times are not.

Exit status: 0 done, 1 a count differs from the recorded run, 2 something cannot be measured, or a cold renderer
decoded other blocks than are needed.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import measure
    from plots import Curve, Panel, draw
    from process import run_main, say
    from report import Report, columns
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy and python3-matplotlib")

KEYS = ("scene", "profile", "path", "client", "window", "by", "at")
SHOWN = {"scene": ("cards", "glass", "flat"), "path": ("orbit", "dolly")}  # in tables and pictures of frames


def measured(options, work):
    paths = []
    for scene in measure.SCENES[options.quick]:
        for profile in measure.PROFILES:
            say(f"frames of {scene}, profile {profile}")
            paths += measure.paths(work, scene, profile, options.quick)
    say("cost of one request, effort of encoding")
    return {"paths": paths, "costs": list(measure.costs(work, options.quick)),
            "effort": list(measure.effort(work, options.quick))}


def mean(name, gap=None):
    """The mean of a list of a row, as a function that gives a text. gap: which number of lists of lists."""

    def text(row):
        numbers = [value if gap is None else value[gap] for value in row[name]]
        return f"{sum(numbers) / len(numbers):.{0 if gap is None else 1}f}"

    return text


def share(row):
    return f"{100 * sum(row['bytes']) / len(row['bytes']) / row['file_bytes']:.1f}"


def shown(results):
    return [row for row in results["paths"] if all(row[key] in some for key, some in SHOWN.items())]


def tables(results):
    paths = shown(results)
    path = [(title, f"{{{key}}}") for title, key in
            (("scene", "scene"), ("profile", "profile"), ("path", "path"), ("renderer", "client"))]
    frames = columns(
        paths, *path, ("blocks of all views", "{blocks}"),
        *((name, mean(name)) for name in ("needed", "decoded", "reused", "zero")), ("bytes touched", mean("bytes")),
        ("% of file", share), ("needed with geometry", mean("geometry_needed")),
        ("bytes with geometry", mean("geometry_bytes")),
        ("CPU ms", lambda row: f"{1e3 * sum(row['cpu_seconds']) / len(row['cpu_seconds']):.2f}"))
    requests = columns(
        paths, *path, ("file bytes", "{file_bytes}"),
        *((f"requests, bytes; gap {gap}", lambda row, k=k: f"{mean('requests', k)(row)}, {mean('fetched', k)(row)}")
          for k, gap in enumerate(measure.GAPS)))
    microseconds = lambda name: lambda row: f"{1e6 * row[name]:.0f}"
    costs = columns(
        results["costs"], ("by", "{by}"), ("at", "{at}"), ("file bytes", "{file_bytes}"),
        *((f"block: {name}", f"{{block_{name.replace(' ', '_')}}}") for name in ("bytes", "key bytes", "walks", "fields")),
        ("block: CPU us", microseconds("block_cpu_seconds")), ("open us", microseconds("open_cpu_seconds")),
        *((f"view: {name}", f"{{view_{name.replace(' ', '_')}}}") for name in ("bytes", "key bytes", "blocks")),
        ("view: CPU us", microseconds("view_cpu_seconds")))
    nanoseconds = {(row["scene"], row["window"]): 1e9 * row["cpu_seconds"] / row["pixels"] for row in results["effort"]}
    effort = columns(
        results["effort"], ("scene", "{scene}"), ("window", "{window}"), ("bytes", "{bytes}"),
        ("CPU ns a pixel", lambda row: f"{nanoseconds[row['scene'], row['window']]:.1f}"),
        ("times faster than noise",
         lambda row: f"{nanoseconds['noise', row['window']] / nanoseconds[row['scene'], row['window']]:.1f}"))
    return [("Frames, mean of a path", frames), ("Cost of one request", costs), ("The encoder's search", effort),
            ("Range requests of a frame, mean of a path", requests)]


def pictures(results, folder, prefix):
    """PREFIXframes.png and PREFIXcost.png."""
    warm = [row for row in shown(results) if row["client"] == "warm" and row["profile"] == "main"]
    numbers = lambda name, values, style: Curve(name, list(range(len(values))), values, style)
    draw(folder / f"{prefix}frames.png", [
        Panel(f"{row['scene']}, {row['path']}",
              [numbers(name, row[name], "-") for name in ("needed", "decoded", "reused", "zero")], "frame", "blocks", "")
        for row in warm], len(SHOWN["path"]))
    panels = []
    for what, unit in (("bytes", "bytes touched"), ("cpu_seconds", "CPU s")):
        for kind in dict.fromkeys(row["by"] for row in results["costs"]):
            own = [row for row in results["costs"] if row["by"] == kind]
            curves = [Curve(f"one {request}", [row["at"] for row in own], [row[f"{request}_{what}"] for row in own])
                      for request in ("block", "view")]
            if what == "bytes":
                curves += [Curve(label, [row["at"] for row in own], [row[name] for row in own], style) for label, name, style
                           in (("key image for a block", "block_key_bytes", "s:"), ("the file", "file_bytes", "--"))]
            panels.append(Panel("", curves, f"{kind} of a view" if kind == "pixels" else kind, unit, "xy"))
    draw(folder / f"{prefix}cost.png", panels, len(panels) // 2)


if __name__ == "__main__":
    run_main("skipping", Report("skipping", __doc__, "two scenes, fewer frames; compared with nothing", measured, tables,
                                KEYS, "Skipping", pictures).main)
