"""Measured points on disk, so that a run that was stopped goes on where it was."""

import hashlib
import json


def digest(*parts):
    """SHA-256 of JSON values, in hexadecimal."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def file_digest(*files):
    """SHA-256 of the bytes of files, shortened."""
    whole = hashlib.sha256()
    for file in files:
        whole.update(file.read_bytes())
    return whole.hexdigest()[:16]


class Store:
    """Points by key, one a line of a file that only grows.

    A point's key covers the program, the light field and all parameters: the same key is the same
    measurement.
    """

    def __init__(self, path):
        self.path = path
        self.points = {}
        whole = 0  # bytes of whole lines: a stopped run may have left a part of one
        if path.exists():
            for line in path.read_bytes().splitlines(keepends=True):
                if not line.endswith(b"\n"):
                    break
                entry = json.loads(line)
                self.points[entry["key"]] = entry["point"]
                whole += len(line)
            with open(path, "r+b") as file:
                file.truncate(whole)

    def get(self, key):
        return self.points.get(key)

    def add(self, key, point):
        self.points[key] = point
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps({"key": key, "point": point}) + "\n")
