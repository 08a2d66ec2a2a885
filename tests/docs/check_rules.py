#!/usr/bin/env python3
"""Every rule of rules.py serves a command of a document, links lead somewhere, and documents keep their length.

usage: check_rules.py ROOT DOCUMENT...
"""

import sys
from pathlib import Path

import document
import links
import rules

README_LINES = 120
WORDS = 27250  # README.md and docs/*.md, without the specification


def unused(found):
    """A complaint for each rule that no command of `found` uses."""
    used = {rule for command in found for rule in rules.substitute(command.text)[2]}
    return [f"rules.py: no document needs {rule.pattern.pattern}"
            for rule in [*rules.WORDS, *rules.COMMANDS] if rule not in used]


def sizes(root):
    """A complaint for each document or set of documents that has become too long."""
    lines = len((root / "README.md").read_text(encoding="utf-8").splitlines())
    if lines > README_LINES:
        yield f"README.md: {lines} lines, not {README_LINES} at most"
    counted = [root / "README.md", *(root / "docs").glob("*.md")]
    words = sum(len(path.read_text(encoding="utf-8").split())
                for path in counted if path.name != "specification.md")
    if words > WORDS:
        yield f"docs: {words} words, not {WORDS} at most"


def main():
    root, names = Path(sys.argv[1]), sys.argv[2:]
    found = []
    for name in names:
        lines = (root / name).read_text(encoding="utf-8").splitlines()
        found += document.commands(lines, name)
    complaints = [*unused(found), *sizes(root)]
    for name in names:
        complaints += links.dead(root, name)
    print("\n".join(complaints))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
