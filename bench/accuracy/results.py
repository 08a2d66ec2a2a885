"""The points of one run of the accuracy report, and their files."""

import csv
import json
import math
from dataclasses import asdict, dataclass

import fronts
from coding import FIELDS, Coding


@dataclass
class Point:
    """What was measured. frame: the setting that frames of the stream were drawn with, or None for
    the encoding and decoding of the stream itself. values: by name, numbers or groups of them."""

    scene: str
    coding: Coding
    frame: str | None
    program: str
    calibration_seconds: float
    values: dict

    @property
    def identity(self):
        return self.scene, self.coding, self.frame

    def number(self, name):
        """A value by its name; that of a group after a point, as in sections.index."""
        value = self.values
        for part in name.split("."):
            value = value[part]
        return float(value)

    def label(self):
        return f"{self.scene}: {self.coding.label()}" + (f", {self.frame}" if self.frame else "")


class Results:
    """Points by identity, and the light fields that they are of.

    scenes: {name: {rows, cols, width, height, chroma, at, prediction}}, the last as prediction.py
    measures it, if it did; machine: what they were measured on.
    """

    def __init__(self, machine, scenes=None, points=()):
        self.machine, self.scenes = machine, dict(scenes or {})
        self.points = {point.identity: point for point in points}

    def add(self, point):
        self.points[point.identity] = point

    def get(self, scene, coding, frame=None):
        """A point or None."""
        return self.points.get((scene, coding, frame))

    def of_scene(self, scene, frames=False):
        """The points of encoding of a light field, or those of drawing frames of it."""
        return [
            point
            for point in self.points.values()
            if point.scene == scene and (point.frame is not None) == frames
        ]

    def fronts(self, scene):
        """{identity: (whether it is on the front of bits and error, whether on that of bits, error
        and CPU time of encoding)} of the points of a light field."""
        points = self.of_scene(scene)
        rate = fronts.on_front([(p.number("bpp"), -p.number("psnr_rgb")) for p in points])
        time = fronts.on_front(
            [(p.number("bpp"), -p.number("psnr_rgb"), p.number("encode_cpu_seconds")) for p in points]
        )
        return {point.identity: marks for point, *marks in zip(points, rate, time)}

    def merge(self, other):
        """Takes the points of another run in place of the own ones of the same identity."""
        self.machine = other.machine
        for name, facts in other.scenes.items():
            self.scenes.setdefault(name, {}).update(facts)
        self.points.update(other.points)


def write_json(results, path):
    """One point a line."""
    head = json.dumps({"machine": results.machine, "scenes": results.scenes}, indent=1)
    lines = [json.dumps(_as_json(point)) for point in results.points.values()]
    text = head[:-2] + ',\n "points": [\n' + ",\n".join(lines) + "\n ]\n}\n"
    path.write_text(text, encoding="utf-8")


def read_json(path):
    """The results of a file; empty where there is none."""
    if not path.exists():
        return Results(machine="")
    data = json.loads(path.read_text(encoding="utf-8"))
    return Results(data["machine"], data["scenes"], map(_from_json, data["points"]))


def write_csv(results, path):
    """One point a row; groups of values have columns of their own. `front`: bits and error, then
    with CPU time of encoding."""
    marks = {}
    for scene in results.scenes:
        marks.update(results.fronts(scene))
    rows = []
    for point in results.points.values():
        row = {"scene": point.scene, **asdict(point.coding), "frame": point.frame or ""}
        if point.frame is None:
            row["front_rate"], row["front_time"] = map(int, marks[point.identity])
        row.update(_flat(point.values))
        rows.append({**row, "calibration_seconds": point.calibration_seconds})
    names = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, names, restval="")
        writer.writeheader()
        writer.writerows(rows)


def _flat(values, prefix=""):
    flat = {}
    for name, value in values.items():
        if isinstance(value, dict):
            flat.update(_flat(value, f"{prefix}{name}."))
        else:
            flat[prefix + name] = value
    return flat


def _as_json(point):
    coding = {name: value for name, value in asdict(point.coding).items() if value is not None}
    return {
        "scene": point.scene,
        "coding": coding,
        **({"frame": point.frame} if point.frame else {}),
        "program": point.program,
        "calibration_seconds": _rounded(point.calibration_seconds),
        **_rounded(point.values),
    }


def _rounded(value):
    """Numbers of at most seven digits, in groups too."""
    if isinstance(value, dict):
        return {name: _rounded(part) for name, part in value.items()}
    if isinstance(value, float) and math.isfinite(value):
        return float(f"{value:.7g}")
    return value


def _from_json(entry):
    entry = dict(entry)
    coding = Coding(**{name: entry["coding"].get(name) for name in FIELDS})
    del entry["coding"]
    head = [entry.pop(name, None) for name in ("scene", "frame", "program", "calibration_seconds")]
    return Point(head[0], coding, *head[1:], values=entry)
