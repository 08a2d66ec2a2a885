"""The tables of records against what decoders read. Tiles and their index: every field in the traces
of the conformance vectors has a row of its name, clause and bits, under the row's flag, and every
such row is traced. The header: its fields and flags are those that the naive decoder reads."""

import json
import re
import sys
from functools import cache
from pathlib import Path

from specification import read, rows_after

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "naive_decoder"))

from bise import least_code, levels_of, sequence_bits  # noqa: E402  (its folder is known only now)
from header import read_header  # noqa: E402
from integers import least_bits  # noqa: E402

END_TABLE = "**[IDX-6]**"
# Where a field stands: its section or kind of tile; and what each of their tables follows.
TABLES = {
    "ROOT": ["**[IDX-4]**"],
    "GROUP": ["**[IDX-5]**"],
    "residual tile": [END_TABLE, "**[TIL-1]**", "**[TIL-3]**", "**[TIL-8]**"],
    "motion tile": [END_TABLE, "**[MOT-3]**", "A *palette entry* is:"],
    "disparity tile": [END_TABLE, "**[MOT-6]**"],
}
HEADER_TABLES = ["**[FIL-1]**", "**[FIL-2]**", "**[FIL-3]**", "**[KEY-1]**"]
# The functions that a cell of bits may call. BISE gives the bits of one value, as traces do.
FUNCTIONS = {
    "__builtins__": {},
    "least_code": least_code,
    "BISE": lambda _, code: sequence_bits(1, levels_of(code)),
}


def record_rows(text):
    """{(place, name of a field as traced): row}; fields that are records have tables of their own."""
    return {
        (place, re.sub(r".*\((.*)\)", r"\1", row["field"])): row
        for place, headings in TABLES.items()
        for heading in headings
        for row in rows_after(text, heading)
        if "*" not in re.sub(r"B \* B", "", row["bits"])
    }


def element_bits(cell, values):
    """The bits of one element; `values` has the fields read so far and those of the header."""
    call = re.match(r"BISE\(.*, (.*)\)", cell)
    formula = f"BISE(0, {call.group(1)})" if call else cell.split(" x ")[-1]
    return eval(formula, FUNCTIONS, values)  # pylint: disable=eval-used


def header_values(header):
    """Returns the values that cells may name besides fields of records (TIL-6)."""
    count = 2 * header.window + 1
    return {**vars(header), "v": least_bits(count), "c": least_bits(least_code(count) + 1)}


def is_allowed(flag, values):
    return flag == "all" or values[flag.removeprefix("no ")] != flag.startswith("no ")


def trace_violations(table, fields, values, traced):
    """One violation for each field of a trace that its table does not have like this."""
    for field in fields:
        place = field["section"] if field["section"] in TABLES else field["tile"]
        name = field["name"]
        traced.add((place, name))
        values[name] = field["value"]
        values["offset_bits"] = values.get("place", 0) >> 48 & 0xFF
        row = table.get((place, name))
        if row is None:
            yield f"{place}: no table has {name}"
        elif not is_allowed(row["flag"], values):
            yield f"{place}: {name} is read, but not with the flag {row['flag']}"
        elif (row["clause"], element_bits(row["bits"], values)) != (field["clause"], field["bits"]):
            yield f"{place}: {name} has {field['bits']} bits ({field['clause']}), not {row['bits']} ({row['clause']})"


def header_violations(text, data, header):
    for row in rows_after(text, HEADER_TABLES[0]):
        kind = re.fullmatch(r"([ui])(\d+)", row["type"])
        if kind and hasattr(header, row["field"]):
            at, size = int(row["offset"]), int(kind.group(2)) // 8
            value = int.from_bytes(data[at : at + size], "little", signed=kind.group(1) == "i")
            if value != getattr(header, row["field"]):
                yield f"header: {row['field']} is {getattr(header, row['field'])}, not {value}"
    flags = int.from_bytes(data[12:16], "little")
    for row in rows_after(text, "**[EXT-1]**"):
        if getattr(header, row["flag"]) != bool(flags >> int(row["bit"]) & 1):
            yield f"header: {row['flag']} is not bit {row['bit']}"


def gap_violations(text):
    """Fields with offsets follow each other without gaps."""
    for heading in HEADER_TABLES:
        end = 0
        for row in rows_after(text, heading):
            if row["offset"].isdigit() and int(row["offset"]) != end:
                yield f"{heading}: {row['field']} is not at offset {end}"
            size = re.match(r"[ui](\d+)$|(\d+) bytes$", row["type"])
            end += (int(size.group(1) or 0) // 8 or int(size.group(2))) if size else 0


@cache
def traced_vectors(root):
    """(stream, its header, its trace) of each vector that has a trace."""
    folder = root / "vectors"
    found = []
    for vector in json.loads((folder / "manifest.json").read_text())["vectors"]:
        if "trace" in vector:
            data = (folder / vector["input"]["file"]).read_bytes()
            lines = (folder / vector["trace"]["file"]).read_text().splitlines()
            fields = [f for f in map(json.loads, lines) if f["record"] == "field"]
            found.append((data, read_header(data), fields))
    return found


def found_in(text, root):
    """The violations of the specification `text`."""
    traced, found = set(), list(gap_violations(text))
    table = record_rows(text)
    for data, header, fields in traced_vectors(root):
        found += header_violations(text, data, header)
        found += trace_violations(table, fields, header_values(header), traced)
    found += [f"{place}: nothing reads {name}" for place, name in set(table) - traced]
    return [f"records: {violation}" for violation in sorted(set(found))]


def violations(root):
    return found_in(read(root), root)
