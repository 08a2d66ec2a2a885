#!/usr/bin/env python3
"""abi_test.py COMPILER INCLUDE [--update]: the binary interface of hmlfc/hmlfc.h below INCLUDE is that of hmlfc.abi.

Every function of the header is compiled with an empty body and debug information, from which abidw tells the sizes and
offsets of all types: the library's own functions have these types, or it would not compile. --update writes hmlfc.abi,
where a difference is meant. Functions, statuses, and members at the end of structures with struct_size may be added;
all else breaks programs.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RECORDED = Path(__file__).with_name("hmlfc.abi")
RECORDED_BY = "abidw: 2.2.0"
OPTIONS = ("--no-show-locs", "--no-corpus-path", "--no-comp-dir-path", "--no-elf-needed", "--no-architecture")
ENUM = re.compile(r"^typedef enum (\w+)", re.M)
FUNCTION = re.compile(r"^HMLFC_C_EXPORT ([^;]+);", re.M)


def dump(compiler, header, include):
    """The interface of the text of a header."""
    functions = FUNCTION.findall(header)
    assert len(functions) > 10, "no functions are found in the header"
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "interface.c", Path(folder) / "interface.so"
        functions += [f"void uses_{name}({name} value)" for name in ENUM.findall(header)]
        source.write_text(header + "\n" + "\n".join(f"{function} {{}}" for function in functions))
        flags = ["-std=c99", "-g", "-O0", "-w", "-shared", "-fPIC", f"-I{include}"]
        subprocess.run([compiler, *flags, source, "-o", library], check=True)
        text = subprocess.run(["abidw", *OPTIONS, library], check=True, capture_output=True, text=True).stdout
    return re.sub(r" (path|comp-dir-path|soname|version)='[^']*'", "", text)


def differences(recorded, found):
    """What changed, in words; empty if nothing did."""
    if recorded == found:
        return ""
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / name for name in ("recorded.abi", "found.abi")]
        for file, text in zip(files, (recorded, found)):
            file.write_text(text)
        told = subprocess.run(["abidiff", "--harmless", *map(str, files)], capture_output=True, text=True).stdout
    version = subprocess.run(["abidw", "--version"], capture_output=True, text=True).stdout
    # Dumps of other releases differ in words.
    return told or ("the dumps differ\n" if RECORDED_BY in version else "")


def main():
    compiler, include, *update = sys.argv[1:]
    if not shutil.which("abidw"):
        print("abidw is not installed (Debian: abigail-tools)")
        return 77
    header = (Path(include) / "hmlfc/hmlfc.h").read_text()
    found = dump(compiler, header, include)
    if update == ["--update"]:
        RECORDED.write_text(found)
    recorded = RECORDED.read_text()
    told = differences(recorded, found)
    if told:
        print(f"{told}\nIf this is meant: {' '.join(sys.argv)} --update")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main())
