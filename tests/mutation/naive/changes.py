"""Mutants of one Python source: every place and kind of change."""

import ast
import re

from mutants import Mutant

KINDS = ["operator", "comparison", "constant", "condition", "statement", "argument", "clamp", "order"]

OPERATORS = {
    "+": "-", "-": "+", "*": "+", "/": "*", "//": "*", "%": "//", "**": "*", "<<": ">>", ">>": "<<",
    "&": "|", "|": "&", "^": "|", "and": "or", "or": "and",
}  # fmt: skip
COMPARISONS = {
    "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"],
    "==": ["!="], "!=": ["=="], "in": ["not in"], "not in": ["in"], "is": ["is not"], "is not": ["is"],
}  # fmt: skip
CHECKS = ("require", "demand")
# An operator between two operands, which may have brackets.
TOKEN = re.compile(r"not in|is not|[^\s()]+")


class Source:
    """A source and its syntax tree, whose nodes know their parents."""

    def __init__(self, file, text):
        if not text.isascii():
            raise ValueError(f"{file}: columns are counted in bytes, so that only ASCII is understood")
        self.file, self.text, self.tree = file, text, ast.parse(text)
        self.starts = [0, *(match.end() for match in re.finditer("\n", text))]
        self.parent = {}
        for node in ast.walk(self.tree):
            self.parent.update((child, node) for child in ast.iter_child_nodes(node))

    def span(self, node):
        """[begin, end) of a node in the text."""
        begin = self.starts[node.lineno - 1] + node.col_offset
        return begin, self.starts[node.end_lineno - 1] + node.end_col_offset

    def code(self, node):
        """The text of a node."""
        return self.text[slice(*self.span(node))]

    def site(self, mutant):
        """The first line of the innermost statement of a function that has the change; None outside functions."""
        best = None
        for node in ast.walk(self.tree):
            if isinstance(node, ast.stmt) and function_of(self, node):
                begin, end = self.span(node)
                if begin <= mutant.begin < end and (best is None or begin >= self.span(best)[0]):
                    best = node
        return best and best.lineno


def function_of(source, node):
    """The innermost function whose body has the node; None outside functions."""
    while node in source.parent:
        node = source.parent[node]
        if isinstance(node, ast.FunctionDef):
            return node
    return None


def is_called(node, names):
    """Whether a node is a call of one of these functions."""
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in names


def of_operators(source, node):
    """Operators and comparisons, one at a time."""
    if isinstance(node, ast.BinOp):
        operands = [node.left, node.right]
    elif isinstance(node, ast.BoolOp):
        operands = node.values
    elif isinstance(node, ast.Compare):
        operands = [node.left, *node.comparators]
    elif isinstance(node, ast.AugAssign):
        operands = [node.target, node.value]
    else:
        return
    for left, right in zip(operands, operands[1:]):
        begin = source.span(left)[1]
        token = TOKEN.search(source.text, begin, source.span(right)[0])
        place, old = token.span(), token.group()
        if isinstance(node, ast.Compare):
            for new in COMPARISONS[old]:
                yield "comparison", *place, new
        elif isinstance(node, ast.AugAssign):
            yield "operator", *place, OPERATORS[old[:-1]] + "="
        else:
            yield "operator", *place, OPERATORS[old]


def of_constants(source, node):
    """Signs, integers one more and one less, truth values."""
    if isinstance(node, ast.UnaryOp):
        yield "operator", *source.span(node), f"({source.code(node.operand)})"
    if isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield "constant", *source.span(node), str(not node.value)
    elif isinstance(node, ast.Constant) and isinstance(node.value, int):
        for value in (node.value + 1, node.value - 1):
            # 2**-1 would be no integer: -1 has to keep its brackets.
            yield "constant", *source.span(node), str(value) if value >= 0 else f"({value})"


