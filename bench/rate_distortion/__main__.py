#!/usr/bin/env python3
"""Rate against quality of whole light fields: HMLFC, x265, JPEG and JPEG 2000.

Writes curves.csv and curves.png, and prints the points and the bits a pixel at equal PSNR. PSNR is
that of the mean squared error over all views and the channels R, G and B, against 8-bit sources;
bits a pixel count whole files against the pixels of all views; seconds are CPU time of encoding.

x265 gets the views in serpentine order as BT.709 video and is measured on its own reconstruction.
Its chroma is 4:4:4 unless told otherwise: at the same PSNR over RGB that took fewer bits than
4:2:0 on all the light fields named here.
"""

import argparse
import dataclasses
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import coders
    import report
    from light_field import load
    from process import HMLFC, BenchError, require, run, run_main, say
    from sources import REAL, ROOT, Source, real_sources
except ImportError as error:
    sys.exit(f"{error}: install the Debian packages python3-numpy and python3-pil")

SCENES = {"cards": "444", "knights": "420", "glass": "420"}  # `hmlfc synth --scene`, chroma
SCENE_SIZE = ("9x9", "512x384")
QUICK_SCENE_SIZE = ("5x5", "256x192")

# What each codec is given, in the order of rising bits.
MAIN_QUALITIES = ((40, 50, 60, 70, 80, 90), (40, 60, 80))
PARAMETERS = {  # all points, the points of --quick
    "main-hmlfc": MAIN_QUALITIES,
    "main-rlfc": MAIN_QUALITIES,
    "main-mc": MAIN_QUALITIES,
    "extended": ((30, 40, 50, 60, 75, 90), (30, 50, 80)),
    "x265-intra": ((32, 28, 24, 20, 16, 12), (28, 20, 14)),
    "x265-inter": ((32, 28, 24, 20, 16, 12), (28, 20, 14)),
    "jpeg": ((20, 40, 60, 80, 90, 95), (30, 70, 90)),
    "jpeg2000": ((200, 100, 50, 25, 12, 8), (100, 30, 10)),
}


class Bench:
    """One run: its points, what was skipped and what failed."""

    def __init__(self, options, work):
        self.options, self.work = options, work
        self.points, self.skipped, self.failed = [], [], []
        self.at, self.descriptions = {}, {}

    def skip(self, what, why):
        self.skipped.append({"what": what, "why": why})
        say(f"skipped: {what}: {why}")

    def measure(self, source):
        """All curves of one light field."""
        light_field = load(source.name, source.folder)
        self.at[source.name] = source.at
        self.descriptions[source.name] = (
            f"{source.name}: {light_field.rows}x{light_field.cols} views, "
            f"{light_field.width}x{light_field.height}"
        )
        with tempfile.TemporaryDirectory(dir=self.work) as folder:
            for method in self.options.methods:
                try:
                    encode = coders.make(
                        method, light_field, source.chroma, self.options, Path(folder)
                    )
                except BenchError as error:
                    self.skip(f"{source.name} {method}", str(error))
                else:
                    self.curve(light_field, method, encode)

    def curve(self, light_field, method, encode):
        """All points of one curve; a point that fails is reported, and the others are still made."""
        for value in PARAMETERS[method][self.options.quick]:
            what = f"{light_field.name} {method}"
            try:
                parameter, size, psnr, seconds = encode(value)
            except BenchError as error:
                self.failed.append({"what": f"{what} {value:g}", "why": str(error)})
                say(f"FAILED: {what} {value:g}: {error}")
                continue
            bpp = light_field.bpp(size)
            point = report.Point(light_field.name, method, parameter, bpp, psnr, seconds)
            self.points.append(point)
            # After each point, so that an interrupted run keeps its points.
            report.write_csv(self.points, self.options.output / "curves.csv")
            result = f"{point.bpp:.4f} bpp, {point.psnr_rgb:.2f} dB, {point.seconds:.1f} CPU s"
            say(f"{what} {point.parameter}: {result}")

    def report(self):
        """Writes the picture, prints the tables."""
        rows = report.equal_psnr(self.points, self.at)
        try:
            picture = self.options.output / "curves.png"
            report.plot(self.points, self.descriptions, self.at, picture)
        except ImportError:
            self.skip("curves.png", "install the Debian package python3-matplotlib")
        lines = [*report.points_table(self.points), "", "Bits a pixel at equal PSNR RGB", ""]
        print("\n".join(lines + report.equal_psnr_table(rows)))
        for title, entries in (("skipped", self.skipped), ("FAILED", self.failed)):
            for entry in entries:
                print(f"{title}: {entry['what']}: {entry['why']}")


