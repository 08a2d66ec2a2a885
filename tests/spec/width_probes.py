"""Every row of the width table (section 11) is watched where the model computes it, by its name:
watch("QUANTITY", ...) in the decode path; and no watch names anything else."""

import re

from specification import read, table_after
from widths import HEADING

LAYERS = ("values", "fields", "samples")
WATCH = re.compile(r'\bwatch\(\s*"([^"]*)"')


def watched(root):
    """Quantity to the files that watch it."""
    found = {}
    for layer in LAYERS:
        for path in sorted((root / "model" / layer).glob("*.[ch]pp")):
            for quantity in WATCH.findall(path.read_text()):
                found.setdefault(quantity, []).append(path.relative_to(root).as_posix())
    return found


def violations(root):
    _, *rows = table_after(read(root), HEADING)
    quantities = [row[0] for row in rows]
    found = watched(root)
    for quantity in quantities:
        if quantity not in found:
            yield f"width probes: nothing in the model watches {quantity}"
    for quantity, files in found.items():
        if quantity not in quantities:
            yield f"width probes: {files[0]} watches {quantity}, which is no row of the width table"
