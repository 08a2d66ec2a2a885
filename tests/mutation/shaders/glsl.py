"""GLSL sources as tokens: enough of the language to change one place of it."""

import re
from dataclasses import dataclass

TOKEN = re.compile(
    r"(?P<skip>\s+|//[^\n]*|/\*.*?\*/|^[ \t]*#[^\n]*)"
    r"|(?P<number>0[xX][0-9a-fA-F]+[uU]?|\d+[uU]?)"
    r"|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<operator><<=|>>=|\+\+|--|[-+*/%&|^<>=!]=|<<|>>|&&|\|\||[-+*/%&|^~!<>=?:;,.(){}\[\]])",
    re.DOTALL | re.MULTILINE,
)
PAIRS = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True)
class Token:
    kind: str  # number, name or operator
    text: str
    begin: int  # of the source
    depth: int  # braces around it

    @property
    def end(self):
        return self.begin + len(self.text)


def tokens_of(source):
    """The tokens of a source without comments and directives. ValueError for what is no GLSL."""
    found, at, depth = [], 0, 0
    while at < len(source):
        match = TOKEN.match(source, at)
        if not match:
            raise ValueError(f"no token at {source[at : at + 20]!r}")
        at = match.end()
        if match.lastgroup == "skip":
            continue
        depth -= match.group() == "}"
        found.append(Token(match.lastgroup, match.group(), match.start(), depth))
        depth += match.group() == "{"
    return found


def closing(tokens, opening):
    """Index of the bracket that closes the one at index `opening`."""
    level = 0
    for i in range(opening, len(tokens)):
        if tokens[i].text in PAIRS:
            level += 1
        elif tokens[i].text in PAIRS.values():
            level -= 1
            if level == 0:
                return i
    raise ValueError(f"the bracket at {tokens[opening].begin} is never closed")


def arguments_of(tokens, opening):
    """Pairs of indices [first, end) of the arguments of the call whose bracket is at `opening`."""
    end = closing(tokens, opening)
    parts, first, i = [], opening + 1, opening + 1
    while i < end:
        if tokens[i].text in PAIRS:
            i = closing(tokens, i)
        elif tokens[i].text == ",":
            parts.append((first, i))
            first = i + 1
        i += 1
    return parts + [(first, end)]


def bodies(tokens):
    """Pairs of indices [first, end) of the function bodies, and of the values of constants of the
    file. Structures, buffers and layouts are declarations: they have nothing to change."""
    found, i = [], 0
    while i < len(tokens):
        text = tokens[i].text
        if text in ("struct", "layout"):
            while tokens[i].text not in ("{", ";"):
                i = closing(tokens, i) + 1 if tokens[i].text == "(" else i + 1
            i = closing(tokens, i) if tokens[i].text == "{" else i
        elif text == "{":
            end = closing(tokens, i)
            found.append((i + 1, end))
            i = end
        elif text == "=":
            end = next(k for k in range(i, len(tokens)) if tokens[k].text == ";")
            found.append((i + 1, end))
            i = end
        i += 1
    return found
