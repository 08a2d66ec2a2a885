"""The tables of docs/results/accuracy.md and the pictures of docs/accuracy.md."""

import math

from light_field import bpp_at, psnr_of_mse
from measure import SECTIONS
from plots import Curve, Panel, draw
from report import columns
from result_file import table
from studies import CACHES, FILTERS, FULL, METHODS, extended, label, main, studies

MIB = 1 << 20
SHOWN = ("chess", "antinous", "knights")  # in long tables
COMPARED = [*(extended(preset=preset) for preset in FULL["preset"]), *map(main, METHODS)]
# Of Pratapa and Manocha's paper. Block size: {light field: {block: (PSNR in dB, bits a pixel)}}, thresholds 75,
# window 16, height 3.
PAPER_BLOCK_SIZE = {
    "Amethyst": {2: (38.7, 0.0592), 4: (43.69, 0.106), 8: (48.35, 0.707)},
    "Bunny": {2: (40.52, 0.0173), 4: (43.35, 0.0411), 8: (47.52, 0.548)},
    "Bracelet": {2: (37.03, 0.033), 4: (44.15, 0.35), 8: (48.79, 1.108)},
    "Lego Knights": {2: (38.27, 0.096), 4: (43.046, 0.243), 8: (47.89, 1.15)},
}
# How many times the bits of HMLFC the other methods take at similar PSNR, over its light fields.
PAPER_TIMES_OF_HMLFC = {"rlfc": (2, 5), "mc": (2, 3)}


class Points:
    """The encodings of a run, by light field and label. Values of a quick run lie among those of a full one."""

    def __init__(self, results):
        self.fields = {row["light_field"]: row for row in results["light_fields"]}
        self.rows = {(row["light_field"], row["coding"]): row for row in results["encodings"]}
        self.shown = [field for field in self.fields if field in SHOWN]

    def found(self, field, codings):
        """Those of the encodings that were measured."""
        rows = (self.rows.get((field, label(coding))) for coding in codings)
        return [row for row in rows if row]

    def curve(self, field, method):
        return self.found(field, [main(method, threshold=t) for t in FULL["threshold"]])

    def preset(self, field, preset="medium"):
        return self.found(field, [extended(preset=preset, quality=q) for q in FULL["quality"]])


def bpp(value):
    return "-" if value is None else f"{value:.3f}" if value >= 0.1 else f"{value:.4f}"


def rate(row):
    return f"{bpp(row['bpp'])} at {row['psnr_rgb']:.2f}"


def tables(results):
    points = Points(results)
    fields = columns(
        results["light_fields"], ("light field", "{light_field}"), ("views", "{views}"), ("pixels", "{size}"),
        ("chroma of main", "{chroma}"), ("dB to compare at", "{at:g}"))
    return [
        ("Light fields", [*fields, "", f"Processor: {results['machine']}."]),
        ("Presets at quality 60, methods of profile main at thresholds 75", encoder(points)),
        ("Bits a pixel at equal PSNR, log(bpp) linear in PSNR between the points", methods(points)),
        ("Block size: thresholds 75, window 16, height 3", block_size(points)),
        ("Window: blocks of 4, height 3, thresholds 75", window(points)),
        ("Memory of decoded reference images, thresholds 75", reference_memory(points)),
        ("Frames: CPU time and PSNR by cause", frames(results["frames"])),
    ]


def encoder(points):
    rows = [row for field in points.shown for row in points.found(field, COMPARED)]
    mib = lambda name: lambda row: f"{row[name] / MIB:.0f}"
    return columns(
        rows, ("light field", "{light_field}"), ("coding", "{coding}"), ("bpp", lambda row: bpp(row["bpp"])),
        ("PSNR RGB", "{psnr_rgb:.2f}"), ("PSNR Y", "{psnr_y:.2f}"), ("SSIM Y", "{ssim_y:.4f}"),
        ("largest error", "{max_abs_error:.0f}"), ("encode CPU s", "{encode_cpu_seconds:.2f}"),
        ("decode CPU s", "{decode_cpu_seconds:.3f}"), ("encode MiB", mib("encode_peak_bytes")),
        ("decode MiB", mib("decode_peak_bytes")),
        ("index, motion, residual, top %", lambda row: ", ".join(
            f"{100 * row[f'{name}_bytes'] / row['bytes']:.0f}" for name in SECTIONS)))


def methods(points):
    rows = []
    for field, facts in points.fields.items():
        curves = [points.preset(field), *(points.curve(field, method) for method in METHODS)]
        bits = [bpp_at([(row["psnr_rgb"], row["bpp"]) for row in curve], facts["at"]) for curve in curves]
        if any(bits):
            times = [f"{b / bits[1]:.2f}" if b and bits[1] else "-" for b in bits[2:]]
            rows.append((field, f"{facts['at']:g}", *map(bpp, bits), *times))
    ranges = [f"{low} to {high}" for low, high in PAPER_TIMES_OF_HMLFC.values()]
    rows.append(("paper's", "40 to 41", "", "", "", "", *ranges))
    return table(("light field", "dB", "extended bpp", "hmlfc bpp", "rlfc bpp", "mc bpp", "rlfc / hmlfc", "mc / hmlfc"), rows)


