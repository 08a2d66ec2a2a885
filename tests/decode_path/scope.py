"""What belongs to the decode path: four layers, without what not_decoding.json names."""

import json
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
LAYERS = ("bits", "arithmetic", "syntax", "decoder")


def function_lines(text, begins):
    """The line numbers of the function whose first line begins with `begins`; it ends with the next
    line that is a brace at the same indentation, or with its first line."""
    lines = text.splitlines()
    matches = [i for i, line in enumerate(lines) if line.lstrip().startswith(begins)]
    if len(matches) != 1:
        raise SystemExit(f"{len(matches)} lines begin with {begins!r}; one is needed")
    first = matches[0]
    indent = lines[first][: len(lines[first]) - len(lines[first].lstrip())]
    if lines[first].rstrip().endswith("}"):
        return {first + 1}
    last = next(
        i for i in range(first + 1, len(lines)) if lines[i] in (indent + "}", indent + "};")
    )
    return set(range(first + 1, last + 2))


def not_decoding(model):
    """File to line numbers that do not count, or None for the whole file."""
    skipped = {}
    for entry in json.loads((FOLDER / "not_decoding.json").read_text()):
        name = entry["file"]
        if "begins" not in entry:
            skipped[name] = None
            continue
        lines = function_lines((model / name).read_text(), entry["begins"])
        skipped[name] = skipped.get(name, set()) | lines
    return skipped
