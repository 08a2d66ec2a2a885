"""The points of one run of the accuracy report, and their files."""

import csv
import json
import math
from dataclasses import asdict, dataclass

from coding import Coding


@dataclass
class Point:
    """What was measured. frame: the setting that frames of the stream were drawn with, or None for
    the encoding and decoding of the stream itself. values: numbers by name."""

    scene: str
    coding: Coding
    frame: str | None
    calibration_seconds: float
    values: dict

    @property
    def identity(self):
        return self.scene, self.coding, self.frame

    def number(self, name):
        return float(self.values[name])

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

    def found(self, scene, codings):
        """The points of these codings that were measured."""
        return [point for point in (self.get(scene, coding) for coding in codings) if point]

    def of_scene(self, scene, frames=False):
        """The points of encoding of a light field, or those of drawing frames of it."""
        return [
            point
            for point in self.points.values()
            if point.scene == scene and (point.frame is not None) == frames
        ]

    def pixels(self, scene):
        """Pixels of all views of a light field."""
        return math.prod(self.scenes[scene][name] for name in ("rows", "cols", "width", "height"))

    def fronts(self, scene):
        """{identity: (whether it is on the front of bits and error, whether on that of bits, error
        and CPU time of encoding)} of the points of a light field."""
        points = self.of_scene(scene)
        costs = [(p.number("bpp"), -p.number("psnr_rgb"), p.number("encode_cpu_seconds")) for p in points]
        marks = zip(on_front([cost[:2] for cost in costs]), on_front(costs))
        return dict(zip((point.identity for point in points), marks))

    def merge(self, other):
        """Takes the points of another run, which replace own points of the same identity."""
        self.machine = other.machine
        for name, facts in other.scenes.items():
            self.scenes.setdefault(name, {}).update(facts)
        self.points.update(other.points)


def on_front(costs):
    """For each tuple of costs (less is better): whether no other is at least as good in all of them
    and better in one."""
    return [
        not any(other != own and all(x <= y for x, y in zip(other, own)) for other in costs)
        for own in costs
    ]


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
    """One point a row. `front`: bits and error, then with CPU time of encoding."""
    marks = {}
    for scene in results.scenes:
        marks.update(results.fronts(scene))
    rows = []
    for point in results.points.values():
        row = {"scene": point.scene, **asdict(point.coding), "frame": point.frame or ""}
        if point.frame is None:
            row["front_rate"], row["front_time"] = map(int, marks[point.identity])
        rows.append({**row, **point.values, "calibration_seconds": point.calibration_seconds})
    names = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, names, restval="")
        writer.writeheader()
        writer.writerows(rows)


def _as_json(point):
    values = {"calibration_seconds": point.calibration_seconds, **point.values}
    frame = {"frame": point.frame} if point.frame else {}
    return {"scene": point.scene, "coding": point.coding.changes(), **frame,
            **{name: _rounded(value) for name, value in values.items()}}


def _rounded(value):
    """Numbers of at most seven digits."""
    finite = isinstance(value, float) and math.isfinite(value)
    return float(f"{value:.7g}") if finite else value


def _from_json(entry):
    coding = Coding(**entry.pop("coding"))
    head = [entry.pop(name, None) for name in ("scene", "frame", "calibration_seconds")]
    return Point(head[0], coding, *head[1:], values=entry)
