"""Clauses in the sources: each one cited exists, each one that a decoder follows is cited."""

from specification import SPECIFICATION, cited_clauses, defined_clauses, read

SUFFIXES = {".cpp", ".hpp", ".py", ".md"}

# Where clauses are cited.
CITING = ["model", "docs", "README.md"]

# The layers of the decoder and its API.
DECODER = ["model/bits", "model/values", "model/fields", "model/samples", "model/include"]

# Clauses that no line of a decoder can follow, with the reason.
EXEMPT = {
    "STR-1": "introduces the words grid, view and depth; FIL-1 has their fields and intervals",
}


def files_below(root, places):
    for place in places:
        path = root / place
        if path.is_file():
            yield path
        elif path.is_dir():
            yield from sorted(p for p in path.rglob("*") if p.suffix in SUFFIXES and p.is_file())


def violations(root):
    defined = defined_clauses(read(root))
    for clause in sorted(set(defined)):
        if defined.count(clause) > 1:
            yield f"{SPECIFICATION}: {clause} is defined {defined.count(clause)} times"
    for path in files_below(root, CITING):
        for clause in sorted(cited_clauses(path.read_text()) - set(defined)):
            yield f"{path.relative_to(root)}: cites {clause}, which the specification does not have"
    followed = set()
    for path in files_below(root, DECODER):
        followed |= cited_clauses(path.read_text())
    for clause in defined:
        if clause not in followed and clause not in EXEMPT:
            yield f"{SPECIFICATION}: {clause} is cited nowhere in the decoder"
    for clause in sorted(set(EXEMPT) - set(defined)):
        yield f"tests/spec/citations.py: exempts {clause}, which the specification does not have"
