#!/usr/bin/env python3
"""Checks that a shared library exports what the public headers mark with HMLFC_EXPORT and HMLFC_C_EXPORT, no more, no less."""

import re
import subprocess
import sys

MARK = re.compile(r"(?P<before>\S+)\s+HMLFC_EXPORT\s+(?P<head>[^;{]*)")
C_MARK = re.compile(r"^HMLFC_C_EXPORT ([^;(]+)", re.M)


def marked_names(header):
    """The classes and the functions that a header marks, as sets of 'hmlfc::name'; of C 'name'."""
    text = re.sub(r"//[^\n]*|#[^\n]*|/\*.*?\*/", "", header, flags=re.DOTALL)
    classes, functions = set(), set()
    for match in MARK.finditer("; " + text):
        if match["before"] in ("class", "struct"):
            classes.add("hmlfc::" + match["head"].split()[0])
        else:
            functions.add("hmlfc::" + match["head"].split("(")[0].split()[-1])
    functions |= {declared.split()[-1].lstrip("*") for declared in C_MARK.findall(header)}
    return classes, functions


def exported_names(symbols):
    """The outermost classes and the functions among demangled symbols, each with one of its symbols."""
    names = {}
    for symbol in symbols:
        name = re.sub(r"^(vtable|typeinfo|typeinfo name) for ", "", symbol)
        parts = re.sub(r"\[abi:[^\]]*\]|\(.*", "", name).split("::")
        names.setdefault("::".join(parts[:2]), symbol)
    return names


def violations(symbols, headers):
    """What differs between exported symbols and the marks in the texts of all public headers.

    A class whose functions are all inline need not have a symbol.
    """
    classes, functions = (set().union(*names) for names in zip(*map(marked_names, headers)))
    exported = exported_names(symbols)
    hidden = sorted(functions - set(exported))
    extra = sorted(set(exported) - classes - functions)
    return [f"exported, but not public: {exported[name]}" for name in extra] + [
        f"public, but not exported: {name}" for name in hidden
    ]


def check(library, headers):
    """The violations of the shared library `library`; `headers` are the paths of the public headers."""
    listing = subprocess.run(["nm", "-DC", "--defined-only", library], check=True, capture_output=True, text=True)
    symbols = [line.split(maxsplit=2)[2] for line in listing.stdout.splitlines()]
    return violations(symbols, [header.read_text() for header in headers])


def self_test():
    headers = ["class HMLFC_EXPORT Decoder {\n};\n", "HMLFC_C_EXPORT const char* hmlfc_name(int);\n", "HMLFC_EXPORT Result<int>\nparse(int a,\n          int b);\n"]
    good = ["hmlfc_name", "hmlfc::Decoder::open(int)", "vtable for hmlfc::Decoder", "hmlfc::parse[abi:cxx11](int, int)"]
    assert violations(good, headers) == [], violations(good, headers)
    faults = {
        "hmlfc::read_window(int)": good + ["hmlfc::read_window(int)"],
        "std::vector<int>::size()": good + ["std::vector<int>::size()"],
        "typeinfo for hmlfc::Geometry": good + ["typeinfo for hmlfc::Geometry"],
        "hmlfc::parse": good[:3],
        "hmlfc_crc32c": good + ["hmlfc_crc32c"],
        "hmlfc_name": good[1:],
    }
    for name, symbols in faults.items():
        found = violations(symbols, headers)
        assert len(found) == 1 and found[0].endswith(name), (name, found)
    text = "#define HMLFC_EXPORT x\n/// HMLFC_EXPORT int no();\nHMLFC_EXPORT double psnr(uint64_t s);"
    assert marked_names(text) == (set(), {"hmlfc::psnr"}), marked_names(text)


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    sys.exit(__doc__)
