#!/usr/bin/env python3
"""Rate at equal PSNR and cost of access: HMLFC beside the systems of the literature.

Methods: both profiles of HMLFC; RLFC and MC; vector quantisation with entropy coding (Levoy and Hanrahan); a 4D Haar
wavelet with addressable coefficients (Peter and Strasser); x265; JPEG and JPEG 2000. Takes a synthetic scene
and parts of real light fields, and prints what a pixel, a block, a view and a frame read, compute and hold.

--pleno PROGRAM adds JPEG Pleno: PROGRAM VIEWS STREAM DECODED LAMBDA, a script of yours around its reference software, encodes
the folder VIEWS of 8-bit CCC_RRR.ppm to STREAM and decodes it to the folder DECODED, with the same names.

Exit status: 0 done, 1 a figure differs from the recorded run, 2 something cannot be measured.
"""

import argparse
import dataclasses
import json
import sys
import tempfile
from pathlib import Path

BENCH = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(BENCH / "common"), str(BENCH / "rate_distortion")]

try:
    import numpy as np
    import result_file
    from light_field import load, read_views
    from methods import AS_VQ, METHODS
    from PIL import Image
    from process import HMLFC, BenchError, built, machine, require, run, run_main, say
    from sources import Source, real_sources
    from tables import tables
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy and python3-pil")

GRID, SIDE = {False: 8, True: 4}, {False: 128, True: 64}  # views a side, pixels a side
SCENE, BASELINE = "glass", "1"  # parallax as from a lenslet camera
TARGETS = {SCENE: 36.0, "chess": 36.0, "antinous": 36.0, "knights": 32.0, "toylf": 32.0}  # dB


def scene(options, work, grid, side):
    command = [options.hmlfc, "synth", "--scene", SCENE, "--grid", f"{grid}x{grid}", "--size", f"{side}x{side}"]
    run([*command, "--baseline", BASELINE, "-o", work / SCENE])
    return Source(SCENE, work / SCENE)


def sources(options, work):
    """The scene, then the middle parts of the real light fields."""
    grid, side = GRID[options.quick], SIDE[options.quick]
    if SCENE in options.light_fields:
        yield scene(options, work, grid, side)
    found = [] if options.quick else real_sources(lambda name, why: say(f"skipped: {name}: {why}"))
    for source in found:
        if source.name in options.light_fields:
            yield dataclasses.replace(source, folder=crop(source, work / source.name, grid, side))


def crop(source, folder, grid, side):
    """A folder of the middle grid x grid views, of each the middle side x side pixels."""
    folder.mkdir()
    views = read_views(source.folder)
    row, col, top, left = ((size - part) // 2 for size, part in zip(views.shape, (grid, grid, side, side)))
    part = views[row : row + grid, col : col + grid, top : top + side, left : left + side]
    for row, col in np.ndindex(grid, grid):
        Image.fromarray(part[row, col]).save(folder / f"{row:02}_{col:02}.png")
    return folder


def measure(source, options, work):
    field = load(source.name, source.folder)
    target = TARGETS[source.name]
    methods = {}
    for name in options.methods:
        say(f"{source.name}: {name}")
        at = methods["vq"]["psnr"] if name == AS_VQ else target
        methods[name] = dataclasses.asdict(METHODS[name](name, field, at, options, work))
    return {"name": source.name, "target": target, "rows": field.rows, "cols": field.cols, "width": field.width,
            "height": field.height, "methods": methods}


def counted(results):
    """The figures that are the same on every machine, by light field and method: bytes, samples, PSNR to 1/1000 dB."""
    return {(field["name"], name): {**{key: row[key] for key in ("bytes", "regions")}, "psnr": round(row["psnr"], 3)}
            for field in results["light_fields"] for name, row in field["methods"].items()}


def record(results, path):
    """Takes the light fields and methods measured into the recorded run, in the order of TARGETS and METHODS."""
    fields = {field["name"]: field for field in (result_file.read(path)["light_fields"] if path.exists() else [])}
    for field in results["light_fields"]:
        methods = {**fields.get(field["name"], field)["methods"], **field["methods"]}
        fields[field["name"]] = {**field, "methods": {name: methods[name] for name in METHODS if name in methods}}
    recorded = {**results, "light_fields": [fields[name] for name in TARGETS if name in fields]}
    path.write_text(json.dumps(recorded, indent=1) + "\n", encoding="utf-8")


def parse_arguments():
    parser = argparse.ArgumentParser(prog="access", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    result_file.add_bench_arguments(parser, "access", "one small scene; compared with nothing")
    parser.add_argument("--light-fields", nargs="+", choices=TARGETS, metavar="NAME", default=list(TARGETS),
                        help="of: " + " ".join(TARGETS) + " (default all that are there)")
    parser.add_argument("--methods", nargs="+", choices=METHODS, metavar="METHOD",
                        help="of: " + " ".join(METHODS) + " (default all; pleno with --pleno)")
    parser.add_argument("--pleno", type=Path, metavar="PROGRAM", help="JPEG Pleno, see above")
    parser.add_argument("--hmlfc", type=Path, default=HMLFC, help="the program (default: that of ./run)")
    parser.add_argument("--bench", type=Path, default=built("bench_access"), help="bench_access (default: that of ./run)")
    parser.set_defaults(x265_chroma="444")
    options = parser.parse_args()
    options.methods = options.methods or [name for name in METHODS if name != "pleno" or options.pleno]
    if AS_VQ in options.methods and "vq" not in options.methods:
        parser.error(f"--methods {AS_VQ} needs vq before it")
    return options


def run_bench(options):
    require("access", options.hmlfc, options.bench)
    if "pleno" in options.methods and not (options.pleno and options.pleno.is_file()):
        raise BenchError(f"no program {options.pleno} for --methods pleno: --pleno takes the path of yours (--help)")
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        results = {"machine": machine(), "light_fields": [measure(source, options, work) for source in sources(options, work)]}
    if options.json:
        print(json.dumps(results, indent=2))
    else:
        for title, lines in tables(results):
            print("\n".join([title, "", *lines, ""]))
    if options.record:
        record(results, options.recorded)
    if options.record or options.quick:
        return 0
    recorded = counted(result_file.read(options.recorded))
    differing = [key for key, row in counted(results).items() if key in recorded and recorded[key] != row]
    for key in differing:
        say(f"differs from the recorded run: {' '.join(key)}")
    return 1 if differing else 0


def main():
    options = parse_arguments()
    if options.check or options.update:
        return result_file.settle_bench(options, "access", "Cost of access", tables(result_file.read(options.recorded)))
    return run_bench(options)


if __name__ == "__main__":
    run_main("access", main)
