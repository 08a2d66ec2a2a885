#!/usr/bin/env python3
"""Names each clause of the specification that no vector exercises, and each vector that cites none."""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "spec"))
from specification import defined_clauses, read  # noqa: E402  (the folder is known only now)

# Clauses that state nothing a decoder could get wrong by themselves, with the reason.
EXEMPT = {
    "CNV-1": "notation of shifts and divisions; the clauses that use it have vectors",
    "CNV-3": "notation of integers; every stream uses it",
    "CNV-6": "notation of ranks; IDX-4 and TIL-7 use it",
    "COL-1": "the forward transform, for encoders",
}


def complaints(text, manifest):
    """One line for each clause without a vector and each citation of what is no clause."""
    defined = defined_clauses(text)
    cited = {clause for vector in manifest["vectors"] for clause in vector["clauses"]}
    for clause in defined:
        if clause not in cited and clause not in EXEMPT:
            yield f"{clause}: no vector exercises it"
        if clause in cited and clause in EXEMPT:
            yield f"{clause}: has vectors and needs no exemption"
    for vector in manifest["vectors"]:
        for clause in vector["clauses"]:
            if clause not in defined:
                yield f"{vector['id']}: cites {clause}, which the specification does not have"
    for clause in sorted(set(EXEMPT) - set(defined)):
        yield f"{clause}: exempt, but the specification does not have it"


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
