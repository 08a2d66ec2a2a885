"""The codecs of the rate-distortion bench. Each makes one point of its curve of a light field."""

import io
import json
import math
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, features

import x265
from bench_error import BenchError
from light_field import load, squared_error
from process import run

PSNR_TOLERANCE = 0.01  # dB, between what hmlfc says and what its decoded views give


@dataclass
class Point:
    """One point of a curve. seconds: CPU time of encoding on all threads."""

    light_field: str
    codec: str
    parameter: str
    bpp: float
    psnr_rgb: float
    seconds: float


@dataclass
class Tools:
    """What the codecs work with. hmlfc: the program; work: a folder for their files."""

    hmlfc: Path
    work: Path
    main_chroma: str  # of hmlfc profile main
    x265_chroma: str


class Codec:
    """A codec and the light field it encodes. encode(value) makes the point of one parameter."""

    def __init__(self, name, light_field):
        self.name, self.light_field = name, light_field

    def encode(self, value):
        raise NotImplementedError

    def close(self):
        """Removes what the codec keeps between two points."""

    def point(self, parameter, size, psnr, seconds):
        bpp = self.light_field.bpp(size)
        return Point(self.light_field.name, self.name, parameter, bpp, psnr, seconds)


class Hmlfc(Codec):
    """`hmlfc encode --quality` with options. The first stream of a curve is decoded, too, to see
    that its PSNR is what this bench computes for all codecs."""

    def __init__(self, name, options, tools, light_field):
        super().__init__(name, light_field)
        self.options = options
        self.hmlfc, self.folder = tools.hmlfc, tools.work
        self.checked = False

    def encode(self, value):
        stream = self.folder / "stream.hmlfc"
        command = [self.hmlfc, "encode", self.light_field.folder, "-o", stream, *self.options]
        said, _ = run([*command, "--quality", f"{value:g}", "--json"])
        report = json.loads(said)
        if (report["rows"], report["cols"]) != (self.light_field.rows, self.light_field.cols):
            raise BenchError(f"hmlfc sees {report['rows']}x{report['cols']} views")
        if not self.checked:
            self._check(stream, float(report["psnr_rgb"]))
        parameter = f"quality={value:g}"
        size, psnr = stream.stat().st_size, float(report["psnr_rgb"])
        return self.point(parameter, size, psnr, report["cpu_seconds"])

    def close(self):
        (self.folder / "stream.hmlfc").unlink(missing_ok=True)

    def _check(self, stream, said):
        """Decodes the stream to views and compares its PSNR with what encoding said."""
        decoded = self.folder / "decoded"
        run([self.hmlfc, "decode", stream, "-o", decoded])
        views = load("decoded", decoded).views
        for path in decoded.iterdir():
            path.unlink()
        error = sum(map(squared_error, self.light_field.views, views))
        measured = self.light_field.psnr(error)
        if not math.isclose(measured, said, abs_tol=PSNR_TOLERANCE):
            raise BenchError(f"hmlfc says {said:.3f} dB, its decoded views have {measured:.3f} dB")
        self.checked = True


class Video(Codec):
    """x265 on the views in serpentine order."""

    def __init__(self, name, keyint, tools, light_field):
        super().__init__(name, light_field)
        self.keyint = keyint
        self.x265 = x265.X265(light_field, tools.x265_chroma, tools.work)

    def encode(self, value):
        size, error, seconds, chroma = self.x265.encode(self.keyint, value)
        parameter = f"crf={value:g} chroma={chroma}"
        return self.point(parameter, size, self.light_field.psnr(error), seconds)

    def close(self):
        self.x265.close()


class Pictures(Codec):
    """A still-picture codec of Pillow, view by view."""

    def __init__(self, name, label, options, light_field):
        """options: from a parameter to the arguments of Image.save."""
        super().__init__(name, light_field)
        self.label, self.options = label, options

    def encode(self, value):
        size = error = 0
        seconds = 0.0
        for view in self.light_field.views:
            file = io.BytesIO()
            begin = time.process_time()
            Image.fromarray(view).save(file, **self.options(value))
            seconds += time.process_time() - begin
            size += file.tell()
            with Image.open(file) as image:
                error += squared_error(view, np.asarray(image))
        parameter = f"{self.label}={value:g}"
        return self.point(parameter, size, self.light_field.psnr(error), seconds)


def jpeg_options(quality):
    return {"format": "JPEG", "quality": quality, "optimize": True}


def jpeg2000_options(ratio):
    """One quality layer at 1 : ratio of 24 bits a pixel, YCbCr, 9/7 wavelet, a bare codestream."""
    return {
        "format": "JPEG2000",
        "irreversible": True,
        "mct": 1,
        "quality_mode": "rates",
        "quality_layers": [ratio],
        "no_jp2": True,
    }


def make(name, light_field, tools):
    """The codec of this name for a light field, or BenchError where it is not installed."""
    if name.startswith("main-"):
        options = ["--profile", "main", "--method", name.removeprefix("main-")]
        options += ["--chroma", tools.main_chroma]
        return Hmlfc(name, options, tools, light_field)
    if name == "extended":
        return Hmlfc(name, ["--profile", "extended"], tools, light_field)
    if name in KEYINTS:
        x265.require()
        return Video(name, KEYINTS[name], tools, light_field)
    format_name, label, options = PICTURES[name]
    if not features.check_codec(format_name):
        raise BenchError(f"Pillow was built without {name}: install the Debian package python3-pil")
    return Pictures(name, label, options, light_field)


KEYINTS = {"x265-intra": 1, "x265-inter": -1}
PICTURES = {
    "jpeg": ("jpg", "quality", jpeg_options),
    "jpeg2000": ("jpg_2000", "ratio", jpeg2000_options),
}
NAMES = ("main-hmlfc", "main-rlfc", "main-mc", "extended", *KEYINTS, *PICTURES)
