"""Clauses in the sources: each one that is cited exists; each one that a decoder follows is cited."""

from specification import RENDERING, SPECIFICATION, cited_clauses, defined_clauses, read

SUFFIXES = {".cpp", ".hpp", ".py", ".md", ".glsl", ".comp"}

# Where clauses are cited.
CITING = ["model", "tools", "gpu_ref", "testbench", "docs", "README.md"]

# The decoder and its API.
DECODER = ["model/bits", "model/arithmetic", "model/syntax", "model/decoder", "model/include"]

# The normative documents, each with the code that follows its clauses.
FOLLOWERS = {SPECIFICATION: DECODER, RENDERING: ["model/render", "model/include"]}


def files_below(root, places):
    for place in places:
        path = root / place
        if path.is_file():
            yield path
        elif path.is_dir():
            yield from sorted(p for p in path.rglob("*") if p.suffix in SUFFIXES and p.is_file())


def violations(root):
    clauses = {document: defined_clauses(read(root, document)) for document in FOLLOWERS}
    defined = [clause for found in clauses.values() for clause in found]
    for document, found in clauses.items():
        for clause in sorted(set(found)):
            if defined.count(clause) > 1:
                yield f"{document}: {clause} is defined {defined.count(clause)} times"
    for path in files_below(root, CITING):
        for clause in sorted(cited_clauses(path.read_text()) - set(defined)):
            yield f"{path.relative_to(root)}: cites {clause}, which the specification does not have"
    for document, places in FOLLOWERS.items():
        followed = set()
        for path in files_below(root, places):
            followed |= cited_clauses(path.read_text())
        for clause in clauses[document]:
            if clause not in followed:
                yield f"{document}: {clause} is cited nowhere in the code that follows it"
