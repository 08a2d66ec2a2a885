"""Small changes to a source, each of which a test should notice; their names, choice and reasons."""

import hashlib
import re
from dataclasses import dataclass

# In a report: "survived: MUTANT    LINE"; in the progress of a run: "1/9 MUTANT: survived".
SURVIVOR = re.compile(r"^survived: (.+?)    |^\d+/\d+ (.+): survived$", re.M)
PROGRESS = re.compile(r"^\d+/\d+ (.+?): (killed|crash|timeout|same code|equivalent|survived|not compiled)(?: (.*))?$", re.M)


@dataclass(frozen=True)
class Mutant:
    """A change of `old` at `begin` of the text of `file` to `new`."""

    kind: str  # of the change
    file: str
    begin: int
    old: str
    new: str
    line: int  # from 1 on
    column: int  # from 1 on
    code: str  # the text of the line

    @classmethod
    def of(cls, kind, file, text, begin, old, new):
        line = text.count("\n", 0, begin) + 1
        column = begin - text.rfind("\n", 0, begin)
        return cls(kind, file, begin, old, new, line, column, text.splitlines()[line - 1].strip())

    def apply(self, text):
        assert text.startswith(self.old, self.begin)
        return text[: self.begin] + self.new + text[self.begin + len(self.old) :]

    def change(self):
        old, new = (" ".join(part.split()) for part in (self.old, self.new))
        return f"{old} -> {new or 'nothing'}"

    def __str__(self):
        return f"{self.file}:{self.line}:{self.column}: {self.change()}"


def shuffled(mutants, key):
    """`mutants` in an order that the texts key(mutant) decide, the same on every machine."""
    return sorted(mutants, key=lambda mutant: hashlib.sha256(key(mutant).encode()).digest())


def survivors_in(report, mutants):
    """The survivors that `report`, the output of an earlier run, names, in its order.
    ValueError: one of them is not in `mutants`."""
    known = {str(mutant): mutant for mutant in mutants}
    names = [match[1] or match[2] for match in SURVIVOR.finditer(report)]
    for name in names:
        if name not in known:
            raise ValueError(f"{name}: not a mutant of the present source")
    return [known[name] for name in dict.fromkeys(names)]


def results_in(progress, mutants):
    """Maps those of `mutants` that `progress`, of an earlier run, names to their result and its detail."""
    told = {name: (result, detail) for name, result, detail in PROGRESS.findall(progress)}
    return {mutant: told[str(mutant)] for mutant in mutants if str(mutant) in told}


def reasons_of(entries, mutants):
    """Maps mutants to the reason why no input can tell them from the source. Each of `entries` names a
    mutant by "file", the text of its "line" and its "change"; "nth", from 0, selects one of several.
    ValueError: an entry fits no mutant, several, or one that another entry has."""
    found = {}
    named = {}
    for mutant in mutants:
        named.setdefault((mutant.file, mutant.code, mutant.change()), []).append(mutant)
    for entry in entries:
        key = (entry["file"], entry["line"], entry["change"])
        fitting = named.get(key, [])
        if "nth" in entry:
            fitting = fitting[entry["nth"] :][:1]
        if len(fitting) != 1:
            raise ValueError(f"{' '.join(key)!r} fits {len(fitting)} mutants; one is needed")
        if fitting[0] in found:
            raise ValueError(f"{fitting[0]}: two reasons")
        found[fitting[0]] = entry["reason"]
    return found
