"""Light fields for benchmarks: folders of 8-bit RGB views, their order, PSNR and rates."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, UnidentifiedImageError

from process import BenchError

SUFFIXES = {".png", ".ppm", ".jpg", ".jpeg"}
GRID_NAMES = (
    re.compile(r"out_(\d{1,4})_(\d{1,4})_[-+\d.]+_[-+\d.]+_?"),
    re.compile(r"(?:.*_)?(\d{1,4})_(\d{1,4})"),
)
CAMERA_NAME = re.compile(r"input_Cam(\d{1,8})")


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


def load(name, folder):
    """Reads all views of a folder, whose file names give their positions."""
    rows, cols, ordered = view_files(folder)
    first = read_view(ordered[0])
    views = np.empty((len(ordered), *first.shape), np.uint8)
    for index, path in enumerate(ordered):
        view = read_view(path)
        if view.shape != first.shape:
            raise BenchError(f"{path} differs in size from {ordered[0].name}")
        views[index] = view
    return LightField(name, Path(folder), rows, cols, views)


def read_view(path):
    """One 8-bit RGB picture as uint8 [y, x, RGB]."""
    try:
        with Image.open(path) as image:
            if image.mode != "RGB":
                raise BenchError(f"{path} is {image.mode}; this bench takes 8-bit RGB views only")
            return np.asarray(image)
    except (UnidentifiedImageError, OSError) as error:
        raise BenchError(f"{path}: {error}") from error


def view_files(folder):
    """(rows, cols, files in row-major order), parsed from file names as `hmlfc encode` does."""
    files = sorted(path for path in Path(folder).iterdir() if path.suffix.lower() in SUFFIXES)
    if not files:
        raise BenchError(f"{folder} holds no PNG, PPM or JPEG views")
    cameras = [CAMERA_NAME.fullmatch(path.stem) for path in files]
    if all(cameras):
        side = math.isqrt(len(files))
        places = {divmod(int(match[1]), side): path for match, path in zip(cameras, files)}
    else:
        places = {_grid_position(path): path for path in files}
    rows = 1 + max(row for row, _ in places)
    cols = 1 + max(col for _, col in places)
    if len(places) != len(files) or len(files) != rows * cols:
        raise BenchError(f"{folder}: {len(files)} views do not fill {rows}x{cols} places once each")
    return rows, cols, [places[place] for place in sorted(places)]


def _grid_position(path):
    for pattern in GRID_NAMES:
        match = pattern.fullmatch(path.stem)
        if match:
            return int(match[1]), int(match[2])
    raise BenchError(f"{path}: the name has no row and column (RR_CC, out_RR_CC_Y_X, input_CamN)")


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
