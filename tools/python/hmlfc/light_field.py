"""A stream opened for reading."""

from __future__ import annotations

import os
from operator import index as as_integer
from typing import NamedTuple, Optional, Tuple, Union

import numpy as np

from hmlfc import _core

Point = Tuple[float, float, float]
Index = Union[int, slice]


class Block(NamedTuple):
    """A block with what was read and computed for it.

    samples: (B, B), int32
    fields: dicts with level, image, plane, block, tile, section, byte, bit, bits, name, clause, value
    vectors: dicts with level, image, plane, block, reference, vector (x, y in samples), clause
    stages: dicts with level, image, plane, block, stage, clause, values (B, B)
    """

    samples: np.ndarray
    fields: list[dict]
    vectors: list[dict]
    stages: list[dict]


class Rig(NamedTuple):
    """Where the cameras of the views stand (RIG-2): arrays by row and column of views.

    metres_per_unit: length of a unit of positions, or None
    positions: (rows, cols, 3), x, y, z of each camera's centre in the world (RIG-3)
    rotations: (rows, cols, 4), quaternions w, x, y, z
    intrinsics: (rows, cols, 4), fx, fy, cx, cy in pixels (RIG-4), or None
    """

    metres_per_unit: Optional[float]
    positions: np.ndarray
    rotations: np.ndarray
    intrinsics: Optional[np.ndarray]


def open(source: Union[str, os.PathLike, bytes, bytearray, memoryview], *, check_sections: bool = True) -> LightField:
    """The light field in a file, which is mapped, at an http:// address, or in memory.

    source: a path, an address, or the bytes of a stream, which must not change while the light field is in use
    check_sections: check the CRC of every section, which reads the whole file (FIL-6); not at an address

    Raises OSError where the file cannot be read, also later at an address, Error where it is no stream (FIL-8).
    """
    if isinstance(source, (bytes, bytearray, memoryview)):
        return LightField(_core.Stream.from_buffer(source, check_sections))
    return LightField(_core.Stream.from_file(os.fsdecode(source), check_sections))


