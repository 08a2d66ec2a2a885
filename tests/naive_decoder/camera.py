"""A virtual camera: its inputs, their defaults and intervals, and its axes (section 1 of docs/rendering.md)."""

from dataclasses import dataclass
from math import sqrt
from types import SimpleNamespace

FILTERS = ("nearest", "views", "quadrilinear")
GEOMETRIES = ("plane", "stream")
LEAST_LENGTH = 2**-20


class CameraError(Exception):
    """A camera that is not valid. `name` is the input at fault, such as "focal" (CAM-3, CAM-4, REC-3)."""

    def __init__(self, name):
        super().__init__(name)
        self.name = name


def demand(condition, name):
    """Raises the error of input `name` unless the condition holds."""
    if not condition:
        raise CameraError(name)


@dataclass(frozen=True)
class Camera:
    """The inputs of CAM-3. None stands for a default that depends on the stream or on other inputs.

    position is (pu, pv, pz), look_at (qu, qv, qz): column, row, distance.
    """

    frame_width: int = None
    frame_height: int = None
    focal: float = None
    shear: float = 0
    row_pitch: float = None
    position: tuple = None
    look_at: tuple = None
    tan_half: float = None
    focus: float = 0
    aperture: int = 0
    filter: str = "quadrilinear"
    geometry: str = "plane"
    stop_level: int = 0


def complete(camera, header):
    """The camera with all defaults filled in, checked in the order of CAM-3; CameraError names the first violation.

    Comparisons refuse what is not finite.
    """
    inputs = dict(vars(camera))

    def take(name, default, least, greatest):
        if inputs[name] is None:
            inputs[name] = default
        demand(least <= inputs[name] <= greatest, name)
        return inputs[name]

    frame_width = take("frame_width", header.width, 1, 4096)
    frame_height = take("frame_height", header.height, 1, 4096)
    focal = float(take("focal", max(header.width, header.height), 1, 65536))
    take("shear", 0, -256, 256)
    pitch = inputs["row_pitch"]
    if pitch is None:
        pitch = inputs["row_pitch"] = header.row_scale / 16 if header.row_scale != 0 else 1.0
    demand(1 / 16 <= abs(pitch) <= 127 / 16, "row_pitch")
    if inputs["position"] is None:
        inputs["position"] = (header.cols - 1) / 2, (header.rows - 1) / 2, 0.0
    pu, pv, pz = inputs["position"]
    demand(-4096 <= pu <= 8192 and -4096 <= pv <= 8192 and -4096 <= pz <= 4096, "position")
    demand(abs(pz / pitch) <= 4096, "position")
    if inputs["look_at"] is None:
        inputs["look_at"] = pu, pv, pz + 1
    demand(all(-(2**20) <= q <= 2**20 for q in inputs["look_at"]), "look_at")
    longer = max(frame_width, frame_height)
    fills = longer * min(header.width / frame_width, header.height / frame_height) / (2 * focal)
    take("tan_half", fills, 2**-10, 2)
    take("focus", 0, -256, 256)
    demand(inputs["aperture"] in (0, 1, 2, 3), "aperture")
    demand(inputs["filter"] in FILTERS, "filter")
    demand(inputs["geometry"] in GEOMETRIES, "geometry")
    take("stop_level", 0, 0, header.tree_height)
    return Camera(**inputs)


def axes_of(camera):
    """forward, right and down of a complete camera, each (x, y, z) (CAM-4)."""
    (pu, pv, pz), (qu, qv, qz), pitch = camera.position, camera.look_at, camera.row_pitch
    gx, gy, gz = qu - pu, pitch * qv - pitch * pv, qz - pz
    length = sqrt((gx * gx + gy * gy) + gz * gz)
    demand(length >= LEAST_LENGTH, "look_at")
    fx, fy, fz = gx / length, gy / length, gz / length
    h = sqrt(fx * fx + fz * fz)
    demand(h >= LEAST_LENGTH, "look_at")
    rx, rz = fz / h, -fx / h
    return SimpleNamespace(
        forward=(fx, fy, fz), right=(rx, 0.0, rz), down=(fy * rz, fz * rx - fx * rz, -(fy * rx))
    )
