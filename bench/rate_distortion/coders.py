"""The codecs of the rate-distortion bench.

A codec is made for one light field: a function from a parameter to (name of the parameter, bytes, PSNR
in dB, CPU seconds of encoding on all threads). Of codecs of pictures and videos, its picture_bytes are the
bytes of each picture of the last encoding, in coding order.
"""

import io
import json
import math
import time

import numpy as np
from PIL import Image, features

import x265
from light_field import load, squared_error
from process import BenchError, run

PSNR_TOLERANCE = 0.01  # dB, between what hmlfc says and what its decoded views give
HMLFC = {
    **{f"main-{method}": ["--profile", "main", "--method", method] for method in ("hmlfc", "rlfc", "mc")},
    "extended": ["--profile", "extended"],
}
KEYINTS = {"x265-intra": 1, "x265-inter": -1}
PICTURES = {  # Pillow's name, the parameter, arguments of Image.save
    "jpeg": ("jpg", "quality", lambda quality: {"format": "JPEG", "quality": quality, "optimize": True}),
    # One quality layer at 1 : ratio of 24 bits a pixel, YCbCr, 9/7 wavelet, a bare codestream.
    "jpeg2000": ("jpg_2000", "ratio", lambda ratio: {
        "format": "JPEG2000", "irreversible": True, "mct": 1, "no_jp2": True,
        "quality_mode": "rates", "quality_layers": [ratio],
    }),
}
NAMES = (*HMLFC, *KEYINTS, *PICTURES)


def make(name, light_field, chroma, options, work):
    """The codec of this name, or BenchError where it is not installed. chroma: of profile main; work: a
    folder for its files."""
    if name in HMLFC:
        arguments = [*HMLFC[name], *(["--chroma", chroma] if name.startswith("main-") else [])]
        return hmlfc(options.hmlfc, arguments, light_field, work)
    if name in KEYINTS:
        x265.require()
        return video(KEYINTS[name], x265.X265(light_field, options.x265_chroma, work))
    format_name, label, arguments = PICTURES[name]
    if not features.check_codec(format_name):
        raise BenchError(f"Pillow was built without {name}: install the Debian package python3-pil")
    return pictures(label, arguments, light_field)


def hmlfc(program, options, light_field, work):
    """`hmlfc encode --quality` with options. The first stream of a curve is decoded as well, to see
    that its PSNR is what this bench computes for all codecs."""
    stream, decoded = work / "stream.hmlfc", work / "decoded"

    def encode(value):
        # Other coders do not say where cameras stand either.
        command = [program, "encode", light_field.folder, "-o", stream, "--no-rig", *options]
        report = json.loads(run([*command, "--quality", f"{value:g}", "--json"])[0])
        if (report["rows"], report["cols"]) != (light_field.rows, light_field.cols):
            raise BenchError(f"hmlfc sees {report['rows']}x{report['cols']} views")
        psnr = float(report["psnr_rgb"])
        if not encode.checked:
            check(psnr)
            encode.checked = True
        return f"quality={value:g}", stream.stat().st_size, psnr, report["cpu_seconds"]

    def check(said):
        run([program, "decode", stream, "-o", decoded])
        views = load("decoded", decoded).views
        for path in decoded.iterdir():
            path.unlink()
        measured = light_field.psnr(sum(map(squared_error, light_field.views, views)))
        if not math.isclose(measured, said, abs_tol=PSNR_TOLERANCE):
            raise BenchError(f"hmlfc says {said:.3f} dB, its decoded views have {measured:.3f} dB")

    encode.checked = False
    return encode


def video(keyint, encoder):
    """x265 on the views in serpentine order."""

    def encode(value):
        size, error, seconds, chroma = encoder.encode(keyint, value)
        encode.picture_bytes = encoder.picture_bytes
        return f"crf={value:g} chroma={chroma}", size, encoder.light_field.psnr(error), seconds

    return encode


def pictures(label, options, light_field):
    """A still-picture codec of Pillow, view by view."""

    def encode(value):
        encode.picture_bytes = []
        error = 0
        seconds = 0.0
        for view in light_field.views:
            file = io.BytesIO()
            begin = time.process_time()
            Image.fromarray(view).save(file, **options(value))
            seconds += time.process_time() - begin
            encode.picture_bytes.append(file.tell())
            with Image.open(file) as image:
                error += squared_error(view, np.asarray(image))
        return f"{label}={value:g}", sum(encode.picture_bytes), light_field.psnr(error), seconds

    return encode
