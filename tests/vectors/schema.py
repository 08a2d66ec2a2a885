#!/usr/bin/env python3
"""Checks manifest.json against manifest.schema.json; exit status 77 without python3-jsonschema."""

import argparse
import json
import sys
from pathlib import Path

try:
    import jsonschema
except ImportError:
    jsonschema = None

SKIPPED = 77


def complaints(manifest, schema):
    """What is wrong with the manifest, one line each."""
    jsonschema.Draft7Validator.check_schema(schema)
    for error in jsonschema.Draft7Validator(schema).iter_errors(manifest):
        place = "/".join(map(str, error.absolute_path))
        yield f"{place}: {error.message[:200]}"


def load(suite):
    """The manifest and its schema."""
    return [json.loads((suite / name).read_text()) for name in ("manifest.json", "manifest.schema.json")]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("suite", type=Path, help="the folder vectors/")
    suite = parser.parse_args().suite
    if jsonschema is None:
        print("skipped: python3-jsonschema is missing")
        return SKIPPED
    found = list(complaints(*load(suite)))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
