#!/usr/bin/env python3
"""The vectors syntax/key-pairs-* have every pair of values of two options of key images (KEY-2, EXT-6).

    key_pairs.py RECIPES

Exit status 1: a pair is missing.
"""

import itertools
import json
import sys
from pathlib import Path

STYLES = ("bypass", "reset", "terminate", "causal", "predictable", "segmentation")
VALUES = {
    **{style: (False, True) for style in STYLES},
    "layers": (1, 2, 5),
    "progression": ("LRCP", "RLCP", "RPCL", "PCRL", "CPRL"),
    "sop": (False, True),
    "eph": (False, True),
    "code_block": ((64, 64), (4, 4), (8, 32), (32, 4)),
    "decompositions": (0, 1, 2, 4),
    "precinct_log2": (0, 15),
    "lossy": (False, True),
}


def options(stream):
    """The value of each option in a recipe."""
    coding = dict(stream["key_coding"])
    found = {style: style in coding["style"] for style in STYLES}
    coding["code_block"] = tuple(coding["code_block"])
    return {**found, **{name: coding[name] for name in VALUES if name in coding}, "lossy": "key_error" in stream}


def missing_pairs(recipes):
    """Pairs of values of two options that no recipe has."""
    met = {pair for recipe in recipes for pair in itertools.combinations(sorted(options(recipe).items()), 2)}
    for (first, firsts), (second, seconds) in itertools.combinations(sorted(VALUES.items()), 2):
        for pair in itertools.product(firsts, seconds):
            if ((first, pair[0]), (second, pair[1])) not in met:
                yield f"{first} = {pair[0]} with {second} = {pair[1]}"


def main():
    vectors = json.loads(Path(sys.argv[1]).read_text())["vectors"]
    recipes = [vector["stream"] for vector in vectors if vector["name"].startswith("key-pairs-")]
    missing = list(missing_pairs(recipes))
    for pair in missing:
        print(pair)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
