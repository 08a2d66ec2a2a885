"""Tables between markers of a Markdown document: `<!-- table NAME -->` to `<!-- end of table -->`."""

import re
import sys

from bench_error import BenchError

PLACE = re.compile(r"(<!-- table (\w+) -->\n)(.*?)(<!-- end of table -->)", re.DOTALL)


def with_tables(text, make, names):
    """The text with the lines of make(name) in the place of each table. Every name has one place."""
    found = [match[2] for match in PLACE.finditer(text)]
    if sorted(found) != sorted(names):
        raise BenchError(f"the document has places for the tables {found}, not for {list(names)}")
    return PLACE.sub(lambda match: match[1] + "\n".join(make(match[2])) + "\n" + match[4], text)


def check_or_update(usage, document, make, names):
    """The program of a document's tables: --update puts them there, --check compares. Returns the
    exit status: 1 where the document has other tables."""
    if sys.argv[1:] not in (["--check"], ["--update"]):
        sys.exit(usage)
    text = document.read_text(encoding="utf-8")
    made = with_tables(text, make, names)
    if sys.argv[1] == "--update":
        document.write_text(made, encoding="utf-8")
    elif made != text:
        print(f"{document} has other tables: {sys.argv[0]} --update", file=sys.stderr)
        return 1
    return 0
