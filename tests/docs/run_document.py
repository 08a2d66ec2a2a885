#!/usr/bin/env python3
"""Runs the commands of a document in their order, and compares the outputs that it quotes.

usage: run_document.py ROOT BUILD HMLFC FOLDER DOCUMENT [--update]

ROOT is the repository, BUILD a build of everything, HMLFC the program hmlfc of it, FOLDER a scratch folder, DOCUMENT a path below ROOT.
--update writes the outputs into the document instead.
Exit status: 0 all is true, 1 a command fails or an output differs, 77 no device for the GPU decoder.
"""

import argparse
import re
import sys
from pathlib import Path

import document
import rules
from sandbox import Sandbox

SKIPPED = 77
NO_DEVICE = re.compile(r"no Vulkan on this machine|this build has no GPU decoder")
NUMBER = re.compile(r"(?<![\w.-])-?(?:0x[0-9a-f]+|\d+)(?![\w])")
# Documents whose text may name no number that stands in none of their commands and outputs.
CLOSED = ("docs/walkthrough.md",)


def compare(lines, command, output, name):
    """A complaint for each quote of `command` that is not in its output."""
    for quote in command.quotes:
        quoted = [line.rstrip().removeprefix(quote.indent) for line in lines[quote.first:quote.end]]
        expected = document.excerpt(output, quote.limits)
        if expected is None:
            yield f"{name}:{quote.first}: the output has no lines from and to {quote.limits}"
        elif quoted != expected:
            wrong = next((i for i, pair in enumerate(zip(quoted, expected)) if pair[0] != pair[1]),
                         min(len(quoted), len(expected)))
            shown = expected[wrong] if wrong < len(expected) else "(nothing more)"
            yield f"{name}:{quote.first + 1 + wrong}: the output is now\n  {shown}"


def update(lines, command, output):
    """Replaces the quotes of `command` by its output. Returns by how many lines the document grew."""
    grown = 0
    for quote in command.quotes:
        made = document.excerpt(output, quote.limits)
        if made is None:
            raise document.DocumentError(f"the output of {command.text} has no lines from and to {quote.limits}")
        first, end = quote.first + grown, quote.end + grown
        lines[first:end] = [(quote.indent + line).rstrip() for line in made]
        grown += len(made) - (end - first)
    return grown


def unknown_numbers(lines, outputs, name):
    """A complaint for each number in the text of a document that no command or output has. Numbers
    below 10 and those of clauses pass."""
    known = {token for text in outputs for token in NUMBER.findall(text)}
    inside = False
    for number, line in enumerate(lines, 1):
        if document.FENCE.match(line):
            inside = not inside
        elif not inside:
            text = re.sub(r"\b[A-Z]{3,4}-\d+\b|JPEG 2000", "", line)
            for token in NUMBER.findall(text):
                if token not in known and not re.fullmatch(r"-?\d", token):
                    yield f"{name}:{number}: {token} is in no output of this page"


def check(root, sandbox, name, updating=False):
    """(complaints, texts of skipped commands)"""
    path = root / name
    lines = path.read_text(encoding="utf-8").splitlines()
    complaints, skipped, outputs, grown = [], [], [], 0
    for command in document.commands(lines, name):
        made, options, _ = rules.substitute(command.text)
        if made is rules.NAMED_ONLY:
            made = f"(./run; ./run help developers) | grep -- '^  {command.text.split()[1]} '"
        result = sandbox.run(made)
        if result.returncode and NO_DEVICE.search(result.stdout + result.stderr):
            skipped.append(command.text)
            continue
        if result.returncode:
            shown = command.text if made == command.text else f"{command.text}\n  run as {made}"
            said = (result.stdout + result.stderr)[-2000:]
            complaints.append(f"{name}:{command.line}: exit status {result.returncode}: {shown}\n{said}")
            continue
        for option in options:
            if option not in rules.OPTION.findall(result.stdout):
                complaints.append(f"{name}:{command.line}: {made} has no {option}: {command.text}")
        output = [line.rstrip() for line in result.stdout.splitlines()]
        outputs += [command.text, result.stdout]
        if updating:
            for quote in command.quotes:
                quote.first, quote.end = quote.first + grown, quote.end + grown
            grown += update(lines, command, output)
        else:
            complaints += compare(lines, command, output, name)
    if updating:
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    if name in CLOSED and not skipped:
        complaints += unknown_numbers(lines, outputs, name)
    return complaints, skipped


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("root", "build", "hmlfc", "folder"):
        parser.add_argument(name, type=Path)
    parser.add_argument("document")
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    root = options.root.resolve()
    sandbox = Sandbox(options.folder.resolve(), root, options.build.resolve(), options.hmlfc.absolute())
    complaints, skipped = check(root, sandbox, options.document, options.update)
    print("\n".join(complaints + [f"skipped without a Vulkan device: {text}" for text in skipped]))
    return 1 if complaints else SKIPPED if skipped else 0


if __name__ == "__main__":
    sys.exit(main())
