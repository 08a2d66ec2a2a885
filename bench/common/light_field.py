"""Light fields for benchmarks: folders of 8-bit RGB views, PSNR and rates."""

import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, UnidentifiedImageError

from process import BUILT, BenchError

sys.path.append(str(BUILT / "tools" / "python"))

import hmlfc  # noqa: E402


@dataclass
class LightField:
    """A grid of views. views: uint8, [view in row-major order, y, x, RGB]."""

    name: str
    folder: Path
    rows: int
    cols: int
    views: np.ndarray

    @property
    def width(self):
        return self.views.shape[2]

    @property
    def height(self):
        return self.views.shape[1]

    @property
    def pixels(self):
        """Pixels of all views."""
        return self.rows * self.cols * self.width * self.height

    def serpentine(self):
        """View numbers in video order: each second row backwards, so that neighbours follow."""
        grid = np.arange(self.rows * self.cols).reshape(self.rows, self.cols)
        grid[1::2] = grid[1::2, ::-1].copy()
        return [int(view) for view in grid.ravel()]

    def bpp(self, size):
        """Bits a pixel of `size` bytes."""
        return 8.0 * size / self.pixels

    def psnr(self, squared_error):
        """PSNR in dB of a sum of squared errors over all views and the three channels."""
        if squared_error == 0:
            return math.inf
        return 10.0 * math.log10(255.0**2 * 3 * self.pixels / squared_error)


def squared_error(view, decoded):
    """Sum over pixels and channels of the squared differences of two uint8 views."""
    if view.shape != decoded.shape:
        raise BenchError(f"a decoded view is {decoded.shape}, the source {view.shape}")
    difference = view.astype(np.int32) - decoded
    return int(np.sum(difference * difference, dtype=np.int64))


def read_views(folder):
    """The views of a folder, whose file names give their positions: uint8 [row, col, y, x, RGB]."""
    try:
        views = hmlfc.read_views(folder)
    except OSError as error:
        raise BenchError(str(error)) from error
    if views.depth != 8:
        raise BenchError(f"{folder}: {views.depth} bits a sample; this bench takes 8")
    return views.pixels


def load(name, folder):
    views = read_views(folder)
    rows, cols = views.shape[:2]
    return LightField(name, Path(folder), rows, cols, views.reshape(rows * cols, *views.shape[2:]))


def read_view(path):
    """One 8-bit RGB picture as uint8 [y, x, RGB]."""
    try:
        with Image.open(path) as image:
            if image.mode != "RGB":
                raise BenchError(f"{path} is {image.mode}; this bench takes 8-bit RGB views only")
            return np.asarray(image)
    except (UnidentifiedImageError, OSError) as error:
        raise BenchError(f"{path}: {error}") from error


def bpp_at(curve, psnr):
    """Bits a pixel of a curve at a PSNR in dB: log(bpp) linear in PSNR between the two points
    around it. None where the curve does not reach it: nothing is extrapolated.

    curve: pairs (PSNR in dB, bits a pixel)."""
    curve = sorted(curve)
    for (low, low_bpp), (high, high_bpp) in zip(curve, curve[1:]):
        if low <= psnr <= high and high > low and math.isfinite(high):
            share = (psnr - low) / (high - low)
            return math.exp((1 - share) * math.log(low_bpp) + share * math.log(high_bpp))
    return None
