"""From views to a stream."""

from __future__ import annotations

import os
from typing import Callable, NamedTuple, Optional, Tuple, Union

import numpy as np

from hmlfc import _core


class Views(NamedTuple):
    """pixels: (rows, cols, height, width, 3), uint8 at depth 8, else uint16; depth: bits a sample, [8, 12]."""

    pixels: np.ndarray
    depth: int


def read_views(folder: Union[str, os.PathLike], *, grid: Optional[Tuple[int, int]] = None) -> Views:
    """The views in a folder of images, as `hmlfc encode` finds them.

    grid: rows and columns, where names do not tell

    Raises OSError that names the file that is missing or does not fit.
    """
    return Views(*_core.read_views(os.fsdecode(folder), grid))


def encode(
    views: Union[np.ndarray, Views, str, os.PathLike],
    *,
    depth: Optional[int] = None,
    profile: str = "extended",
    quality: float = 60,
    lossless: bool = False,
    preset: str = "medium",
    target_psnr: Optional[float] = None,
    max_bytes: Optional[int] = None,
    tree_height: Optional[int] = None,
    block_size: int = 4,
    chroma: Optional[str] = None,
    threads: int = 0,
    progress: Optional[Callable[[int, int], None]] = None,
) -> bytes:
    """A stream of `views`: the bytes that `hmlfc encode` writes, for any number of threads.

    views: array (rows, cols, height, width, 3) of uint8, or of uint16 with `depth`; or a folder of images
    depth: bits a sample, [8, 12]
    profile: "main" or "extended"
    quality: of profile extended, [0, 100]
    lossless: keep every sample
    preset: of profile extended, "fast", "medium" or "slow"
    target_psnr: in place of quality the lowest that reaches this PSNR, [1, 100] dB
    max_bytes: in place of quality the highest that takes no more bytes
    tree_height: [0, 15]; default: main 3, extended 0
    block_size: 2, 4 or 8
    chroma: "420" or "444"; default: what costs less
    threads: 0: all cores
    progress: called with images done and their number; what it raises is raised when the work is done

    Raises ValueError or TypeError that says which argument is wrong.
    """
    if isinstance(views, (str, os.PathLike)):
        views = read_views(views)
    if isinstance(views, Views):
        views, depth = views.pixels, views.depth if depth is None else depth
    return _core.encode(
        np.asarray(views), depth, profile, quality, lossless, preset, target_psnr, max_bytes, tree_height, block_size,
        chroma, threads, progress,
    )  # fmt: skip
