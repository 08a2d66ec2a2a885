"""Annex A against error.hpp and error.cpp: number, name and meaning of every error."""

import re

from specification import read, table_after

HEADER = "model/include/hmlfc/error.hpp"
SOURCE = "model/bits/error.cpp"


def annex_errors(text):
    """{number: (name, meaning)} of annex A."""
    rows = table_after(text, "## Annex A")[1:]
    return {int(number): (name, meaning) for number, name, meaning in rows}


def enumerators(header):
    """{number: name}, the enumerators in the words of annex A: kBadMagic is bad_magic."""
    body = re.search(r"enum class ErrorCode[^{]*\{(.*?)\};", header, re.DOTALL).group(1)
    names = {}
    for name, number in re.findall(r"\bk(\w+) = (\d+)", body):
        names[int(number)] = re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()
    return names


def texts(source):
    """{number: (name, meaning)}: the table of error.cpp, whose rows are in numeric order."""
    body = re.search(r"kErrorTexts\{\{(.*?)\}\};", source, re.DOTALL).group(1)
    joined = re.sub(r'"\s*\n\s*"', "", body)
    return dict(enumerate(re.findall(r'\{\s*"([^"]*)",\s*"([^"]*)"\s*\}', joined)))


def violations(root):
    annex = annex_errors(read(root))
    header = (root / HEADER).read_text()
    names = enumerators(header)
    table = texts((root / SOURCE).read_text())
    if sorted(annex) != list(range(len(annex))):
        yield f"annex A: the numbers are {sorted(annex)}"
    for number in sorted(set(annex) | set(names) | set(table)):
        name, meaning = annex.get(number, (None, None))
        if names.get(number) != name:
            yield f"{HEADER}: error {number} is {names.get(number)}, in annex A {name}"
        if table.get(number) != (name, meaning):
            yield f"{SOURCE}: error {number} is {table.get(number)}, in annex A {(name, meaning)}"
    count = int(re.search(r"kErrorCodeCount = (\d+)", header).group(1))
    if count != len(annex):
        yield f"{HEADER}: kErrorCodeCount is {count}, annex A has {len(annex)} errors"