def conditions_of(node):
    """The conditions that a node decides by, with the values to which each may be fixed."""
    if isinstance(node, ast.While):
        return [(node.test, ("False",))]
    if isinstance(node, (ast.If, ast.IfExp)):
        return [(node.test, ("True", "False"))]
    if isinstance(node, ast.comprehension):
        return [(test, ("True", "False")) for test in node.ifs]
    if isinstance(node, ast.BoolOp):
        fixed = "True" if isinstance(node.op, ast.And) else "False"
        return [(value, (fixed,)) for value in node.values]
    return []


def of_conditions(source, node):
    """Conditions negated, or fixed; parts of a condition left out."""
    for test, values in conditions_of(node):
        if not isinstance(node, ast.BoolOp):
            yield "condition", *source.span(test), f"(not ({source.code(test)}))"
        for value in values:
            yield "condition", *source.span(test), value


def of_statements(source, node):
    """Statements dropped: those whose names are not needed afterwards."""
    function = function_of(source, node)
    if function is None:
        return
    dropped = isinstance(node, (ast.AugAssign, ast.Raise, ast.Continue, ast.Break))
    dropped |= isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)
    dropped |= isinstance(node, ast.Return) and source.parent[node] is not function
    if isinstance(node, ast.Assign):
        dropped |= isinstance(node.targets[0], ast.Subscript) or is_bound_before(source, node, function)
    if dropped:
        yield "statement", *source.span(node), "pass"


def is_bound_before(source, node, function):
    """Whether a function binds the target of an assignment further up, too."""
    names = [argument.arg for argument in function.args.args]
    names += [
        source.code(target)
        for other in ast.walk(function)
        if isinstance(other, ast.Assign) and other.lineno < node.lineno
        for target in other.targets
    ]
    return source.code(node.targets[0]) in names


def of_calls(source, node):
    """Neighbouring arguments exchanged, clamps, minima and maxima dropped."""
    if not isinstance(node, ast.Call):
        return
    for first, second in zip(node.args, node.args[1:]):
        texts = source.code(first), source.code(second)
        between = source.text[source.span(first)[1] : source.span(second)[0]]
        if "*" not in texts[0][0] + texts[1][0] and not is_called(node, (*CHECKS, "min", "max")):
            yield "argument", source.span(first)[0], source.span(second)[1], between.join(texts[::-1])
    if is_called(node, ("clamp",)):
        x, low, high = map(source.code, node.args)
        for new in (f"({x})", f"max({x}, {low})", f"min({x}, {high})"):
            yield "clamp", *source.span(node), new
    if is_called(node, ("min", "max")):
        other = "max" if node.func.id == "min" else "min"
        yield "clamp", *source.span(node.func), other
        if len(node.args) > 1:
            for argument in node.args:
                yield "clamp", *source.span(node), f"({source.code(argument)})"


def of_order(source, node):
    """Checks of two errors that follow one another, exchanged: the first that fails decides the error's name."""
    statements = getattr(node, "body", [])
    for first, second in zip(statements, statements[1:]) if isinstance(statements, list) else ():
        pair = [each.value for each in (first, second) if isinstance(each, ast.Expr)]
        names = {source.code(each.args[1]) for each in pair if is_called(each, ("require",))}
        if len(names) == 2:
            begin, end = source.span(first)[0], source.span(second)[1]
            between = source.text[source.span(first)[1] : source.span(second)[0]]
            yield "order", begin, end, between.join((source.code(second), source.code(first)))


def mutants_of(file, text):
    """All mutants of one source, in the order of its text."""
    source = Source(file, text)
    changes = [
        change
        for node in ast.walk(source.tree)
        for of in (of_operators, of_constants, of_conditions, of_statements, of_calls, of_order)
        for change in of(source, node)
    ]
    return [
        Mutant.of(kind, file, text, begin, text[begin:end], new)
        for kind, begin, end, new in sorted(changes, key=lambda change: (change[1], change[2]))
        if text[begin:end] != new
    ]
