"""The rig of a stream, for its readers (RIG-2 to RIG-4)."""

import json
import math


class RigError(Exception):
    """The section holds no rig."""


def demand(condition, what):
    if not condition:
        raise RigError(what)


def rig_section(header, data):
    """The bytes of section RIG of an opened stream, which has one (RIG-1)."""
    _, _, offset, size = header.sections[0]
    return data[offset : offset + size]


def read_rig(section, rows, cols):
    """{member: value}: arrays of 1 are repeated for each view, members that are missing get their meaning or None."""
    demand(len(section) <= 2**24, "too long")
    views = rows * cols
    rig = parse(section)
    demand(isinstance(rig, dict), "no object")
    demand(rig.keys() <= {"schema", "metres_per_unit", "positions", "rotations", "intrinsics"}, "an unknown member")
    demand({"schema", "positions"} <= rig.keys(), "schema or positions missing")
    demand(is_number(rig["schema"]) and rig["schema"] == 1, "another schema")
    unit = rig.get("metres_per_unit")
    if "metres_per_unit" in rig:
        demand(is_number(unit) and 2**-40 <= unit <= 2**40, "metres_per_unit")
    positions = vectors(rig, "positions", (views,), 3)
    demand(all(abs(x) <= 2**20 for position in positions for x in position), "a position out of range")
    rotations = vectors(rig, "rotations", (1, views), 4) or [[1, 0, 0, 0]]
    for w, x, y, z in rotations:
        demand(1 - 2**-10 <= w * w + x * x + y * y + z * z <= 1 + 2**-10, "a rotation of another length")
    intrinsics = vectors(rig, "intrinsics", (1, views), 4)
    for fx, fy, cx, cy in intrinsics or []:
        demand(all(2**-4 <= f <= 2**20 for f in (fx, fy)), "a focal length out of range")
        demand(all(abs(c) <= 2**20 for c in (cx, cy)), "a centre out of range")
    return {
        "metres_per_unit": unit,
        "positions": positions,
        "rotations": for_each_view(rotations, views),
        "intrinsics": for_each_view(intrinsics, views),
    }


def parse(section):
    """The JSON text of the section: strict UTF-8, no byte order mark, no member twice, no NaN or Infinity."""
    try:
        text = section.decode("utf-8")
    except UnicodeDecodeError as error:
        raise RigError("no UTF-8") from error
    demand(not text.startswith("\ufeff"), "a byte order mark")

    def members(pairs):
        demand(len({name for name, _ in pairs}) == len(pairs), "a member twice")
        return dict(pairs)

    def no_number(name):
        raise RigError(name)

    try:
        return json.loads(text, object_pairs_hook=members, parse_constant=no_number, parse_int=float)
    except (ValueError, RecursionError) as error:
        raise RigError("no JSON text") from error


def is_number(value):
    return isinstance(value, float) and math.isfinite(value)


def vectors(rig, member, counts, length):
    """The member's arrays of `length` numbers, as many as one of `counts`; None without the member."""
    if member not in rig:
        return None
    value = rig[member]
    demand(isinstance(value, list) and len(value) in counts, f"{member}: a wrong number of entries")
    for entry in value:
        demand(isinstance(entry, list) and len(entry) == length, f"{member}: an entry of another length")
        demand(all(map(is_number, entry)), f"{member}: no number")
    return value


def for_each_view(entries, views):
    return entries * views if entries is not None and len(entries) == 1 else entries
