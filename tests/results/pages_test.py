#!/usr/bin/env python3
"""Tables that pages of docs/ and README.md take from docs/results have the same rows there."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = re.compile(r"^(\|.*\|)\n\|[-|: ]+\|\n((?:\|.*\|\n)+)", re.MULTILINE)


def tables(text):
    """Pairs (head, rows) of the tables of a Markdown text."""
    return [(match[1], match[2].splitlines()) for match in TABLE.finditer(text)]


def quoted(page, results):
    """(Number of tables with the head of one in `results`, their rows that are not there)."""
    known = {}
    for head, rows in tables(results):
        known.setdefault(head, []).extend(rows)
    taken = [(head, rows) for head, rows in tables(page) if head in known]
    return len(taken), [row for head, rows in taken for row in rows if row not in known[head]]


class PagesTest(unittest.TestCase):
    def test_rows_are_those_of_the_results(self):
        results = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs/results").glob("*.md"))
        counts = {}
        for page in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))):
            counts[page.stem], others = quoted(page.read_text(encoding="utf-8"), results)
            self.assertEqual(others, [], page)
        for page in ("accuracy", "skipping"):
            self.assertGreater(counts[page], 0, f"{page}.md takes no table from docs/results")


if __name__ == "__main__":
    sys.exit(unittest.main())
