"""What the accuracy report measures of a light field: encodings, decodings and frames."""

import hashlib
import json
import math
import time
import zlib
from dataclasses import dataclass

import numpy as np
from skimage.metrics import structural_similarity

from light_field import load, open_stream, real_sources, scene
from process import BENCH, HMLFC, BenchError, bench_json, hmlfc_json, run_measured, say
from studies import arguments, extended, frame_settings, label, main, studies

SCENES = {False: ("cards", "knights", "glass", "flat", "noise"), True: ("cards", "noise")}  # --quick
SIZES = {False: ("9x9", "256x192"), True: ("5x5", "96x64")}
REAL_NAMES = ("chess", "antinous", "knights")  # more would take hours
SYNTHETIC_AT, SYNTHETIC_CHROMA = 36.0, "444"  # halved chroma ends at 31 dB on knights, at 34 dB on glass
# Fixed work whose CPU time measures the current speed of the machine: 1 MiB of hexadecimal digits.
WORK = "".join(hashlib.sha256(bytes([k % 256, k // 256])).hexdigest() for k in range(16384)).encode()
DECODE_RUNS = 3
FRAMES = {False: (24, 256), True: (12, 64)}  # number, pixels along a side
SECTIONS = ("index", "motion", "residual", "top")
# SSIM as in Wang, Bovik, Sheikh and Simoncelli: weights of a Gaussian of 1.5 pixels.
SSIM = {"gaussian_weights": True, "sigma": 1.5, "use_sample_covariance": False, "data_range": 255}


@dataclass
class Field:
    """A light field with the name that the report has for it. at: dB to compare methods at; chroma: of profile main."""

    name: str
    folder: object
    at: float
    chroma: str


def fields(work, quick, names):
    """The real light fields that exist, then the built-in scenes. quick: two small scenes; names: those to take, or
    empty for all."""
    real = [] if quick else real_sources(say)
    taken = [(s.name, lambda s=s: Field(s.name, s.folder, s.at, s.chroma)) for s in real if s.name in REAL_NAMES]
    for name in SCENES[quick]:
        taken.append((f"synth-{name}", lambda name=name: Field(
            f"synth-{name}", scene(work, name, *SIZES[quick]), SYNTHETIC_AT, SYNTHETIC_CHROMA)))
    found = [make() for name, make in taken if not names or name in names]
    if not found:
        raise BenchError("none of the light fields asked for is there")
    return found


def measure(options, work):
    """The results: groups light_fields, encodings and frames."""
    results = {"light_fields": [], "encodings": [], "frames": []}
    codings = {label(coding): coding for name, made in studies(options.quick).items()
               if name in options.studies for coding in made}
    for field in fields(work, options.quick, options.light_field):
        views = load(field.name, field.folder)
        results["light_fields"].append({
            "light_field": field.name, "views": f"{views.rows}x{views.cols}", "size": f"{views.width}x{views.height}",
            "chroma": field.chroma, "at": field.at})
        lumas = {place: luma(views.grid[place]) for place in places(views.rows, views.cols)}
        for name, coding in codings.items():
            say(f"{field.name}: {name}")
            results["encodings"].append({"light_field": field.name, "coding": name, **encoding(field, coding, lumas, work)})
        if "renderer" in options.studies:
            say(f"{field.name}: frames")
            for coding in (main(), extended()):
                results["frames"] += frames(field, coding, work, options.quick)
    return results


def encoding(field, coding, lumas, work):
    """The values of an encoding and its decoding; docs/accuracy.md explains them."""
    row = {"calibration_seconds": calibration_seconds()}
    report, peak = encode(field, coding, work / "stream.hmlfc")
    said, cost = run_measured([BENCH, "decode", work / "stream.hmlfc", DECODE_RUNS])
    decoded = json.loads(said)
    stream = open_stream(work / "stream.hmlfc")
    states = hmlfc_json("info", work / "stream.hmlfc")["states"]
    row |= {name: report[name] for name in ("bytes", "bpp", "psnr_rgb", "psnr_y", "max_abs_error")}
    row["ssim_y"] = float(np.mean([structural_similarity(view, luma(stream[place]), **SSIM) for place, view in lumas.items()]))
    row |= {f"{name}_bytes": report["sections"][name] for name in SECTIONS}
    return row | {
        "without_residual": (states["zero"] + states["motion"]) / sum(states.values()),
        "encode_cpu_seconds": report["cpu_seconds"], "encode_peak_bytes": peak,
        "decode_cpu_seconds": decoded["cpu_seconds"], "decode_peak_bytes": cost.peak_bytes,
        "reference_bytes": decoded["reference_bytes"],
    }


def frames(field, coding, work, quick):
    """A row for each setting that frames of the encoding are drawn with."""
    stream, source = work / "frames.hmlfc", work / "lossless.hmlfc"
    encode(field, coding, stream)
    hmlfc_json("encode", field.folder, "-o", source, "--no-rig", "--preset", "fast", "--lossless")
    settings = frame_settings(hmlfc_json("info", stream)["tree_height"] + 1)
    rows = bench_json("frames", stream, source, *FRAMES[quick], *settings)
    return [{"light_field": field.name, "coding": label(coding), **row} for row in rows]


def encode(field, coding, stream):
    """(What `hmlfc encode --json` says, the largest memory of the process in bytes)."""
    command = [HMLFC, "encode", field.folder, "-o", stream, "--no-rig", "--json", *arguments(coding, field.chroma)]
    said, cost = run_measured(command)
    report = json.loads(said)
    return report | {name: float(report[name]) for name in ("psnr_rgb", "psnr_y")}, cost.peak_bytes


def places(rows, cols):
    """The corners, the middles of the borders and the centre of a grid."""
    return [(row, col) for row in sorted({0, (rows - 1) // 2, rows - 1}) for col in sorted({0, (cols - 1) // 2, cols - 1})]


def luma(view):
    """Y of YCoCg-R, as float64."""
    red, green, blue = np.moveaxis(view.astype(np.int32), -1, 0)
    base = blue + ((red - blue) >> 1)
    return (base + ((green - base) >> 1)).astype(np.float64)


def calibration_seconds():
    """CPU seconds of compressing WORK, the least of three."""
    seconds = math.inf
    for _ in range(3):
        begin = time.process_time()
        zlib.compress(WORK, 6)
        seconds = min(seconds, time.process_time() - begin)
    return seconds
