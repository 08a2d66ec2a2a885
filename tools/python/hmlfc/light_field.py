"""A stream opened for reading."""

from __future__ import annotations

import json
import os
import warnings
from operator import index as as_integer
from typing import Any, Iterator, NamedTuple, Optional, Tuple, Union

import numpy as np

from hmlfc import _core
from hmlfc.error import Note
from hmlfc.indices import AXES, Key, all_axes, range_of

AnyPath = Union[str, bytes, os.PathLike]
Point = Tuple[float, float, float]


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
    rotations: (rows, cols, 4), quaternions w, x, y, z; None, for encode: none is rotated
    intrinsics: (rows, cols, 4), fx, fy, cx, cy in pixels (RIG-4), or None
    """

    metres_per_unit: Optional[float]
    positions: np.ndarray
    rotations: Optional[np.ndarray] = None
    intrinsics: Optional[np.ndarray] = None


def open(source: Union[str, os.PathLike, bytes, bytearray, memoryview], *, check_sections: bool = True) -> LightField:
    """The light field in a file, at an http:// address, or in memory.

    source: a path, an address, or the bytes of a stream, which must not change while the light field is in use; of a
        path in bytes os.fsdecode() makes one
    check_sections: check the CRC of every section, which reads the whole file (FIL-6); not at an address

    Raises OSError where the file cannot be read, also later, Error where it is no stream (FIL-8).
    """
    return LightField(source, check_sections)


class LightField:
    """Views of a stream, decoded when they are asked for. Made by open().

    It is read like an array of `shape`: lf[3, 4] is a view, lf[3] a row of views, lf[..., ::2, ::2, :] every other
    pixel; it has a length and rows to iterate over, and np.asarray(lf) is all of it. An index is an integer, a slice
    or `...`; only blocks from the first to the last row and column of pixels that is asked for are decoded.

    It is a context manager. A pickle holds the path or the address, of a stream in memory the bytes. Several threads
    may use one light field; decoding does not hold Python's lock. Functions take `stop_level` s in [0, tree_height]:
    0 decodes the views, s > 0 shows the ancestor of level s in place of each view (DEC-1).

    Raises IndexError outside, Error for errors of the stream, ValueError once it is closed.
    """

    def __init__(self, source: Any, check_sections: bool = True) -> None:
        self._check_sections = check_sections
        if isinstance(source, (str, os.PathLike)):
            self._opened: Optional[_core.Stream] = _core.open_file(path=name_of(source), check_sections=check_sections)
            path = os.fsdecode(source)
            self._source: Any = path if self._fact("is_remote") else os.path.abspath(path)
        else:
            try:
                data = memoryview(source)
            except TypeError:
                raise TypeError(f"a stream is a path, an address or bytes, not {source!r}") from None
            if not data.c_contiguous or (data.ndim, data.itemsize) != (1, 1):
                raise TypeError("a stream in memory is one contiguous sequence of bytes")
            self._opened = _core.open_buffer(buffer=data, check_sections=check_sections)
            self._source = source

    def close(self) -> None:
        """Lets go of the file or the bytes; what runs in other threads ends first. May be called again."""
        self._opened = None
        if not isinstance(self._source, str):
            self._source = None

    def __enter__(self) -> LightField:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __reduce__(self) -> tuple:
        self._stream
        source = self._source if isinstance(self._source, str) else bytes(self._source)
        return LightField, (source, self._check_sections)

    def __repr__(self) -> str:
        name = repr(self._source) if isinstance(self._source, str) else "in memory"
        if self._opened is None:
            return f"<hmlfc.LightField {name}, closed>"
        return f"<hmlfc.LightField {name} of shape {self.shape}, depth {self.depth}, profile {self.profile}>"

    @property
    def _stream(self) -> _core.Stream:
        if self._opened is None:
            raise ValueError("the light field is closed")
        return self._opened

    def _fact(self, name: str) -> Any:
        return _core.facts(stream=self._stream)[name]

    @property
    def shape(self) -> Tuple[int, int, int, int, int]:
        """(rows, cols, height, width, 3): views, then pixels, then R, G, B."""
        return self._fact("shape")

    @property
    def dtype(self) -> np.dtype:
        """uint8 at depth 8, uint16 above."""
        return np.dtype(np.uint8 if self.depth == 8 else np.uint16)

    @property
    def ndim(self) -> int:
        """5, the axes of `shape`."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """Samples of all views."""
        return int(np.prod(self.shape, dtype=np.int64))

    @property
    def depth(self) -> int:
        """Bits a sample, [8, 12]."""
        return self._fact("depth")

    @property
    def block_size(self) -> int:
        """Samples a side of a block: 2, 4 or 8."""
        return self._fact("block_size")

    @property
    def tree_height(self) -> int:
        """Levels above the views, [0, 15]."""
        return self._fact("tree_height")

    @property
    def profile(self) -> str:
        """ "main" or "extended"."""
        return self._fact("profile")

    @property
    def features(self) -> list[str]:
        """The flags of profile extended that are set (EXT-1)."""
        return self._fact("features")

    @property
    def rig(self) -> Optional[Rig]:
        """Where the cameras stand; None where the stream does not say. Raises ValueError for one that RIG-2 forbids."""
        text = _core.rig(stream=self._stream)
        if text is None:
            return None
        told, grid = json.loads(text), self.shape[:2]
        intrinsics = told.get("intrinsics")
        return Rig(
            told.get("metres_per_unit"),
            by_view(told["positions"], grid),
            by_view(told.get("rotations") or [(1, 0, 0, 0)], grid),
            by_view(intrinsics, grid) if intrinsics else None,
        )

    def info(self) -> dict:
        """What the stream is and what its bytes are spent on: the object that `hmlfc info --json` prints."""
        return json.loads(_core.info(stream=self._stream))

    def __len__(self) -> int:
        return self.shape[0]

    def __iter__(self) -> Iterator[np.ndarray]:
        return (self[row] for row in range(len(self)))

    def __contains__(self, value: object) -> bool:
        return any(np.any(row == value) for row in self)

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        if copy is False:
            raise ValueError("a light field is decoded into a new array; copy=False cannot be kept")
        return self[...].astype(dtype or self.dtype, copy=False)

    def __getitem__(self, key: Key) -> np.ndarray:
        return self.read(key)

    def read(self, key: Key, *, stop_level: int = 0) -> np.ndarray:
        """What [key] gives, at a stop level."""
        keys = all_axes(key, self.ndim)
        if not isinstance(keys[0], slice) and not isinstance(keys[1], slice):
            keys = (*self._view(*keys[:2]), *keys[2:])
        places = [range_of(part, size, axis) for part, size, axis in zip(keys, self.shape, AXES)]
        rows, cols, ys, xs = places[:4]
        pixels = _core.pixels(stream=self._stream, rows=rows, cols=cols, ys=ys, xs=xs, stop_level=self._level(stop_level))
        dropped = tuple(slice(None) if isinstance(part, slice) else 0 for part in keys[:4])
        return pixels[(*dropped, keys[4])]

    def block(self, row: int, col: int, plane: str, bx: int, by: int, *, stop_level: int = 0) -> np.ndarray:
        """(B, B) int32 samples of block (bx, by), column and row of blocks in the plane "Y", "Co" or "Cg"."""
        return self._block(row, col, plane, bx, by, stop_level, False)

    def trace(self, row: int, col: int, plane: str, bx: int, by: int, *, stop_level: int = 0) -> Block:
        """The same with every field that is read and the values of every stage."""
        return Block(*self._block(row, col, plane, bx, by, stop_level, True))

    def disparity(self, row: int, col: int) -> Tuple[np.ndarray, np.ndarray]:
        """Where the stream says that things are in a view: (disparity, confidence), one value a block of plane Y.

        disparity: float64, pixels a column of views, exact; negative is nearer
        confidence: uint8 in [0, 3]; 0: the stream says nothing (GEO-6)
        """
        row, col = self._view(row, col)
        disparity, confidence = _core.disparity(stream=self._stream, row=row, col=col)
        return disparity / 256, confidence

    def disparity_map(self, row: int, col: int) -> np.ndarray:
        """The disparity of every pixel of a view, as `hmlfc disparity` writes it: (height, width), float32.

        Pixels a column of views, exact; negative is nearer; NaN where the stream says nothing.
        """
        disparity, confidence = self.disparity(row, col)
        blocks = np.where(confidence > 0, disparity, np.nan).astype(np.float32)
        height, width = self.shape[2:4]
        return blocks.repeat(self.block_size, 0).repeat(self.block_size, 1)[:height, :width]

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

        position: (x, y, z): column and row of views, counted from 0, and distance beyond them, in columns; default: the
            middle of the views
        look_at: a point in the same units; default: straight ahead
        width, height: of the frame, [1, 4096] pixels; default: those of a view
        focal, row_pitch, shear: of the views (CAM-2)
        tan_half: of half the field of view along the longer side, [2**-10, 2]
        focus: disparity of the focal plane, pixels a column, [-256, 256]; negative is nearer; math.inf: infinitely far
        aperture: log2 of the steps of views that are blended, [0, 3]
        filter: "nearest", "views" or "quadrilinear"
        geometry: "stream", "plane", or None: what suits the stream

        Raises ValueError for a camera that takes no frame (CAM-3). Warns with a Note of a black frame.
        """
        frame = _core.render(
            stream=self._stream, position=position, look_at=look_at, width=width, height=height, focal=focal, tan_half=tan_half,
            row_pitch=row_pitch, shear=shear, focus=focus, aperture=aperture, filter=filter, geometry=geometry,
            stop_level=self._level(stop_level),
        )  # fmt: skip
        if not frame.any():
            places = "columns 0 to {1} and rows 0 to {0}".format(*(side - 1 for side in self.shape[:2]))
            note = f"the frame is black: its rays may miss the views; move the camera towards {places}"
            warnings.warn(note, Note, stacklevel=2)
        return frame

    def _view(self, row: Any, col: Any) -> Tuple[int, int]:
        rows, cols = self.shape[:2]
        try:
            return range(rows)[as_integer(row)], range(cols)[as_integer(col)]
        except IndexError:
            places = f"rows 0 to {rows - 1}, columns 0 to {cols - 1}"
            raise IndexError(f"view {row},{col} does not exist: {places}") from None

    def _level(self, stop_level: int) -> int:
        if 0 <= as_integer(stop_level) <= self.tree_height:
            return stop_level
        raise ValueError(f"stop_level {stop_level} does not exist: 0 to {self.tree_height}, the tree_height")

    def _block(self, row: int, col: int, plane: str, bx: int, by: int, stop_level: int, traced: bool) -> Any:
        if as_integer(bx) < 0 or as_integer(by) < 0:
            raise IndexError(f"block {bx},{by} of plane {plane} does not exist")
        row, col = self._view(row, col)
        place = {"row": row, "col": col, "plane": plane, "bx": bx, "by": by}
        return _core.block(stream=self._stream, **place, stop_level=self._level(stop_level), traced=traced)


def name_of(path: AnyPath) -> bytes:
    """The bytes of a path or an address, which has no null byte."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError(f"embedded null byte in {path!r}")
    return name


def by_view(entries: list, grid: Tuple[int, int]) -> np.ndarray:
    """One entry for all views, or one for each in their order, as (rows, cols, numbers of an entry)."""
    values = np.array(entries, np.float64)
    return np.tile(values, (*grid, 1)) if len(entries) == 1 else values.reshape(*grid, -1)
