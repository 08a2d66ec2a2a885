"""Reading the normative documents: their clauses and tables."""

import re
from pathlib import Path

SPECIFICATION = Path("docs/specification.md")
RENDERING = Path("docs/rendering.md")

DEFINITION = re.compile(r"^\*\*\[([A-Z]+-\d+)\]\*\*", re.MULTILINE)
CLAUSE = re.compile(r"\b[A-Z]{3,4}-\d+\b")
# Names of other standards that look like clauses.
NOT_CLAUSES = {"BSD-3", "SHA-256", "TLM-2", "UTF-8"}
CLAUSE_RANGE = re.compile(r"\b([A-Z]{3,4})-(\d+) to \1-(\d+)\b")


def read(root, document=SPECIFICATION):
    return (root / document).read_text()


def defined_clauses(text):
    """The clauses that the text defines, in its order; one for each definition."""
    return DEFINITION.findall(text)


def cited_clauses(text):
    """The clauses that a text names, those within "STR-2 to STR-6" included."""
    # A comment may break between "STR-2 to" and "STR-6".
    text = re.sub(r"\s*\n\s*(?://+|\*|#)?\s*", " ", text)
    cited = set(CLAUSE.findall(text)) - NOT_CLAUSES
    for family, first, last in CLAUSE_RANGE.findall(text):
        cited.update(f"{family}-{number}" for number in range(int(first), int(last) + 1))
    return cited


def table_after(text, heading):
    """The rows of the first table after a heading, each a list of cells; the head row is first."""
    rows = []
    for line in text[text.index(heading) :].splitlines():
        if line.startswith("|"):
            rows.append([cell.strip() for cell in line.strip("|").split("|")])
        elif rows:
            break
    return [rows[0], *rows[2:]]


def rows_after(text, heading):
    """The rows of the same table without its head, each as {column: cell}."""
    head, *rows = table_after(text, heading)
    return [dict(zip(head, row)) for row in rows]
