"""Mutants of a C++ source that clang-format has formatted."""

import re

from mutants import Mutant

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
# Lines where a change has no effect or does not compile.
NO_CODE = re.compile(r"\s*(#|//|static_assert|assert\(|watch\(|template|using |namespace )")


def changes_of(kind, token):
    """The replacements for a token."""
    if kind == "not":
        return [""]
    if kind == "number":
        value = int(token, 0)
        return [str(value + 1)] + ([str(value - 1)] if value > 0 else [])
    return {"operator": OPERATORS, "word": WORDS}.get(kind, {}).get(token, [])


def mutants_of(file, text, skipped=frozenset()):
    """Every mutant of `text`, in order, outside the lines `skipped`."""
    found, begin = [], 0
    for number, row in enumerate(text.splitlines(keepends=True), 1):
        if number not in skipped and not NO_CODE.match(row):
            for match in TOKEN.finditer(row.rstrip("\n")):
                kind, token = match.lastgroup, match.group()
                for new in changes_of(kind, token):
                    found.append(Mutant.of(kind, file, text, begin + match.start(), token, new))
        begin += len(row)
    return found
