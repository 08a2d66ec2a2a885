"""x265 on a light field as a video: all-intra, or inter prediction without any restriction.

The views go in as Y4M, BT.709 YCbCr of 8 bits and limited range in 4:4:4, and come back as the encoder's own
reconstruction; the size is that of the whole HEVC stream. --no-info leaves out the text about its options that x265
would write into each key picture, some 2300 bytes: with it, all-intra would look much worse than it is.
"""

import re
import shutil

import numpy as np

from light_field import squared_error
from process import BenchError, run_measured

PROGRAM = PACKAGE = "x265"
SIDE_MULTIPLE = 8  # samples; the smallest coding unit
OPTIONS = ["--preset", "medium", "--tune", "psnr", "--no-info", "--no-progress"]
# Of BT.709 in double precision; each sample is rounded once, to the nearest.
KR, KG, KB = 0.2126, 0.7152, 0.0722
LUMA_GAIN = 219.0 / 255.0
CB_GAIN = 224.0 / 255.0 / (2.0 * (1.0 - KB))
CR_GAIN = 224.0 / 255.0 / (2.0 * (1.0 - KR))


def to_ycbcr(view):
    """Planes (Y, Cb, Cr), uint8, of a uint8 RGB view."""
    red, green, blue = (view[..., channel].astype(np.float64) for channel in range(3))
    luma = KR * red + KG * green + KB * blue
    planes = (16.0 + LUMA_GAIN * luma, 128.0 + CB_GAIN * (blue - luma), 128.0 + CR_GAIN * (red - luma))
    return tuple(map(_to_bytes, planes))


def to_rgb(planes):
    """The uint8 RGB view of planes (Y, Cb, Cr)."""
    luma = (planes[0] - 16.0) / LUMA_GAIN
    blue, red = (planes[1] - 128.0) / CB_GAIN, (planes[2] - 128.0) / CR_GAIN
    return _to_bytes(np.stack([luma + red, luma - (KB * blue + KR * red) / KG, luma + blue], axis=-1))


def _to_bytes(values):
    return np.clip(np.floor(values + 0.5), 0, 255).astype(np.uint8)


class X265:
    """Encodes one light field, its views in serpentine order; the video is made once and kept in `folder`."""

    def __init__(self, light_field, folder):
        if not shutil.which(PROGRAM):
            raise BenchError(f"no program {PROGRAM}: install the Debian package {PACKAGE}")
        self.light_field = light_field
        self.order = light_field.serpentine()
        self.height = light_field.height + -light_field.height % SIDE_MULTIPLE
        self.width = light_field.width + -light_field.width % SIDE_MULTIPLE
        self.video, self.stream, self.reconstruction = (folder / f"x265.{kind}" for kind in ("y4m", "hevc", "yuv"))
        self._write_video()

    def encode(self, keyint, crf):
        """keyint: 1 all-intra, -1 free inter. Returns (bytes, squared error, CPU s, bytes of each picture)."""
        command = [PROGRAM, "--y4m", "--input", self.video, "--output", self.stream]
        command += ["--recon", self.reconstruction, "--keyint", str(keyint), "--crf", str(crf)]
        _, cost = run_measured([*command, *OPTIONS])
        stream = self.stream.read_bytes()
        return len(stream), self._error_of_reconstruction(), cost.cpu_seconds, picture_bytes(stream)

    def _write_video(self):
        below, right = self.height - self.light_field.height, self.width - self.light_field.width
        with open(self.video, "wb") as video:
            video.write(f"YUV4MPEG2 W{self.width} H{self.height} F25:1 Ip A1:1 C444\n".encode())
            for number in self.order:
                padded = np.pad(self.light_field.views[number], ((0, below), (0, right), (0, 0)), mode="edge")
                video.write(b"FRAME\n" + b"".join(plane.tobytes() for plane in to_ycbcr(padded)))

    def _error_of_reconstruction(self):
        error = 0
        with open(self.reconstruction, "rb") as reconstruction:
            for number in self.order:
                view = self.light_field.views[number]
                planes = np.frombuffer(reconstruction.read(3 * self.height * self.width), np.uint8)
                decoded = to_rgb(planes.reshape(3, self.height, self.width))
                error += squared_error(view, decoded[: view.shape[0], : view.shape[1]])
        return error


def picture_bytes(stream):
    """Bytes of each picture of an HEVC byte stream, in coding order; what stands before the first one counts
    to it, what stands between two to the one before."""
    starts = [match.start() for match in re.finditer(rb"\x00\x00\x01", stream)]
    # The type is in bits 1 to 6; below 32 it is a slice, whose first bit tells a picture's first (H.265, 7.3.1, 7.3.6).
    first = [at for at in starts if stream[at + 3] >> 1 < 32 and stream[at + 5] >> 7]
    return [end - begin for begin, end in zip([0, *first[1:]], [*first[1:], len(stream)])]
