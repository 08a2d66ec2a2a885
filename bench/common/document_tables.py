"""Tables between markers of a Markdown document: `<!-- table NAME -->` to `<!-- end of table -->`."""

import re

from bench_error import BenchError

PLACE = re.compile(r"(<!-- table (\w+) -->\n)(.*?)(<!-- end of table -->)", re.DOTALL)


def with_tables(text, make, names):
    """The text with the lines of make(name) in the place of each table. Every name has one place."""
    found = [match[2] for match in PLACE.finditer(text)]
    if sorted(found) != sorted(names):
        raise BenchError(f"the document has places for the tables {found}, not for {list(names)}")
    return PLACE.sub(lambda match: match[1] + "\n".join(make(match[2])) + "\n" + match[4], text)
