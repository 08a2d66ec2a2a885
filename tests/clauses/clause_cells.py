"""Which vectors exercise a clause, and which file of each implementation follows it: the cells of the table."""

import json
from pathlib import Path

from implementations import FOLDERS, RENDERERS, citations
from specification import RENDERING, defined_clauses, read

REASONS = Path("tests/clauses/reasons.json")
VECTORS, FRAMES = "vectors", "frames"


class ClauseCells:
    """One table: `clauses` in the order of a document, with `kind` FRAMES those of rendering.md; the cells below.

    vectors(clause)        ids of the vectors that exercise it, the most specific first
    files(name, clause)    files of an implementation that cite it
    taken(name, clause)    its vectors that the implementation takes
    reason(column, clause) why the cell is empty, or None
    """

    def __init__(self, root, manifest, taken, kind=VECTORS):
        documents = [defined_clauses(read(root)), defined_clauses(read(root, RENDERING))]
        self.kind = kind
        self.clauses, self.others = documents if kind == VECTORS else documents[::-1]
        self.implementations = [*FOLDERS] if kind == VECTORS else RENDERERS
        self.columns = [kind, *self.implementations]
        self._all, self._taken = manifest[kind], taken
        self._files = {name: citations(root, name) for name in self.implementations}
        self.reasons = [
            entry for entry in json.loads((root / REASONS).read_text()) if not set(entry["clauses"]) & set(self.others)
        ]
        self._reason = {
            (column, clause): entry["reason"]
            for entry in self.reasons
            for column in entry["columns"]
            for clause in entry["clauses"]
        }

    def vectors(self, clause):
        found = [vector for vector in self._all if clause in vector["clauses"]]
        found.sort(key=lambda vector: (len(vector["clauses"]), vector["input"]["bytes"], vector["id"]))
        return [vector["id"] for vector in found]

    def files(self, name, clause):
        return self._files[name].get(clause, [])

    def taken(self, name, clause):
        return [vector for vector in self.vectors(clause) if vector in self._taken.get(name, ())]

    def reason(self, column, clause):
        return self._reason.get((column, clause))

    def complaints(self):
        """One line for each empty cell without a reason, each reason that fits none, each unknown clause."""
        for clause in self.clauses:
            for column in self.columns:
                lack, reason = self._lack(column, clause), self.reason(column, clause)
                if lack and not reason:
                    yield f"{clause}, {column}: {lack}"
                if reason and not lack:
                    yield f"{REASONS}: {clause}, {column} has a reason, but is not empty"
        yield from self._unknown_names()

    def _lack(self, column, clause):
        """Names what the cell lacks, or returns None."""
        if column == self.kind:
            return None if self.vectors(clause) else "no vector exercises it"
        if not self.files(column, clause):
            return "no file cites it"
        if self.vectors(clause) and not self.taken(column, clause):
            return f"takes none of its {len(self.vectors(clause))} vectors"
        return None

    def _unknown_names(self):
        seen = set()
        for entry in self.reasons:
            for column in entry["columns"]:
                if column not in self.columns:
                    yield f"{REASONS}: there is no column {column}"
                for clause in entry["clauses"]:
                    if clause not in self.clauses:
                        yield f"{REASONS}: the specification does not have {clause}"
                    if (column, clause) in seen:
                        yield f"{REASONS}: {clause}, {column} has two reasons"
                    seen.add((column, clause))
        for vector in self._all:
            for clause in vector["clauses"]:
                if clause not in self.clauses and (self.kind == VECTORS or clause not in self.others):
                    yield f"{vector['id']}: cites {clause}, which the specification does not have"
        for name, cited in self._files.items():
            for clause in sorted(cited.keys() - set(self.clauses) - set(self.others)):
                yield f"{cited[clause][0]}: cites {clause}, which the specification does not have"
