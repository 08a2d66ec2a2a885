"""Mutants of one GLSL source: every place and kind of change."""

from glsl import arguments_of, bodies, closing, tokens_of
from mutants import Mutant

KINDS = ["operator", "comparison", "constant", "shift", "condition", "min_max", "statement"]

OPERATORS = {
    "+": "-", "-": "+", "*": "+", "/": "*", "%": "/", "&": "|", "|": "&", "<<": ">>", ">>": "<<",
    "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "|=": "&=", "/=": "*=", "++": "--",
    "~": "", "!": "",
}  # fmt: skip
COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}


def numbers(token):
    """A literal one larger and one smaller, where the type has them."""
    suffix = "u" if token.text[-1] in "uU" else ""
    value = int(token.text.rstrip("uU"), 0)
    changed = [value + 1] if value < 0xFFFFFFFF else []
    changed += [value - 1] if value > 0 else []
    return [f"{number}{suffix}" for number in changed]


def of_token(tokens, i):
    """Changes of token i alone: (kind, first token, end token, new text)."""
    token, text = tokens[i], tokens[i].text
    if token.kind == "number":
        kind = "shift" if tokens[i - 1].text in ("<<", ">>") else "constant"
        for number in numbers(token):
            yield kind, i, i + 1, number
    if token.kind != "operator":
        return
    if text in COMPARISONS:
        yield "comparison", i, i + 1, COMPARISONS[text]
    if text in OPERATORS:
        yield "operator", i, i + 1, OPERATORS[text]
    if text in ("<<", ">>") and tokens[i + 1].kind != "number":
        yield "shift", i, i + 1, f"{text} 1 +"


def of_call(source, tokens, i):
    """Changes of the call or the condition whose name is token i."""
    text = tokens[i].text
    if i + 1 == len(tokens) or tokens[i + 1].text != "(":
        return
    end = closing(tokens, i + 1)
    if text in ("if", "while"):
        inside = source[tokens[i + 1].end : tokens[end].begin]
        yield "condition", i + 1, end + 1, f"(!({inside}))"
    if text in ("min", "max"):
        yield "min_max", i, i + 1, "max" if text == "min" else "min"
    if text == "clamp":
        x, low, high = (
            source[tokens[first].begin : tokens[last - 1].end]
            for first, last in arguments_of(tokens, i + 1)
        )
        yield "min_max", i, end + 1, f"max({x}, {low})"
        yield "min_max", i, end + 1, f"min({x}, {high})"


def of_statement(tokens, i, end):
    """The statement that begins with token i, dropped. Declarations stay: nothing would compile."""
    if tokens[i - 1].text not in (";", "{", "}", ")", "else"):
        return
    if tokens[i].kind != "name" or tokens[i].text in ("const", "if", "for", "while", "else"):
        return
    declares = tokens[i + 1].kind == "name" and tokens[i].text != "return"
    if declares or tokens[i].depth == 0 or in_brackets(tokens, i):
        return
    last = next((k for k in range(i, end) if tokens[k].text == ";"), None)
    # The last statement of a function that returns a value is needed.
    if last is None or (tokens[i].text == "return" and tokens[i - 1].text != ")"):
        return
    yield "statement", i, last, ""


def in_brackets(tokens, i):
    """Whether token i stands in the head of a loop or in a call."""
    level = 0
    for k in range(i - 1, -1, -1):
        if tokens[k].text == ")":
            level += 1
        elif tokens[k].text == "(":
            level -= 1
            if level < 0:
                return True
        elif tokens[k].text in ("{", "}"):
            return False
    return False


def mutants_of(file, source):
    """All mutants of one source."""
    tokens = tokens_of(source)
    for first, end in bodies(tokens):
        for i in range(first, end):
            changes = [*of_token(tokens, i), *of_call(source, tokens, i)]
            changes += of_statement(tokens, i, end)
            for kind, begin, last, new in changes:
                at = tokens[begin].begin
                yield Mutant.of(kind, file, source, at, source[at : tokens[last - 1].end], new)
