"""Frame records: the integers that a camera becomes (section 2 of docs/rendering.md).

A record is a dict {field: integer} with the fields in the order of REC-2.
"""

from math import floor

from camera import FILTERS, axes_of, complete, demand
from integers import clamp, signed

VECTORS = ("n0_hi", "n0_lo", "na_hi", "na_lo", "nb_hi", "nb_lo")
FIELDS = (
    "frame_width", "frame_height", "filter", "aperture",
    *(f"{vector}.{axis}" for vector in VECTORS for axis in "xyz"),
    "u0", "v0", "zu", "zv", "x0", "y0", "gain", "dx", "dy", "c0", "r0", "cols", "rows", "width", "height",
    "geometry", "focus", "pitch", "fine",
)  # fmt: skip


def record_of_words(words):
    """The record of 32-bit integers in the order of REC-2, with a sign or in two's complement."""
    return {field: signed(word % 2**32, 32) for field, word in zip(FIELDS, words, strict=True)}


def record_of(camera, header):
    """The record of a Camera for the views of a stream; CameraError names the input at fault (CAM, REC-3)."""
    camera = complete(camera, header)
    axes = axes_of(camera)
    record = {
        "frame_width": camera.frame_width,
        "frame_height": camera.frame_height,
        "filter": FILTERS.index(camera.filter),
        "aperture": camera.aperture,
        **vectors_of(camera, axes),
        **places_of(camera, header),
        "cols": header.cols,
        "rows": header.rows,
        "width": header.width,
        "height": header.height,
        "geometry": int(camera.geometry == "stream" and camera.aperture == 0),
        "focus": fix(camera.focus, 8),
        "pitch": fix(camera.row_pitch, 8),
        "fine": floor(2**8 / max(1, abs(camera.row_pitch))) if has_pixels_of_views(camera, axes, header) else 0,
    }
    demand(abs(record["gain"]) <= 2**28, "position")
    demand(abs(record["x0"]) <= 2**28 and abs(record["y0"]) <= 2**28, "position")
    demand(abs(record["dx"]) * (header.cols - 1) <= 2**29, "focus")
    demand(abs(record["dy"]) * (header.rows - 1) <= 2**29, "focus")
    return {field: record[field] for field in FIELDS}


def fix(x, k):
    """REC-1."""
    return floor(x * 2.0**k + 0.5)


def vectors_of(camera, axes):
    """The fields n0, na and nb, in halves of 28 and 12 bits behind the point (REC-2)."""
    step = camera.tan_half / max(camera.frame_width, camera.frame_height)
    fields = {}
    for vector, values in (
        ("n0", axes.forward),
        ("na", [value * step for value in axes.right]),
        ("nb", [value * step for value in axes.down]),
    ):
        for axis, value in zip("xyz", values):
            high, low = divmod(fix(value, 40), 4096)
            fields[f"{vector}_hi.{axis}"], fields[f"{vector}_lo.{axis}"] = high, low
    return fields


def places_of(camera, header):
    """The fields from u0 to r0 (REC-2)."""
    (pu, pv, pz), pitch, shear = camera.position, camera.row_pitch, camera.shear
    kappa = shear - camera.focus
    c0 = clamp(floor(pu + 0.5), 0, header.cols - 1)
    r0 = clamp(floor(pv + 0.5), 0, header.rows - 1)
    x0 = (((header.width - 1) / 2) + kappa * (pu - c0)) + shear * (c0 - (header.cols - 1) / 2)
    y0 = (((header.height - 1) / 2) + (pitch * kappa) * (pv - r0)) + (pitch * shear) * (r0 - (header.rows - 1) / 2)
    return {
        "u0": fix(pu, 16), "v0": fix(pv, 16), "zu": fix(pz, 16), "zv": fix(pz / pitch, 16),
        "x0": fix(x0, 12), "y0": fix(y0, 12), "gain": fix(camera.focal - kappa * pz, 12),
        "dx": fix(camera.focus, 12), "dy": fix(pitch * camera.focus, 12), "c0": c0, "r0": r0,
    }  # fmt: skip


def has_pixels_of_views(camera, axes, header):
    """Whether a frame has the pixels of views at disparity 0 (REC-2)."""
    longer = max(camera.frame_width, camera.frame_height)
    even = (camera.frame_width - header.width) % 2 == 0 and (camera.frame_height - header.height) % 2 == 0
    same = fix(2 * camera.focal * camera.tan_half, 12) == longer * 2**12
    return axes.forward[2] == 1 and camera.shear == 0 and same and even
