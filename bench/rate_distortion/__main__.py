#!/usr/bin/env python3
"""Rate against quality of whole light fields: HMLFC, x265, JPEG and JPEG 2000.

main-weighed decides by squared error and bits, the other methods of profile main as the paper does.
Prints the points and the bits a pixel at equal PSNR, and draws curves.png. PSNR is that of the mean squared error over
all views and the channels R, G and B, against 8-bit sources; bits a pixel count whole files against the pixels of all
views; seconds are CPU time of encoding, and of decoding all views.

x265 gets the views in serpentine order as BT.709 video in 4:4:4, which at the same PSNR over RGB takes fewer bits than
4:2:0, and is measured on its own reconstruction.

Exit status: 0 done, 1 a curve failed, 2 something cannot be measured.
"""

import dataclasses
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import coders
    from light_field import REAL, Source, bpp_at, load, real_sources, scene
    from plots import Curve, Panel, draw
    from process import BenchError, run_main, say
    from report import Report, columns
    from result_file import table
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy, python3-pil and python3-matplotlib")

SCENES = {"cards": "444", "knights": "420", "glass": "420"}  # `hmlfc synth --scene`, chroma
SCENE_SIZE = {False: ("9x9", "512x384"), True: ("5x5", "256x192")}  # --quick

# What each codec is given, in the order of rising bits.
MAIN_QUALITIES = ((40, 50, 60, 70, 80, 90), (40, 60, 80))
CRF = ((32, 28, 24, 20, 16, 12), (28, 20, 14))
PARAMETERS = {  # all points, the points of --quick
    "main-hmlfc": MAIN_QUALITIES, "main-rlfc": MAIN_QUALITIES, "main-mc": MAIN_QUALITIES,
    "main-weighed": MAIN_QUALITIES,
    "extended": ((25, 40, 50, 60, 75, 90), (30, 50, 80)),
    "x265-intra": CRF, "x265-inter": CRF,
    "jpeg": ((20, 40, 60, 80, 90, 95), (30, 70, 90)),
    "jpeg2000": ((200, 100, 50, 25, 12, 8), (100, 30, 10)),
}
COMPARED = ("extended", "main-weighed", "main-hmlfc", "x265-intra", "x265-inter")
CURVES = {  # label and style of matplotlib, in the order of the legend
    "extended": ("HMLFC extended", "o-"), "x265-inter": ("x265 inter, serpentine", "D-"),
    "main-weighed": ("HMLFC main, weighed", "s-"), "x265-intra": ("x265 all-intra", "P--"),
    "main-hmlfc": ("HMLFC main", "s--"), "jpeg2000": ("JPEG 2000 a view", "X:"),
    "main-rlfc": ("main, RLFC", "v--"), "jpeg": ("JPEG a view", "*:"), "main-mc": ("main, MC", "^--"),
}
RATIOS = (("x265-intra", "extended"), ("x265-inter", "extended"), ("main-hmlfc", "extended"))


def sources(options, work):
    """The requested light fields, or the real ones that exist, or else the built-in scenes."""
    if options.light_field:
        found = [named_source(text) for text in options.light_field]
    else:
        found = list(real_sources(say)) or [
            Source(f"synth-{name}", scene(work, name, *SCENE_SIZE[options.quick]), chroma=chroma)
            for name, chroma in SCENES.items()]
        found = found[-1:] if options.quick else found
    for text in options.at:
        set_psnr(found, text)
    return found


def named_source(text):
    """The source of NAME=FOLDER; a real light field keeps its settings under its own name."""
    name, equals, folder = text.partition("=")
    if not equals or not Path(folder).is_dir():
        raise BenchError(f"--light-field {text}: not NAME=FOLDER with a folder that exists")
    known = next((source for source in REAL if source.name == name), Source(name, Path()))
    return dataclasses.replace(known, folder=Path(folder))


def set_psnr(found, text):
    """--at DB for all light fields, --at NAME=DB for one."""
    name, _, number = text.rpartition("=")
    chosen = [source for source in found if name in ("", source.name)]
    if not chosen or not number.replace(".", "", 1).isdigit():
        raise BenchError(f"--at {text}: not DB or NAME=DB with a light field of this run")
    for source in chosen:
        source.at = float(number)


