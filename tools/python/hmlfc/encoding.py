"""From views to a stream."""

from __future__ import annotations

import json
import os
import warnings
from operator import index as as_integer
from typing import Any, Callable, NamedTuple, Optional, Tuple, Union

import numpy as np

from hmlfc import _core
from hmlfc.error import Note
from hmlfc.light_field import AnyPath, LightField, Rig, name_of


class Views(NamedTuple):
    """pixels: (rows, cols, height, width, 3), uint8 at depth 8, else uint16; depth: bits a sample, [8, 12]."""

    pixels: np.ndarray
    depth: int

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        return self.pixels.astype(dtype or self.pixels.dtype, copy=bool(copy))


def read_views(
    folder: AnyPath,
    *,
    grid: Optional[Tuple[int, int]] = None,
    names: Optional[str] = None,
    order: Optional[str] = None,
) -> Views:
    """The views in a folder of images, as `hmlfc encode` finds them.

    grid: rows and columns, where names do not tell
    names: where names say row and column, such as "{row}_{col}", as `hmlfc encode --names`
    order: in which a sequence goes through the grid: "raster", "serpentine", "columns" or "columns-serpentine"

    Warns with a Note of what reading changed or left out. Raises OSError that names the file that is missing or does
    not fit.
    """
    field = read_folder(folder, grid=grid, names=names, order=order)
    return Views(_core.field_pixels(field=field), _core.field_facts(field=field)[0])


def encode(
    views: Union[np.ndarray, Views, LightField, AnyPath],
    *,
    depth: Optional[int] = None,
    grid: Optional[Tuple[int, int]] = None,
    names: Optional[str] = None,
    order: Optional[str] = None,
    rig: Union[Rig, AnyPath, bool, None] = None,
    profile: str = "extended",
    quality: Optional[float] = None,
    lossless: bool = False,
    target_psnr: Optional[float] = None,
    target_bpp: Optional[float] = None,
    max_bytes: Optional[int] = None,
    preset: str = "medium",
    rate_distortion: bool = False,
    tree_height: Optional[int] = None,
    block_size: int = 4,
    window: Optional[int] = None,
    references: Optional[Tuple[int, int]] = None,
    chroma: Optional[str] = None,
    threads: int = 0,
    progress: Optional[Callable[[int, int], None]] = None,
) -> bytes:
    """A stream of `views`: the bytes that `hmlfc encode` writes, for any number of threads.

    views: array (rows, cols, height, width, 3) of uint8, or of uint16 with `depth`; or a folder of images
    depth: bits a sample, [8, 12]
    grid, names, order: of a folder, as for read_views()
    rig: where the cameras stand: a Rig, or a file as for `hmlfc encode --rig`, which knows the views of an array as
        00_00.png and so on; None: what files and names in the folder of `views` say; False: nothing
    profile: "main" or "extended"
    quality: [0, 132], from 16 less on for each bit above 8; default: 60
    lossless: keep every sample
    target_psnr: instead of quality the lowest that reaches this PSNR, [1, 100] dB
    target_bpp: instead of quality the highest that takes no more bits a pixel of all views
    max_bytes: instead of quality the highest that takes no more bytes
    preset: of profile extended, "fast", "medium" or "slow"
    rate_distortion: of profile main, decides by squared error and bits
    tree_height: [0, 15]; default: main 3, extended 0
    block_size: 2, 4 or 8
    window: largest component of a vector, [0, 127] samples; default: main 16, extended 64
    references: rows and columns of views that share a reference, [1, 255]; default: main 8, 8, extended by trial
    chroma: "420" or "444"; default: what costs less
    threads: [0, 1024]; 0: all cores
    progress: called with images done and their number; what it raises ends the encoding

    Warns with a Note where a target is missed, and as read_views(). Raises ValueError or TypeError that says which
    argument is wrong.
    """
    goals = {
        "lossless": lossless or None, "quality": quality, "target_psnr": target_psnr, "target_bpp": target_bpp,
        "max_bytes": max_bytes,
    }  # fmt: skip
    first, *others = [name for name, goal in goals.items() if goal is not None] or ["quality"]
    if others:
        raise ValueError(f"{first} and {others[0]} exclude each other")
    if lossless and chroma == "420":
        raise ValueError("lossless needs chroma '444'")
    if rate_distortion and (profile != "main" or lossless):
        raise ValueError("rate_distortion is of profile 'main' with loss")
    if rig and profile == "main":
        raise ValueError("a rig needs profile 'extended'")
    is_folder = isinstance(views, (str, bytes, os.PathLike))
    if not is_folder and (grid, names, order) != (None, None, None):
        raise ValueError("grid, names and order are of a folder; an array has its rows and columns")
    field = read_folder(views, grid=grid, names=names, order=order) if is_folder else field_of(views, depth)
    found, _ = _core.field_facts(field=field)
    if depth not in (None, found):
        raise ValueError(f"the views have depth {found}, not {depth}")
    is_file = isinstance(rig, (str, bytes, os.PathLike))
    if not is_file and not isinstance(rig, Rig) and rig not in (None, False):
        raise TypeError(f"rig is a Rig, a file, None or False, not {type(rig).__name__}")
    stream, psnr, most = _core.encode(
        field=field, rig_file=name_of(rig) if is_file else None, rig_text=text_of(rig) if isinstance(rig, Rig) else None,
        rig_of_views=is_folder and rig is None and profile == "extended", profile=profile,
        quality=60 if quality is None else quality, lossless=lossless, target_psnr=target_psnr, target_bpp=target_bpp,
        max_bytes=max_bytes, preset=preset, rate_distortion=rate_distortion, tree_height=tree_height, block_size=block_size, window=window,
        references=references, chroma=chroma, threads=threads, progress=progress,
    )  # fmt: skip
    if target_psnr is not None and psnr < target_psnr:
        warnings.warn(f"target_psnr {target_psnr} was not reached: the stream has {psnr:.2f} dB", Note, stacklevel=2)
    if most is not None and len(stream) > most:
        warnings.warn(f"{most} bytes were not enough: the stream has {len(stream)}", Note, stacklevel=2)
    return stream


