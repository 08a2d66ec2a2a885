"""Indices of a light field."""

from __future__ import annotations

from operator import index as as_integer
from typing import Any, Tuple, Union

Index = Union[int, slice, "ellipsis"]  # noqa: F821
Key = Union[Index, Tuple[Index, ...]]

AXES = "row", "column", "row of pixels", "column of pixels", "channel"


def all_axes(key: Any, axes: int) -> tuple:
    """The integers and slices of an index, one for each axis."""
    keys = key if isinstance(key, tuple) else (key,)
    open_at = [at for at, part in enumerate(keys) if part is ...] or [len(keys)]
    before, after = keys[: open_at[0]], keys[open_at[0] + 1 :]
    missing = axes - len(before) - len(after)
    if len(open_at) > 1 or missing < 0:
        raise IndexError(f"a light field takes up to {axes} indices and one ...: {', '.join(AXES)}")
    keys = (*before, *(slice(None),) * missing, *after)
    for part in keys:
        if not is_index(part):
            raise TypeError(f"an index is an integer, a slice or ..., not {type(part).__name__}; np.asarray(lf) takes others")
    return keys


def is_index(part: Any) -> bool:
    """Whether it is an integer or a slice; an array of several integers is neither."""
    try:
        return isinstance(part, slice) or (not isinstance(part, bool) and as_integer(part) is not None)
    except TypeError:
        return False


def range_of(key: Any, size: int, axis: str) -> range:
    """The places from 0 to size - 1 that an index takes."""
    try:
        places = range(size)[key]
    except IndexError:
        raise IndexError(f"{axis} {key} does not exist: 0 to {size - 1}") from None
    return places if isinstance(places, range) else range(places, places + 1)