def find_sources(bench):
    """The requested light fields, or the real ones that exist, or else the built-in scenes."""
    options = bench.options
    if options.light_field:
        found = [named_source(text) for text in options.light_field]
    else:
        found = list(real_sources(bench.skip)) or list(scene_sources(bench))
        if options.quick:
            found = found[-1:]
    apply_psnr(found, options.at)
    return found


def named_source(text):
    """The source of NAME=FOLDER; a real light field keeps its settings under its own name."""
    name, equals, folder = text.partition("=")
    if not equals or not Path(folder).is_dir():
        raise BenchError(f"--light-field {text}: not NAME=FOLDER with a folder that exists")
    known = next((source for source in REAL if source.name == name), Source(name, Path()))
    return dataclasses.replace(known, folder=Path(folder))


def scene_sources(bench):
    """Renders the built-in scenes. --quick: one, small."""
    grid, size = QUICK_SCENE_SIZE if bench.options.quick else SCENE_SIZE
    for scene, chroma in list(SCENES.items())[: 1 if bench.options.quick else None]:
        folder = bench.work / scene
        say(f"rendering the scene {scene}")
        command = [bench.options.hmlfc, "synth", "--scene", scene, "--grid", grid, "--size", size]
        run([*command, "-o", folder])
        yield Source(f"synth-{scene}", folder, chroma=chroma)


def apply_psnr(sources, texts):
    """--at DB for all light fields, --at NAME=DB for one."""
    for text in texts:
        name, _, number = text.rpartition("=")
        chosen = [source for source in sources if name in ("", source.name)]
        try:
            psnr = float(number)
        except ValueError:
            raise BenchError(f"--at {text}: not DB or NAME=DB") from None
        if not chosen:
            raise BenchError(f"--at {text}: no light field {name} in this run")
        for source in chosen:
            source.at = psnr


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="rate_distortion",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("--light-field", nargs="+", action="extend", metavar="NAME=FOLDER", default=[],
        help="folders of views (default: chess, antinous, knights and toylf in HMLFC_DATA_DIR, or else "
             "the built-in scenes)")
    add("--methods", nargs="+", choices=coders.NAMES, metavar="METHOD",
        default=list(coders.NAMES), help="of: " + " ".join(coders.NAMES) + " (default all)")
    add("--at", nargs="+", action="extend", metavar="[NAME=]DB", default=[],
        help="PSNR to compare at (default 39 chess, 39.5 antinous, 36.5 knights, 36 toylf, "
             "others 38)")
    add("--x265-chroma", choices=("420", "444"), default="444", help="default 444")
    add("--quick", action="store_true", help="three points a curve; one default light field")
    add("-o", "--output", type=Path, default=ROOT / "out" / "rate_distortion", metavar="FOLDER",
        help="default out/rate_distortion")
    add("--hmlfc", type=Path, default=HMLFC,
        help="the program (default: that of ./run)")
    return parser.parse_args()


def main():
    options = parse_arguments()
    require("rate_distortion", options.hmlfc)
    options.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=options.output) as work:
        bench = Bench(options, Path(work))
        for source in find_sources(bench):
            bench.measure(source)
        bench.report()
    return 1 if bench.failed else 0


if __name__ == "__main__":
    run_main("rate_distortion", main)
