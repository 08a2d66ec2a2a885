#!/usr/bin/env python3
"""Names each error of annex A that no vector expects."""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "spec"))
from specification import read, table_after  # noqa: E402  (the folder is known only now)

# Errors that no stream has by itself, with the reason.
WITHOUT_STREAM = {
    "ok": "every vector that decodes",
    "limit_exceeded": "depends on a decoder's own limits; vectors are chosen by level (LVL-2)",
    "bad_request": "what a caller asks for, not a stream",
    "out_of_memory": "the decoder's machine, not a stream",
    "bus_error": "the decoder's memory, not a stream",
}


def complaints(text, manifest):
    """One line for each error without a vector, and each exemption of what is no error."""
    expected = {vector["expect"].get("error") for vector in manifest["vectors"]}
    names = [row[1] for row in table_after(text, "## Annex A: errors")[1:]]
    for name in names:
        if name not in expected and name not in WITHOUT_STREAM:
            yield f"{name}: no vector expects this error"
    for name in sorted(set(WITHOUT_STREAM) - set(names)):
        yield f"{name}: exempt, but annex A does not have it"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=Path, help="the repository")
    root = parser.parse_args().root
    manifest = json.loads((root / "vectors/manifest.json").read_text())
    found = list(complaints(read(root), manifest))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
