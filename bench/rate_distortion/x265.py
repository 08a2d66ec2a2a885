"""x265 on a light field as a video: all-intra, or inter prediction without any restriction.

The views go in as Y4M (colour) and come back as the encoder's own reconstruction; the size is
that of the whole HEVC stream. --no-info leaves out the text about its options that x265 would write
into each key picture, some 2300 bytes: with it, all-intra would look much worse than it is.
"""

import re
import shutil

import numpy as np

import colour
from light_field import squared_error
from process import BenchError, run

PROGRAM = "x265"
PACKAGE = "x265"
SIDE_MULTIPLE = 8  # samples; the smallest coding unit
FIXED_OPTIONS = ["--preset", "medium", "--tune", "psnr", "--no-info", "--no-progress"]
ENLARGERS = {
    "420": {"bilinear": colour.bilinear, "replicated": colour.replicate},
    "444": {"full": colour.same},
}


class X265:
    """Encodes one light field; the video is made once and kept in `folder`.

    chroma: "420" or "444". picture_bytes: of the last stream, in coding order.
    """

    def __init__(self, light_field, chroma, folder):
        self.light_field = light_field
        self.chroma = chroma
        self.order = light_field.serpentine()
        self.picture_bytes = []
        self.video = folder / f"{light_field.name}-{chroma}.y4m"
        self.stream = folder / "x265.hevc"
        self.reconstruction = folder / "x265.yuv"

    def encode(self, keyint, crf):
        """keyint: 1 all-intra, -1 free inter. Returns (bytes, squared error, CPU s, chroma)."""
        if not self.video.exists():
            self._write_video()
        command = [PROGRAM, "--y4m", "--input", self.video, "--output", self.stream]
        command += ["--recon", self.reconstruction, "--keyint", str(keyint), "--crf", str(crf)]
        _, seconds = run([*command, *FIXED_OPTIONS])
        error, enlarger = self._error_of_reconstruction()
        self.picture_bytes = picture_bytes(self.stream.read_bytes())
        size = self.stream.stat().st_size
        self.stream.unlink()
        self.reconstruction.unlink()
        return size, error, seconds, f"{self.chroma} {enlarger}"

    def _write_video(self):
        with open(self.video, "wb") as video:
            for index, number in enumerate(self.order):
                padded = colour.pad(self.light_field.views[number], SIDE_MULTIPLE)
                if index == 0:
                    video.write(self._y4m_header(padded.shape))
                video.write(b"FRAME\n")
                for plane in colour.to_ycbcr(padded, self.chroma):
                    video.write(plane.tobytes())

    def _y4m_header(self, shape):
        return f"YUV4MPEG2 W{shape[1]} H{shape[0]} F25:1 Ip A1:1 C{self.chroma}\n".encode()

    def _error_of_reconstruction(self):
        """(squared error, name of the enlarger of chroma) for the enlarger with the least error."""
        errors = dict.fromkeys(ENLARGERS[self.chroma], 0)
        with open(self.reconstruction, "rb") as reconstruction:
            for number in self.order:
                view = self.light_field.views[number]
                planes = self._read_planes(reconstruction)
                for name in errors:
                    rgb = colour.to_rgb(planes, ENLARGERS[self.chroma][name])
                    errors[name] += squared_error(view, rgb[: view.shape[0], : view.shape[1]])
        best = min(errors, key=errors.get)
        return errors[best], best

    def _read_planes(self, reconstruction):
        """The next frame: planes Y, Cb, Cr."""
        width = self.light_field.width + -self.light_field.width % SIDE_MULTIPLE
        height = self.light_field.height + -self.light_field.height % SIDE_MULTIPLE
        step = 2 if self.chroma == "420" else 1
        shapes = [(height, width)] + 2 * [(height // step, width // step)]
        return [
            np.frombuffer(reconstruction.read(rows * cols), np.uint8).reshape(rows, cols)
            for rows, cols in shapes
        ]


def picture_bytes(stream):
    """Bytes of each picture of an HEVC byte stream, in coding order; what stands before the first one counts
    to it, what stands between two to the one before."""
    starts = [match.start() for match in re.finditer(rb"\x00\x00\x01", stream)]
    # The type is in bits 1 to 6; below 32 it is a slice, whose first bit tells a picture's first (H.265, 7.3.1, 7.3.6).
    first = [at for at in starts if stream[at + 3] >> 1 < 32 and stream[at + 5] >> 7]
    return [end - begin for begin, end in zip([0, *first[1:]], [*first[1:], len(stream)])]


def require():
    """Raises BenchError where there is no x265."""
    if not shutil.which(PROGRAM):
        raise BenchError(f"no program {PROGRAM}: install the Debian package {PACKAGE}")