class LightField:
    """Views of a stream, decoded when they are asked for. Made by open().

    Several threads may use one light field; decoding does not hold Python's lock. Every function takes `stop_level`
    s in [0, tree_height]: 0 decodes the views, s > 0 shows the ancestor of level s in place of each view (DEC-1).
    Errors of the stream raise Error.
    """

    def __init__(self, stream: _core.Stream) -> None:
        self._stream = stream

    @property
    def shape(self) -> Tuple[int, int, int, int, int]:
        """(rows, cols, height, width, 3): views, then pixels, then R, G, B."""
        stream = self._stream
        return (stream.rows, stream.cols, stream.height, stream.width, 3)

    @property
    def dtype(self) -> np.dtype:
        """uint8 at depth 8, uint16 above."""
        return np.dtype(np.uint8 if self.depth == 8 else np.uint16)

    @property
    def depth(self) -> int:
        """Bits a sample, [8, 12]."""
        return self._stream.depth

    @property
    def block_size(self) -> int:
        """Samples a side of a block: 2, 4 or 8."""
        return self._stream.block_size

    @property
    def tree_height(self) -> int:
        """Levels above the views, [0, 15]."""
        return self._stream.tree_height

    @property
    def profile(self) -> str:
        """ "main" or "extended"."""
        return self._stream.profile

    @property
    def features(self) -> list[str]:
        """The flags of profile extended that are set (EXT-1)."""
        return self._stream.features

    @property
    def rig(self) -> Optional[Rig]:
        """Where the cameras stand; None where the stream does not say. Raises ValueError for a rig that RIG-2 forbids."""
        told = self._stream.rig()
        if told is None:
            return None
        grid = self.shape[:2]
        metres, positions, rotations, intrinsics = told
        return Rig(
            metres,
            by_view(positions, grid),
            by_view(rotations or [(1, 0, 0, 0)], grid),
            by_view(intrinsics, grid) if intrinsics else None,
        )

    def __repr__(self) -> str:
        return f"<hmlfc.LightField of shape {self.shape}, depth {self.depth}, profile {self.profile}>"

    def __getitem__(self, key: Union[Index, Tuple[Index, ...]]) -> np.ndarray:
        """lf[row, col], lf[row, col, ys] or lf[row, col, ys, xs]: pixels, as of an array of this shape.

        Each index is an integer or a slice. Only blocks with the rows and columns from the first to the last that
        is asked for are decoded. Raises IndexError outside.
        """
        return self.read(key)

    def read(self, key: Union[Index, Tuple[Index, ...]], *, stop_level: int = 0) -> np.ndarray:
        """What [key] gives, at a stop level."""
        keys = key if isinstance(key, tuple) else (key,)
        if not 2 <= len(keys) <= 4:
            raise IndexError("a light field takes 2 to 4 indices: row, col, rows of pixels, columns of pixels")
        keys = (*keys, *(slice(None),) * (4 - len(keys)))
        rows, cols, ys, xs = (range_of(part, size) for part, size in zip(keys, self.shape))
        if len(rows) == len(cols) == 1 and is_run(ys) and is_run(xs):
            part = self._stream.pixels(rows[0], cols[0], xs[0], ys[0], len(xs), len(ys), stop_level)
            return part[None, None][drop_integers(keys)]
        pixels = np.empty((len(rows), len(cols), len(ys), len(xs), 3), self.dtype)
        if pixels.size:
            top, left = min(ys), min(xs)
            height, width = max(ys) - top + 1, max(xs) - left + 1
            ys, xs = np.subtract(ys, top), np.subtract(xs, left)
            for i, row in enumerate(rows):
                for j, col in enumerate(cols):
                    part = self._stream.pixels(row, col, left, top, width, height, stop_level)
                    pixels[i, j] = part[np.ix_(ys, xs)]
        return pixels[drop_integers(keys)]

    def block(self, row: int, col: int, plane: str, bx: int, by: int, *, stop_level: int = 0) -> np.ndarray:
        """(B, B) int32 samples of block (bx, by), column and row of blocks in the plane "Y", "Co" or "Cg"."""
        return self._stream.block(*self._view(row, col), plane, bx, by, stop_level, False)

    def trace(self, row: int, col: int, plane: str, bx: int, by: int, *, stop_level: int = 0) -> Block:
        """The same with every field that is read and the values of every stage."""
        return Block(*self._stream.block(*self._view(row, col), plane, bx, by, stop_level, True))

    def disparity(self, row: int, col: int) -> Tuple[np.ndarray, np.ndarray]:
        """Where the stream says that things are in a view: (disparity, confidence), one value a block of plane Y.

        disparity: float64, pixels a column of views, exact; negative is nearer
        confidence: uint8 in [0, 3]; 0: the stream says nothing (GEO-6)
        """
        disparity, confidence = self._stream.disparity(*self._view(row, col))
        return disparity / 256, confidence

    def render(
        self,
        position: Optional[Point] = None,
        *,
        look_at: Optional[Point] = None,
        width: Optional[int] = None,
        height: Optional[int] = None,
        focal: Optional[float] = None,
        tan_half: Optional[float] = None,
        row_pitch: Optional[float] = None,
        shear: float = 0,
        focus: float = 0,
        aperture: int = 0,
        filter: str = "quadrilinear",
        geometry: Optional[str] = None,
        stop_level: int = 0,
    ) -> np.ndarray:
        """The frame of a virtual camera, (height, width, 3): the bytes that `hmlfc render` writes.

        position: (u, v, z), in columns and rows of views, z beyond them; default: the middle of the views
        look_at: a point in the same units; default: straight ahead
        width, height: of the frame, [1, 4096] pixels; default: those of a view
        focal, row_pitch, shear: of the views (CAM-2)
        tan_half: of half the field of view along the longer side, [2**-10, 2]
        focus: disparity of the focal plane, pixels a column, [-256, 256]; negative is nearer
        aperture: log2 of the steps of views that are blended, [0, 3]
        filter: "nearest", "bilinear" or "quadrilinear"
        geometry: "stream", "plane", or None: what suits the stream

        Raises ValueError for a camera that takes no frame (CAM-3).
        """
        return self._stream.render(
            position, look_at, width, height, focal, tan_half, row_pitch, shear, focus, aperture, filter, geometry,
            stop_level,
        )  # fmt: skip

    def _view(self, row: int, col: int) -> Tuple[int, int]:
        rows, cols = self.shape[:2]
        return range_of(row, rows)[0], range_of(col, cols)[0]


def by_view(entries: list, grid: Tuple[int, int]) -> np.ndarray:
    """One entry for all views, or one for each in their order, as (rows, cols, numbers of an entry)."""
    values = np.array(entries, np.float64)
    return np.tile(values, (*grid, 1)) if len(entries) == 1 else values.reshape(*grid, -1)


def range_of(key: Index, size: int) -> range:
    """The places from 0 to size - 1 that an index takes."""
    if isinstance(key, slice):
        return range(*key.indices(size))
    place = as_integer(key)
    if not -size <= place < size:
        raise IndexError(f"{place} is not in [{-size}, {size - 1}]")
    return range(place % size, place % size + 1)


def is_run(places: range) -> bool:
    """Whether these are neighbours in rising order, at least one."""
    return len(places) > 0 and (len(places) == 1 or places.step == 1)


def drop_integers(keys: Tuple[Index, ...]) -> Tuple[Index, ...]:
    """Indices that leave out each axis for which `keys` has an integer."""
    return tuple(slice(None) if isinstance(key, slice) else 0 for key in keys)
