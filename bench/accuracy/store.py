"""Measured points on disk, so that an interrupted run resumes."""

import hashlib
import json
import os


def digest(*parts):
    """SHA-256 of JSON values, in hexadecimal."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def file_digest(*files):
    """SHA-256 of the bytes of files, shortened."""
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:16]


class Store:
    """Points by key in a file, which is replaced whole after each.

    A point's key covers the program, the light field and all parameters: the same key is the same
    measurement.
    """

    def __init__(self, path):
        self.path = path
        self.points = json.loads(path.read_bytes()) if path.exists() else {}

    def get(self, key):
        return self.points.get(key)

    def add(self, key, point):
        self.points[key] = point
        written = self.path.with_suffix(".part")
        written.write_text(json.dumps(self.points), encoding="utf-8")
        os.replace(written, self.path)
