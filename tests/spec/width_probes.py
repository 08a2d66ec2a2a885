"""Every row of both width tables is watched where the model computes it, by its name:
watch("QUANTITY", ...) in the decode path for section 11 of the specification, in the renderers for
section 6 of docs/rendering.md. No watch there names anything else."""

import re

import widths
from specification import RENDERING, SPECIFICATION, read, table_after

# Each table: its document, its heading, the folders of the model that compute its quantities.
TABLES = [
    (SPECIFICATION, widths.HEADING, ("arithmetic", "syntax", "decoder")),
    (RENDERING, widths.FRAME_HEADING, ("render",)),
]
WATCH = re.compile(r'\bwatch\(\s*"([^"]*)"')


def watched(root, folders):
    """{quantity: a file that watches it}."""
    found = {}
    for folder in folders:
        for path in sorted((root / "model" / folder).rglob("*.[ch]pp")):
            for quantity in WATCH.findall(path.read_text()):
                found.setdefault(quantity, path.relative_to(root).as_posix())
    return found


def violations(root):
    for document, heading, folders in TABLES:
        quantities = [row[0] for row in table_after(read(root, document), heading)[1:]]
        found = watched(root, folders)
        for quantity in quantities:
            if quantity not in found:
                yield f"width probes: nothing in model/{', '.join(folders)} watches {quantity}"
        for quantity, file in found.items():
            if quantity not in quantities:
                yield f"width probes: {file} watches {quantity}, which is no row of {document}"
