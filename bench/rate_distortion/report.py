"""What the rate-distortion bench writes: curves as CSV and PNG, bits at equal PSNR as a table."""

import csv
import math
from dataclasses import astuple, dataclass, fields

from light_field import bpp_at
from result_file import table

COMPARED = ("extended", "main-hmlfc", "x265-intra", "x265-inter")
RATIOS = (("x265-intra", "extended"), ("x265-inter", "extended"), ("main-hmlfc", "extended"))
STYLES = {  # label, colour, line, marker
    "extended": ("HMLFC extended", "#d62728", "-", "o"),
    "main-hmlfc": ("HMLFC main hmlfc", "#ff7f0e", "-", "s"),
    "main-rlfc": ("HMLFC main rlfc", "#e0a458", "--", "v"),
    "main-mc": ("HMLFC main mc", "#8c564b", "--", "^"),
    "x265-inter": ("x265 inter, serpentine", "#1f77b4", "-", "D"),
    "x265-intra": ("x265 all-intra", "#17becf", "-", "P"),
    "jpeg2000": ("JPEG 2000 per view", "#2ca02c", ":", "X"),
    "jpeg": ("JPEG per view", "#7f7f7f", ":", "*"),
}


@dataclass
class Point:
    """One point of a curve. seconds: CPU time of encoding on all threads."""

    light_field: str
    codec: str
    parameter: str
    bpp: float
    psnr_rgb: float
    seconds: float


def write_csv(points, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([field.name for field in fields(Point)])
        for point in points:
            *names, bpp, psnr, seconds = astuple(point)
            writer.writerow([*names, f"{bpp:.6f}", f"{psnr:.4f}", f"{seconds:.2f}"])


def equal_psnr(points, at):
    """For each light field of at ({name: PSNR in dB}): the bpp of each codec and their ratios."""
    rows = []
    for name, psnr in at.items():
        curves = {}
        for point in points:
            if point.light_field == name:
                curves.setdefault(point.codec, []).append((point.psnr_rgb, point.bpp))
        bpp = {codec: bpp_at(curve, psnr) for codec, curve in curves.items()}
        ratios = {
            f"{codec}/{base}": bpp[codec] / bpp[base]
            for codec, base in RATIOS
            if bpp.get(codec) and bpp.get(base)
        }
        rows.append({"light_field": name, "psnr_rgb": psnr, "bpp": bpp, "ratios": ratios})
    return rows


def points_table(points):
    rows = []
    for point in points:
        *names, bpp, psnr, seconds = astuple(point)
        rows.append((*names, f"{bpp:.4f}", f"{psnr:.2f}", f"{seconds:.1f}"))
    return table(("light field", "codec", "parameter", "bpp", "PSNR RGB", "CPU s"), rows)


def equal_psnr_table(rows):
    """Bits a pixel of COMPARED, log bpp linear in PSNR between two measured points, - where a curve does
    not reach it; then RATIOS of them."""
    names = [f"{codec}/{base}" for codec, base in RATIOS]
    cells = [
        (row["light_field"], f"{row['psnr_rgb']:g}",
         *(_number(row["bpp"].get(codec), "{:.4f}") for codec in COMPARED),
         *(_number(row["ratios"].get(name), "{:.2f}") for name in names))
        for row in rows
    ]
    return table(("light field", "dB", *COMPARED, *names), cells)


def _number(value, form):
    return "-" if value is None else form.format(value)


def plot(points, light_fields, at, path):
    """One panel a light field: bpp (logarithmic) against PSNR RGB. A dashed line: PSNR of `at`.

    light_fields: {name: description}. Raises ImportError without matplotlib."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.rcParams["font.size"] = 12
    figure, panels = pyplot.subplots(1, len(light_fields), figsize=(14, 5.6), squeeze=False)
    lines = {}
    for panel, (name, description) in zip(panels[0], light_fields.items()):
        lines |= _draw_curves(panel, [point for point in points if point.light_field == name])
        panel.axhline(at[name], color="black", linewidth=0.8, linestyle=(0, (4, 4)))
        panel.set_xscale("log")
        panel.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        panel.set_title(description, fontsize=13)
        panel.set_xlabel("bits a pixel (logarithmic)")
        panel.grid(True, which="both", color="#e4e4e4")
    panels[0][0].set_ylabel("PSNR RGB, dB")
    handles = [lines[codec] for codec in STYLES if codec in lines]
    figure.legend(handles=handles, loc="lower center", ncol=4, fontsize=13, frameon=False)
    figure.suptitle("Rate against quality, all views of each light field (upper left is better)")
    figure.tight_layout(rect=(0, 0.12, 1, 0.99))
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def _draw_curves(panel, points):
    """{codec: its line}"""
    drawn = {}
    for codec, (label, colour, line, marker) in STYLES.items():
        curve = sorted((p.bpp, p.psnr_rgb) for p in points if p.codec == codec)
        finite = [(bpp, psnr) for bpp, psnr in curve if math.isfinite(psnr)]
        if finite:
            drawn[codec], = panel.plot(*zip(*finite), color=colour, linestyle=line, marker=marker,
                                       linewidth=2, label=label)
    return drawn
