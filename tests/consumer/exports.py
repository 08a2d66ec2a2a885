"""Checks that a shared library exports what the public headers mark with HMLFC_EXPORT and HMLFC_C_EXPORT, no more, no less."""

import re
import subprocess

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
