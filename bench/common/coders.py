"""The codecs of the benches rate_distortion and access.

make() gives the codec of a light field: a function from a parameter to an Encoded.
"""

import io
import math
import time
from dataclasses import dataclass, field

import numpy as np
from PIL import Image

import x265
from light_field import load, squared_error
from process import BenchError, bench_json, hmlfc, hmlfc_json

PSNR_TOLERANCE = 0.01  # dB, between what hmlfc says and what its decoded views give
HMLFC = {
    **{f"main-{method}": ["--profile", "main", "--method", method] for method in ("hmlfc", "rlfc", "mc")},
    "main-weighed": ["--profile", "main", "--rate-distortion"],
    "extended": ["--profile", "extended"],
}
KEYINTS = {"x265-intra": 1, "x265-inter": -1}
PICTURES = {  # arguments of Pillow's Image.save
    "jpeg": lambda quality: {"format": "JPEG", "quality": quality, "optimize": True},
    "jpeg-444": lambda quality: {"format": "JPEG", "quality": quality, "optimize": True, "subsampling": 0},
    # One quality layer at 1 : ratio of 24 bits a pixel, YCbCr, 9/7 wavelet, a bare codestream.
    "jpeg2000": lambda ratio: {"format": "JPEG2000", "irreversible": True, "mct": 1, "no_jp2": True,
                               "quality_mode": "rates", "quality_layers": [ratio]},
}
NAMES = (*HMLFC, *KEYINTS, "jpeg", "jpeg2000")


@dataclass
class Encoded:
    """bytes of the file; psnr over RGB in dB; CPU seconds on all threads of encoding and of decoding all views (None:
    not timed); of pictures and videos the bytes of each picture in coding order."""

    bytes: int
    psnr: float
    encode_seconds: float
    decode_seconds: float | None = None
    picture_bytes: list = field(default_factory=list)


def make(name, light_field, chroma, work):
    """The codec of this name; BenchError where it is not installed. chroma: of profile main; work: a folder for its
    files."""
    if name in HMLFC:
        chroma = ["--chroma", chroma] if name.startswith("main-") else []
        return _hmlfc([*HMLFC[name], *chroma], light_field, work)
    if name in KEYINTS:
        encoder = x265.X265(light_field, work)
        return lambda crf: _video(encoder, KEYINTS[name], crf)
    return lambda value: _pictures(PICTURES[name](value), light_field)


def _hmlfc(options, light_field, work):
    """`hmlfc encode --quality` with options. The first stream of a curve is decoded as well, to see
    that its PSNR is what this bench computes for all codecs."""
    stream = work / "stream.hmlfc"
    checked = []

    def encode(value):
        # Other coders do not say where cameras stand either.
        report = hmlfc_json("encode", light_field.folder, "-o", stream, "--no-rig", *options, "--quality", value)
        if (report["rows"], report["cols"]) != (light_field.rows, light_field.cols):
            raise BenchError(f"hmlfc sees {report['rows']}x{report['cols']} views")
        psnr = float(report["psnr_rgb"])
        if not checked:
            _check(stream, light_field, psnr, work / "decoded")
            checked.append(value)
        return Encoded(report["bytes"], psnr, report["cpu_seconds"], bench_json("decode", stream, 1)["cpu_seconds"])

    return encode


def _check(stream, light_field, said, folder):
    hmlfc("decode", stream, "-o", folder)
    views = load("decoded", folder).views
    for path in folder.iterdir():
        path.unlink()
    measured = light_field.psnr(sum(map(squared_error, light_field.views, views)))
    if not math.isclose(measured, said, abs_tol=PSNR_TOLERANCE):
        raise BenchError(f"hmlfc says {said:.3f} dB, its decoded views have {measured:.3f} dB")


def _video(encoder, keyint, crf):
    size, error, seconds, picture_bytes = encoder.encode(keyint, crf)
    return Encoded(size, encoder.light_field.psnr(error), seconds, None, picture_bytes)


def _pictures(options, light_field):
    """A still-picture codec of Pillow, view by view."""
    sizes, error, encoding, decoding = [], 0, 0.0, 0.0
    for view in light_field.views:
        file = io.BytesIO()
        begin = time.process_time()
        Image.fromarray(view).save(file, **options)
        middle = time.process_time()
        sizes.append(file.tell())
        with Image.open(file) as image:
            decoded = np.asarray(image)
        decoding += time.process_time() - middle
        encoding += middle - begin
        error += squared_error(view, decoded)
    return Encoded(sum(sizes), light_field.psnr(error), encoding, decoding, sizes)
