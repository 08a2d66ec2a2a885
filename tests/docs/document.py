"""The commands of a Markdown document, and the outputs that it quotes.

A command is a line that begins with ./run, hmlfc, cmake, ctest, g++, env, a simulator or sim/ in a fenced block without a
language or with `sh`, or an inline code span that begins with ./run. A backslash at its end
continues it. In a workflow (*.yml) it is such a line, also behind `run: `.

A fenced block with the language `text` quotes the output of the last fenced command before it, whole or

    ```text from="A" to="B"      from the first line that has A to the next that has B; either may be left out
"""

import re
from dataclasses import dataclass, field

COMMAND = re.compile(r"(?:\./run|hmlfc|cmake|ctest|g\+\+|env|verilator|iverilog|sim/\w+)(?: |$)")
FENCE = re.compile(r"^( *)```(.*)$")
SPAN = re.compile(r"`(\./run [^`]+)`")
LIMIT = re.compile(r'\b(from|to)="([^"]*)"')
COMMENT = re.compile(r"\s+#.*$")


class DocumentError(Exception):
    """A document is not what this module expects; the message names file and line."""


@dataclass
class Quote:
    """Quoted output: its place in the lines of the document, [first, end), its limits and indent."""

    first: int
    end: int
    limits: dict
    indent: str


@dataclass
class Command:
    line: int  # from 1 on
    text: str
    quotes: list = field(default_factory=list)


def commands(lines, name):
    """The commands of a document in their order; `name` is for messages."""
    if name.endswith((".yml", ".yaml")):
        return list(_workflow_commands(lines))
    return list(_markdown_commands(lines, name))


def _workflow_commands(lines):
    for number, line in enumerate(lines, 1):
        text = re.sub(r"^[\s-]*(?:run: )?", "", line)
        if COMMAND.match(text):
            yield Command(number, text)


def _markdown_commands(lines, name):
    last = None
    number = 0
    while number < len(lines):
        fence = FENCE.match(lines[number])
        if not fence:
            for span in SPAN.findall(lines[number]):
                yield Command(number + 1, span.replace("\\|", "|"))
            number += 1
            continue
        end = _end_of_block(lines, number, name)
        language = fence[2].split(" ")[0]
        if language == "text":
            if last is None:
                raise DocumentError(f"{name}:{number + 1}: output without a command before it")
            last.quotes.append(Quote(number + 1, end, dict(LIMIT.findall(fence[2])), fence[1]))
        elif language in ("", "sh"):
            for command in _block_commands(lines, number + 1, end, name):
                yield command
                last = command
        number = end + 1


def _end_of_block(lines, begin, name):
    for number in range(begin + 1, len(lines)):
        if FENCE.match(lines[number]):
            return number
    raise DocumentError(f"{name}:{begin + 1}: this block has no end")


def _block_commands(lines, first, end, name):
    """Nothing where no line is a command, as in pseudo-code; else every line must be one."""
    stripped = [line.strip() for line in lines[first:end]]
    if not any(COMMAND.match(line) for line in stripped):
        return
    number = first
    while number < end:
        begin, text = number, lines[number].strip()
        while text.endswith("\\") and number + 1 < end:
            number += 1
            text = text[:-1] + lines[number].strip()
        number += 1
        text = COMMENT.sub("", text)
        if text and not text.startswith("#"):
            if not COMMAND.match(text):
                raise DocumentError(f"{name}:{begin + 1}: no command: {text}")
            yield Command(begin + 1, text)


def excerpt(output, limits):
    """The lines of `output` within the limits of a quote, or None where a limit is not in it."""
    first, end = 0, len(output)
    if "from" in limits:
        first = next((i for i, line in enumerate(output) if limits["from"] in line), None)
        if first is None:
            return None
    if "to" in limits:
        last = next((i for i in range(first, end) if limits["to"] in output[i]), None)
        if last is None:
            return None
        end = last + 1
    return output[first:end]
