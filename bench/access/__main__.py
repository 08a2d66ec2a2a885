#!/usr/bin/env python3
"""Rate at equal PSNR and cost of access: HMLFC and the systems of the literature.

Methods: both profiles of HMLFC; RLFC and MC; vector quantisation with entropy coding (Levoy and Hanrahan); a 4D Haar
wavelet with addressable coefficients (Peter and Strasser); x265; JPEG and JPEG 2000. Takes a synthetic scene
and parts of real light fields, and prints what a pixel, a block, a view and a frame read, compute and hold.

Exit status: 0 done, 1 a figure differs from the recorded run, 2 something cannot be measured.
"""

import sys
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import numpy as np
    from light_field import Source, load, real_sources, scene
    from methods import AS_VQ, METHODS
    from PIL import Image
    from process import BenchError, run_main, say
    from report import Report, columns
    from result_file import table
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy, python3-pil and python3-matplotlib")

GRID, SIDE = {False: 8, True: 4}, {False: 128, True: 64}  # --quick: views a side, pixels a side
SCENE, BASELINE = "glass", ("--baseline", "1")  # parallax as from a lenslet camera
TARGETS = {SCENE: 36.0, "chess": 36.0, "antinous": 36.0, "knights": 32.0, "toylf": 32.0}  # dB
SHOWN = ("chess", "knights")  # in the tables of access
NOTES = (
    "*Rate*: of each method the fewest bits that reach the PSNR, or the highest PSNR that it reaches, of the middle 8x8 views, "
    "their middle 128x128 pixels, so headers and key images weigh more than in a whole light field. CPU seconds are "
    "those of all threads; vector quantisation and the wavelet are prototypes in Python, whose seconds compare with nothing.",
    "*Cold* is the first request after opening the file, whose head is not counted; *warm* the next one, a block, a view or a step "
    "of the camera further. Blocks are means over 16 places; a pixel costs what its block does, with the wavelet and vector quantisation "
    "a little less. *Bytes* are read of the file; *%* is the random-access "
    "ratio, bits needed cold of those of the file; *samples* are computed, key images whole, blocks of HMLFC one by one; "
    "*held* is kept for later requests, next to the file. A *frame* is that of a camera close to the scene, which takes its own part of "
    "each view.",
    "Vector quantisation undoes its entropy coding first and holds the layer below. The wavelet holds the nodes read. "
    "x265 inter is taken to need all views up to the one asked for, in their order.",
)


def sources(options, work):
    """The scene, then the middle parts of the real light fields."""
    grid, side = GRID[options.quick], SIDE[options.quick]
    found = [Source(SCENE, scene(work, SCENE, f"{grid}x{grid}", f"{side}x{side}", *BASELINE))]
    found += [] if options.quick else real_sources(say)
    for source in found:
        if source.name in options.light_fields:
            yield source if source.name == SCENE else replace(source, folder=crop(source, work / source.name, grid, side))


def crop(source, folder, grid, side):
    """A folder of the middle grid x grid views, of each the middle side x side pixels."""
    folder.mkdir()
    views = load(source.name, source.folder).grid
    row, col, top, left = ((size - part) // 2 for size, part in zip(views.shape, (grid, grid, side, side)))
    part = views[row : row + grid, col : col + grid, top : top + side, left : left + side]
    for row, col in np.ndindex(grid, grid):
        Image.fromarray(part[row, col]).save(folder / f"{row:02}_{col:02}.png")
    return folder


def measure(options, work):
    """Groups rates and costs."""
    if AS_VQ in options.methods and "vq" not in options.methods:
        raise BenchError(f"--methods {AS_VQ} needs vq before it")
    results = {"rates": [], "costs": []}
    for source in sources(options, work):
        field, target = load(source.name, source.folder), TARGETS[source.name]
        reached = {}
        for name in options.methods:
            say(f"{source.name}: {name}")
            made = METHODS[name][1](name, field, reached["vq"] if name == AS_VQ else target, work)
            reached[name] = made.psnr
            key = {"light_field": source.name, "method": name}
            results["rates"].append(key | {
                "target": target, "bytes": made.bytes, "bpp": 8 * made.bytes / field.pixels, "psnr_rgb": made.psnr,
                "encode_cpu_seconds": made.encode, "decode_cpu_seconds": made.decode})
            for region, both in made.costs.items():
                costs = {f"{state}_{what}": value for state, cost in zip(("cold", "warm"), both)
                         for what, value in vars(cost).items()}
                results["costs"].append({**key, "region": region, **costs})
    return results


def tables(results):
    rates = results["rates"]
    fields = list(dict.fromkeys(row["light_field"] for row in rates))
    by = {(row["light_field"], row["method"]): row for row in rates}
    heads = [f"{field}, {next(row['target'] for row in rates if row['light_field'] == field):g} dB" for field in fields]

    def by_field(text):
        found = {label: [by.get((field, name)) for field in fields] for name, (label, _) in METHODS.items()}
        rows = [(label, *(text(row) if row else "-" for row in own)) for label, own in found.items() if any(own)]
        return table(("method", *heads), rows)

    seconds = lambda row: ", ".join("-" if row[f"{name}_cpu_seconds"] is None else f"{row[f'{name}_cpu_seconds']:.2f}"
                                    for name in ("encode", "decode"))
    made = [("What the columns say", ["\n\n".join(NOTES)]),
            ("Rate: bits a pixel at dB", by_field(lambda row: f"{row['bpp']:.4f} at {row['psnr_rgb']:.2f}")),
            ("CPU seconds of encoding, decoding", by_field(seconds))]
    for field in fields:
        if field in SHOWN or len(fields) == 1:
            own = [row for row in results["costs"] if row["light_field"] == field and row["region"] != "pixel"]
            own.sort(key=lambda row: ("block", "view", "frame").index(row["region"]))
            made.append((f"Cost of access: {field}", costs_table(own, by)))
    return made


def costs_table(rows, rates):
    share = lambda row: f"{100 * row['cold_bytes'] / rates[row['light_field'], row['method']]['bytes']:.1f}"
    return columns(
        rows, ("region", "{region}"), ("method", lambda row: METHODS[row["method"]][0]), ("cold bytes", "{cold_bytes}"),
        ("%", share), ("cold samples", "{cold_samples}"), ("warm bytes", "{warm_bytes}"), ("warm samples", "{warm_samples}"),
        ("held KiB", lambda row: f"{row['warm_held'] / 1024:.1f}"))


def add_options(parser):
    parser.add_argument("--light-fields", nargs="+", choices=TARGETS, metavar="NAME", default=list(TARGETS),
                        help="of: " + " ".join(TARGETS) + " (default all that are there)")
    parser.add_argument("--methods", nargs="+", choices=METHODS, metavar="METHOD", default=list(METHODS),
                        help="of: " + " ".join(METHODS) + " (default all)")


if __name__ == "__main__":
    run_main("access", Report("access", __doc__, "one small scene; compared with nothing", measure, tables,
                              ("light_field", "method", "region"), "Cost of access", add_options=add_options).main)