def read_folder(folder: AnyPath, **naming: Any) -> _core.Field:
    """The views of a folder; for the functions above, whose callers are warned."""
    name = name_of(folder)
    os.stat(name)
    field = _core.folder_field(folder=name, **naming)
    for note in _core.field_facts(field=field)[1]:
        warnings.warn(note, Note, stacklevel=3)
    return field


def field_of(views: Union[np.ndarray, Views, LightField], depth: Optional[int]) -> _core.Field:
    """The views in an array of any layout and byte order, or in what NumPy makes an array of."""
    if depth is None:
        depth = getattr(views, "depth", None)
    if np.ma.is_masked(getattr(views, "pixels", views)):
        raise ValueError("views have masked samples, and a stream has none: fill them, as by views.filled(0)")
    pixels = np.asarray(views)
    kind = pixels.dtype.newbyteorder("=")
    if pixels.ndim != 5 or pixels.shape[4] != 3:
        raise ValueError(f"views are an array of shape (rows, cols, height, width, 3), not {pixels.shape}")
    if kind not in (np.uint8, np.uint16):
        raise TypeError(f"views are an array of uint8 or uint16, not {kind}: round and convert them first")
    if kind == np.uint16 and depth is None:
        raise ValueError("views of uint16 need depth, their bits a sample")
    depth = 8 if depth is None else as_integer(depth)
    if not 8 <= depth <= (8 if kind == np.uint8 else 12):
        raise ValueError("views of uint8 have depth 8" if kind == np.uint8 else "depth lies in [8, 12]")
    most = int(pixels.max(initial=0))
    if most >> depth:
        row, col = np.argwhere(pixels >= 1 << depth)[0][:2]
        raise ValueError(f"view {row},{col} has samples up to {most}, more than {depth} bits hold")
    return _core.array_field(pixels=np.ascontiguousarray(pixels, kind), depth=depth)


def text_of(rig: Rig) -> str:
    """The JSON text of a rig (RIG-2)."""
    lists = {"positions": (rig.positions, 3), "rotations": (rig.rotations, 4), "intrinsics": (rig.intrinsics, 4)}
    told = {
        name: np.asarray(values, np.float64).reshape(-1, numbers).tolist()
        for name, (values, numbers) in lists.items()
        if values is not None
    }
    unit = rig.metres_per_unit
    return json.dumps({"schema": 1, **({} if unit is None else {"metres_per_unit": float(unit)}), **told})
