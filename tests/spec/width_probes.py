"""Every row of both width tables is watched where the model computes it, by its name:
watch("QUANTITY", ...) in the decode path for section 11 of the specification, in the renderers for
section 6 of docs/rendering.md; and no watch there names anything else."""

import re

import frame_widths
import widths
from specification import RENDERING, SPECIFICATION, read, table_after

# Each table: its document, its heading, the folders of the model that compute its quantities.
TABLES = [
    (SPECIFICATION, widths.HEADING, ("values", "fields", "samples")),
    (RENDERING, frame_widths.HEADING, ("render",)),
]
WATCH = re.compile(r'\bwatch\(\s*"([^"]*)"')


def watched(root, folders):
    """Quantity to the files that watch it."""
    found = {}
    for folder in folders:
        for path in sorted((root / "model" / folder).glob("*.[ch]pp")):
            for quantity in WATCH.findall(path.read_text()):
                found.setdefault(quantity, []).append(path.relative_to(root).as_posix())
    return found


def table_violations(root, document, heading, folders):
    _, *rows = table_after(read(root, document), heading)
    quantities = [row[0] for row in rows]
    found = watched(root, folders)
    for quantity in quantities:
        if quantity not in found:
            yield f"width probes: nothing in model/{', '.join(folders)} watches {quantity}"
    for quantity, files in found.items():
        if quantity not in quantities:
            yield f"width probes: {files[0]} watches {quantity}, which is no row of {document}"


def violations(root):
    for table in TABLES:
        yield from table_violations(root, *table)