def measure(options, work):
    """Groups light_fields, points and failed: after a curve that fails the others are still made."""
    results = {"light_fields": [], "points": [], "failed": []}
    for source in sources(options, work):
        field = load(source.name, source.folder)
        results["light_fields"].append({
            "light_field": source.name, "views": f"{field.rows}x{field.cols}", "size": f"{field.width}x{field.height}",
            "at": source.at})
        for codec in options.methods:
            try:
                results["points"] += curve(field, codec, coders.make(codec, field, source.chroma, work), options)
            except BenchError as error:
                results["failed"].append({"light_field": source.name, "codec": codec, "why": str(error)})
                say(f"FAILED: {source.name} {codec}: {error}")
    return results


def curve(field, codec, encode, options):
    for value in PARAMETERS[codec][options.quick]:
        made = encode(value)
        bpp = 8 * made.bytes / field.pixels
        say(f"{field.name} {codec} {value}: {bpp:.4f} bpp, {made.psnr:.2f} dB, {made.encode_seconds:.1f} CPU s")
        yield {"light_field": field.name, "codec": codec, "parameter": value, "bpp": bpp, "psnr_rgb": made.psnr,
               "encode_cpu_seconds": made.encode_seconds, "decode_cpu_seconds": made.decode_seconds}


def tables(results):
    """The points, then bits a pixel of COMPARED, - where a curve does not reach the PSNR, and RATIOS of them."""
    points = columns(
        results["points"], ("light field", "{light_field}"), ("codec", "{codec}"), ("parameter", "{parameter:g}"),
        ("bpp", "{bpp:.4f}"), ("PSNR RGB", "{psnr_rgb:.2f}"), ("encode CPU s", "{encode_cpu_seconds:.1f}"),
        ("decode CPU s", lambda row: "-" if row["decode_cpu_seconds"] is None else f"{row['decode_cpu_seconds']:.2f}"))
    rows = []
    for field in results["light_fields"]:
        bpp = {codec: bpp_at([(row["psnr_rgb"], row["bpp"]) for row in results["points"] if
                              (row["light_field"], row["codec"]) == (field["light_field"], codec)], field["at"])
               for codec in COMPARED}
        ratios = [f"{bpp[codec] / bpp[base]:.2f}" if bpp[codec] and bpp[base] else "-" for codec, base in RATIOS]
        rows.append((field["light_field"], f"{field['at']:g}", *(f"{b:.4f}" if b else "-" for b in bpp.values()), *ratios))
    equal = table(("light field", "dB", *COMPARED, *(f"{codec}/{base}" for codec, base in RATIOS)), rows)
    return [("Points", points), ("Bits a pixel at equal PSNR RGB", equal)]


def picture(results, folder, prefix):
    panels = []
    for field in results["light_fields"]:
        own = [row for row in results["points"] if row["light_field"] == field["light_field"]]
        of = lambda codec: [(row["bpp"], row["psnr_rgb"]) for row in own if row["codec"] == codec]
        curves = [Curve(label, *zip(*of(codec)), style) for codec, (label, style) in CURVES.items() if of(codec)]
        panels.append(Panel(f"{field['light_field']}: {field['views']} views, {field['size']}", curves, "bits a pixel",
                            "PSNR RGB, dB"))
    draw(folder / f"{prefix}curves.png", panels, len(panels))


def add_options(parser):
    add = parser.add_argument
    add("--light-field", nargs="+", action="extend", metavar="NAME=FOLDER", default=[],
        help="folders of views (default: chess, antinous, knights and toylf in HMLFC_DATA_DIR, or else "
             "the built-in scenes)")
    add("--methods", nargs="+", choices=coders.NAMES, metavar="METHOD",
        default=list(coders.NAMES), help="of: " + " ".join(coders.NAMES) + " (default all)")
    add("--at", nargs="+", action="extend", metavar="[NAME=]DB", default=[],
        help="PSNR to compare at (default 39 chess, 39.5 antinous, 36.5 knights, 36 toylf, "
             "others 38)")


if __name__ == "__main__":
    run_main("rate_distortion", Report("rate_distortion", __doc__, "three points a curve; one default light field",
                                       measure, tables, draw=picture, add_options=add_options).main)