def block_size(points):
    rows = [(field, *map(rate, points.found(field, [main(block=b) for b in FULL["block"]]))) for field in points.fields]
    for name, figures in PAPER_BLOCK_SIZE.items():
        rows.append((f"{name} (paper)", *(f"{bits:g} at {psnr:g}" for psnr, bits in figures.values())))
    return table(("light field", *(f"block {b}: bpp at dB" for b in FULL["block"])), rows)


def window(points):
    rows = []
    for field in points.shown:
        found = [points.rows.get((field, label(main(window=w)))) for w in FULL["window"]]
        for what, made in (("bpp at dB", rate), ("blocks without residual", lambda row: f"{100 * row['without_residual']:.1f} %"),
                           ("encode CPU s", lambda row: f"{row['encode_cpu_seconds']:.2f}")):
            rows.append((field, what, *(made(row) if row else "-" for row in found)))
    return table(("light field", "", *(f"window {w}" for w in FULL["window"])), rows)


def reference_memory(points):
    codings = {label(coding): coding for coding in studies(False)["reference_memory"]}
    rows = [(field, *(f"{row['reference_bytes'] / 1024:.0f} KiB, {rate(row)}" if row else "-" for row in
                      (points.rows.get((field, name)) for name in codings))) for field in points.fields]
    heads = [f"height {coding['height']}, references {coding['references']}" for coding in codings.values()]
    return table(("light field: KiB, bpp at dB", *heads), rows)


def frames(rows):
    db = lambda name: lambda row: f"{psnr_of_mse(row[name]):.2f}"
    largest = lambda row: f"{row['largest_fixed']:.2f}" + (f" ({row['bound_fixed']:.2f})" if "bound_fixed" in row else "")
    return columns(
        [row for row in rows if row["light_field"] in SHOWN], ("light field", "{light_field}"),
        ("profile", lambda row: "extended" if row["coding"].startswith("extended") else "main"),
        ("filter:levels:cache MiB", "{frame}"), ("CPU ms", lambda row: f"{1e3 * row['median_cpu_seconds']:.2f}"),
        ("95th percentile", lambda row: f"{1e3 * row['p95_cpu_seconds']:.2f}"), ("blocks needed", "{blocks_needed}"),
        ("decoded", "{blocks_decoded}"), ("all, dB", db("mse_total")), ("stream, dB", db("mse_stream")),
        ("filter, dB", db("mse_filter")), ("fixed point, dB", db("mse_fixed")), ("largest (bound)", largest))


def on_front(rows):
    """Those rows that no other one beats in bits and error, by rising bits."""
    front = []
    for row in sorted(rows, key=lambda row: (row["bpp"], -row["psnr_rgb"])):
        if not front or row["psnr_rgb"] > front[-1]["psnr_rgb"]:
            front.append(row)
    return front


def pictures(results, folder, prefix):
    """PREFIXencoder.png, PREFIXwindow.png and PREFIXrenderer.png, as far as there are points."""
    points = Points(results)

    def curve(name, rows, x, style="o-"):
        rows = [row for row in rows if math.isfinite(row["psnr_rgb"])]
        return Curve(name, [row[x] for row in rows], [row["psnr_rgb"] for row in rows], style)

    curves = lambda field: {**{f"extended {p}": points.preset(field, p) for p in FULL["preset"]},
                            **{f"main {m}": points.curve(field, m) for m in METHODS}}
    panels = []
    for x, unit in (("bpp", "bits a pixel"), ("encode_cpu_seconds", "CPU s of encoding")):
        for field in points.fields:
            lines = [curve(name, rows, x) for name, rows in curves(field).items()]
            if x == "bpp":
                everything = [row for (name, _), row in points.rows.items() if name == field]
                lines.append(curve("front", on_front(everything), x, ":"))
            panels.append(Panel(field, lines, unit, "PSNR RGB, dB"))
    draw(folder / f"{prefix}encoder.png", panels, 4)
    pairs = [[], []]
    for field in points.fields:
        rows = points.found(field, [main(window=w) for w in FULL["window"]])
        for lines, value in zip(pairs, (lambda row: row["bpp"] / rows[0]["bpp"],
                                        lambda row: row["psnr_rgb"] - rows[0]["psnr_rgb"])):
            lines.append(Curve(field, [int(row["coding"].split(" w")[1].split()[0]) for row in rows], list(map(value, rows))))
    draw(folder / f"{prefix}window.png", [
        Panel("", lines, "window", y) for lines, y in zip(pairs, ("bits, window 1 = 1", "PSNR RGB over window 1, dB"))], 2)
    panels = []
    for field in dict.fromkeys(row["light_field"] for row in results["frames"]):
        lines = {}
        for row in sorted(results["frames"], key=lambda row: row["mse_total"]):
            name, _, cache = row["frame"].split(":")
            if row["light_field"] == field and int(cache) == max(CACHES) and row["mse_total"] > 0:
                profile = row["coding"].split()[0].replace("hmlfc", "main, levels 1 to 4" if name == FILTERS[-1] else "main")
                line = lines.setdefault(f"{profile}: {name}", ([], []))
                line[0].append(1e3 * row["median_cpu_seconds"])
                line[1].append(psnr_of_mse(row["mse_total"]))
        curves = [Curve(name, *line) for name, line in lines.items()]
        panels.append(Panel(field, curves, "CPU ms a frame, median", "PSNR RGB, dB", ""))
    if panels:
        draw(folder / f"{prefix}renderer.png", [panel for panel in panels if panel.title in SHOWN] or panels, 3)
