"""Small changes to a C++ source, each of which a test should notice."""

import hashlib
import re
from dataclasses import dataclass, field

# clang-format puts a space on both sides of binary operators and none beside those of templates,
# pointers and references.
OPERATORS = {
    **{"<": ["<=", ">"], "<=": ["<", ">="], ">": [">=", "<"], ">=": [">", "<="]},
    **{"==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"]},
    **{"+": ["-"], "-": ["+"], "*": ["+"], "/": ["*"], "%": ["/"]},
    **{"<<": [">>"], ">>": ["<<"], "&": ["|"], "|": ["&"], "^": ["|"]},
    **{"+=": ["-="], "-=": ["+="], "*=": ["+="], "|=": ["&="], "&=": ["|="], "<<=": [">>="]},
    **{">>=": ["<<="]},
}
WORDS = {
    **{"true": ["false"], "false": ["true"], "continue": ["break"]},
    **{"min": ["max"], "max": ["min"]},
}

TOKEN = re.compile(
    r"""(?P<skip>//.*|"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')
      | (?<=[ ])(?P<operator>[-+*/%&|^<>=!]=?|<<=?|>>=?|&&|\|\|)(?=[ ]|$)
      | (?P<not>!)(?=[A-Za-z_(*])
      | (?P<number>\b(?:0[xX][0-9a-fA-F]+|[0-9]+))(?=[uU]?\b)
      | (?P<word>\b[A-Za-z_][A-Za-z_0-9]*)""",
    re.VERBOSE,
)
# In a report: "survived: MUTANT    LINE"; in the progress of a run: "1/9 MUTANT: survived".
SURVIVOR = re.compile(r"^survived: (\S+: \S+ -> \S+)|^\d+/\d+ (\S+: \S+ -> \S+): survived$", re.M)
# Lines where a change has no effect or does not compile.
NO_CODE = re.compile(r"\s*(#|//|static_assert|assert\(|watch\(|template|using |namespace )")


@dataclass(frozen=True)
class Mutant:
    """A change of `old` at `column` of `line` of `file` to `new`."""

    file: str
    line: int
    column: int
    old: str
    new: str
    text: str = field(default="", compare=False)  # the line

    def apply(self, text):
        lines = text.splitlines(keepends=True)
        row = lines[self.line - 1]
        assert row[self.column :].startswith(self.old)
        lines[self.line - 1] = row[: self.column] + self.new + row[self.column + len(self.old) :]
        return "".join(lines)

    def change(self):
        return f"{self.old} -> {self.new or 'nothing'}"

    def __str__(self):
        return f"{self.file}:{self.line}:{self.column + 1}: {self.change()}"


def changes_of_number(text):
    value = int(text, 0)
    return [str(value + 1)] + ([str(value - 1)] if value > 0 else [])


def changes_of(match):
    """The replacements for the token of `match`."""
    kind, token = match.lastgroup, match.group()
    if kind == "operator":
        return OPERATORS.get(token, [])
    if kind == "not":
        return [""]
    if kind == "number":
        return changes_of_number(token)
    return WORDS.get(token, []) if kind == "word" else []


def mutants_of(file, text, skipped=frozenset()):
    """Every mutant of `text`, in order, outside the lines `skipped`."""
    found = []
    for number, row in enumerate(text.splitlines(), 1):
        if number in skipped or NO_CODE.match(row):
            continue
        for match in TOKEN.finditer(row):
            for new in changes_of(match):
                found.append(Mutant(file, number, match.start(), match.group(), new, row.strip()))
    return found


def choose(mutants, count, seed):
    """`count` of `mutants`, the same for the same seed; a larger count adds to a smaller one. Mutants
    of unchanged lines keep their order when the source changes."""

    def place(mutant):
        key = f"{seed} {mutant.file} {mutant.text} {mutant.change()}"
        return hashlib.sha256(key.encode()).digest()

    return sorted(mutants, key=place)[:count]


def survivors_in(report, mutants):
    """The survivors that `report`, the output of an earlier run, names, in its order.
    ValueError: one of them is not in `mutants`."""
    known = {str(mutant): mutant for mutant in mutants}
    names = [match[1] or match[2] for match in SURVIVOR.finditer(report)]
    for name in names:
        if name not in known:
            raise ValueError(f"{name}: not a mutant of the present source")
    return [known[name] for name in dict.fromkeys(names)]


def reasons_of(entries, mutants, line_of):
    """Maps mutants to the reason why no input can tell them from the source. Each of `entries` names a
    mutant by "file", the text of its "line" and its "change"; "nth", from 0, selects one of several.
    `line_of(mutant)`: the text of its line.
    ValueError: an entry fits no mutant, several, or one that another entry has."""
    found = {}
    named = {}
    for mutant in mutants:
        key = (mutant.file, line_of(mutant), mutant.change())
        named.setdefault(key, []).append(mutant)
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
