"""The light fields that benchmarks measure: folders of 8-bit RGB views, PSNR and rates."""

import math
import os
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from process import BUILD, ROOT, BenchError, hmlfc


@dataclass
class Source:
    """A light field on disk. at: PSNR in dB to compare at; chroma: of profile main."""

    name: str
    folder: Path
    at: float = 38.0
    chroma: str = "444"


REAL = (
    Source("chess", Path("stanford-chess-16x16-700x400"), 39.0, "420"),
    Source("antinous", Path("hci-antinous-9x9-512x512"), 39.5, "420"),
    Source("knights", Path("stanford-legoknights-17x17-256x256-jpeg"), 36.5),
    Source("toylf", Path("toylf-16x16-320x240"), 36.0),
)


def real_sources(skip):
    """Those of REAL whose folders exist; calls skip(text) for the others."""
    data = Path(os.environ.get("HMLFC_DATA_DIR") or ROOT.parent / "shared" / "data")
    for source in REAL:
        if (data / source.folder).is_dir():
            yield replace(source, folder=data / source.folder)
        else:
            skip(f"skipped: {source.name}: no folder {source.folder} (HMLFC_DATA_DIR names where it is)")


def scene(work, name, grid, size, *options):
    """The folder of the views of a built-in scene, rendered into the folder `work` unless it is there. grid, size:
    such as "9x9" views of "96x64" pixels; options: of `hmlfc synth`."""
    folder = work / "-".join([name, grid, size, *(str(option) for option in options if "/" not in str(option))])
    if not folder.exists():
        hmlfc("synth", "--scene", name, "--grid", grid, "--size", size, "-o", folder, *options)
    return folder


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

    @property
    def grid(self):
        """The views as [row, col, y, x, RGB]."""
        return self.views.reshape(self.rows, self.cols, *self.views.shape[1:])

    def serpentine(self):
        """View numbers in video order: each second row backwards, so that neighbours follow."""
        grid = np.arange(self.rows * self.cols).reshape(self.rows, self.cols)
        grid[1::2] = grid[1::2, ::-1].copy()
        return [int(view) for view in grid.ravel()]

    def psnr(self, squared_error):
        """PSNR in dB of a sum of squared errors over all views and the three channels."""
        return psnr_of_mse(squared_error / (3 * self.pixels))


def package():
    """The package for Python of the build."""
    sys.path.append(str(BUILD / "tools" / "python"))
    import hmlfc as module

    return module


def load(name, folder):
    """The LightField of a folder, whose file names give the positions of its views."""
    try:
        views = package().read_views(folder)
    except OSError as error:
        raise BenchError(str(error)) from error
    if views.depth != 8:
        raise BenchError(f"{folder}: {views.depth} bits a sample; this bench takes 8")
    rows, cols, *shape = views.pixels.shape
    return LightField(name, Path(folder), rows, cols, views.pixels.reshape(rows * cols, *shape))


def open_stream(path):
    """The decoder of a stream: [row, col] gives a view as uint8 [y, x, RGB]."""
    return package().open(str(path))


def squared_error(view, decoded):
    """Sum over all samples of the squared differences of uint8 pictures of one shape."""
    if view.shape != decoded.shape:
        raise BenchError(f"a decoded view is {decoded.shape}, the source {view.shape}")
    difference = view.astype(np.int32) - decoded
    return int(np.sum(difference * difference, dtype=np.int64))


def psnr_of_mse(mse):
    """dB of a mean squared error of 8-bit samples."""
    return math.inf if mse <= 0 else 10 * math.log10(255**2 / mse)


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
