"""The rig of a stream, for its readers (RIG-2 to RIG-4). The first part of its text that breaks a rule is refused."""

import json
import re

NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][-+]?[0-9]+)?")
NAME = re.compile(r'"(?:[^"\\\x00-\x1f]|\\.){0,90}"')  # the longest of a member has 15 characters, of 6 each as \u0061
BLANKS = re.compile(r"[ \t\n\r]*")
MEMBERS = ("schema", "metres_per_unit", "positions", "rotations", "intrinsics")


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
    text = JsonText(section)
    rig = {}
    text.take("{", "no object")
    for _ in text.parts("}"):
        name = text.name()
        demand(name in MEMBERS, "an unknown member")
        demand(name not in rig, "a member twice")
        text.take(":", "no JSON text")
        rig[name] = read_member(text, name, views)
    demand(text.next() == "", "no JSON text")
    demand({"schema", "positions"} <= rig.keys(), "schema or positions missing")
    return {
        "metres_per_unit": rig.get("metres_per_unit"),
        "positions": rig["positions"],
        "rotations": for_each_view(rig.get("rotations", [[1, 0, 0, 0]]), views),
        "intrinsics": for_each_view(rig.get("intrinsics"), views),
    }


class JsonText:
    """Reads a JSON text from front to end: strict UTF-8 without a byte order mark."""

    def __init__(self, section):
        try:
            self.text = section.decode("utf-8")
        except UnicodeDecodeError as error:
            raise RigError("no UTF-8") from error
        demand(not self.text.startswith("\ufeff"), "a byte order mark")
        self.at = 0

    def next(self):
        """The next character that is no blank, which stays; "" at the end."""
        self.at = BLANKS.match(self.text, self.at).end()
        return self.text[self.at : self.at + 1]

    def take(self, characters, otherwise):
        """The next character, which must be one of `characters`."""
        found = self.next()
        demand(found, "no JSON text")
        demand(found in characters, otherwise)
        self.at += 1
        return found

    def parts(self, close):
        """Stops before each part of an array or object, up to `close`."""
        if self.next() == close:
            self.at += 1
            return
        yield
        while self.take("," + close, "no JSON text") == ",":
            yield

    def name(self):
        self.next()
        found = NAME.match(self.text, self.at)
        demand(found, "no JSON text")
        self.at = found.end()
        try:
            return json.loads(found.group())
        except ValueError as error:
            raise RigError("no JSON text") from error

    def number(self, member):
        self.next()
        found = NUMBER.match(self.text, self.at)
        demand(found, f"{member}: no number")
        demand(found.end() - self.at <= 2**11, "a number too long")
        self.at = found.end()
        return float(found.group())


def read_member(text, name, views):
    if name == "schema":
        demand(text.number(name) == 1, "another schema")
        return 1
    if name == "metres_per_unit":
        unit = text.number(name)
        demand(2**-40 <= unit <= 2**40, name)
        return unit
    if name == "positions":
        return vectors(text, name, (views,), 3, check_position)
    return vectors(text, name, (1, views), 4, check_rotation if name == "rotations" else check_intrinsics)


def vectors(text, name, counts, length, check):
    """The member's arrays of `length` numbers, as many as one of `counts`, each with `check`(entry)."""
    found = []
    text.take("[", f"{name}: no array")
    for _ in text.parts("]"):
        demand(len(found) < max(counts), f"{name}: a wrong number of entries")
        entry = []
        text.take("[", f"{name}: an entry that is no array")
        for _ in text.parts("]"):
            demand(len(entry) < length, f"{name}: an entry of another length")
            entry.append(text.number(name))
        demand(len(entry) == length, f"{name}: an entry of another length")
        check(*entry)
        found.append(entry)
    demand(len(found) in counts, f"{name}: a wrong number of entries")
    return found


def check_position(*place):
    demand(all(abs(x) <= 2**20 for x in place), "a position out of range")


def check_rotation(w, x, y, z):
    demand(1 - 2**-10 <= w * w + x * x + y * y + z * z <= 1 + 2**-10, "a rotation of another length")


def check_intrinsics(fx, fy, cx, cy):
    demand(all(2**-4 <= f <= 2**20 for f in (fx, fy)), "a focal length out of range")
    demand(all(abs(c) <= 2**20 for c in (cx, cy)), "a centre out of range")


def for_each_view(entries, views):
    return entries * views if entries is not None and len(entries) == 1 else entries
