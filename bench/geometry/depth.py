"""Disparity maps in PFM files, and how far they are off."""

import numpy as np

from process import BenchError

BORDER = 15
TOLERANCE = 0.07


def read_pfm(path):
    """The numbers of a grey PFM as [y, x], the first row on top."""
    content = path.read_bytes()
    try:
        kind, sides, scale, numbers = content.split(b"\n", 3)
        width, height = map(int, sides.split())
        if kind != b"Pf":
            raise ValueError("it is not grey")
        order = "<f4" if float(scale) < 0 else ">f4"
        rows = np.frombuffer(numbers, order, width * height).reshape(height, width)
    except ValueError as error:
        raise BenchError(f"{path} is no PFM file: {error}") from error
    return rows[::-1].astype(np.float64)


def measures(found, truth):
    """{bad: percent of pixels off by more than TOLERANCE, mse: 100 times the mean squared error}, both
    without BORDER pixels on each side."""
    if found.shape != truth.shape:
        raise BenchError(f"a map is {found.shape}, the truth {truth.shape}")
    inner = slice(BORDER, -BORDER)
    off = np.abs(found - truth)[inner, inner]
    return {"bad": 100 * float(np.mean(off > TOLERANCE)), "mse": 100 * float(np.mean(off * off))}
