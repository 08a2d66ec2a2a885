#!/usr/bin/env python3
"""Plants the faults of a table into a copy of the sources, and sees that what the table names notices each.

    plant.py TABLE... --build BUILD [--only TEXT]     the tables TABLE.toml, with the programs of the build folder BUILD
    plant.py --texts                                  every table still fits the sources; nothing is built

A table has:

    needs   Programs that the commands need.
    make    Commands of the shell that build the copy, run again after each fault.
    status  Exit status of a check that finds nothing (default 0).
    switch  true: `new` and `old` are expressions, of which all are planted at once as
            (fault == N ? new : old): one build for all. {number} in a check is N, and 0 for no fault.
    checks  Commands by name. A fault is found where the check that it names ends with another status.
    setup   Edits of the copy before any fault: file, old, new.
    fault   The faults: `is`, what is wrong; file, old, new; and a check by its name, whose value replaces {it}.

`old` stands once in its file. In commands {tree} is the copy, {scratch} a folder for what is made of it, {build} is
BUILD, {root} the repository and {python} this interpreter. Copy and scratch folder stay in out/faults/ for the next run.

Exit status: 0 all are found, 1 not, or a check fails without a fault, 77 a program or a device is missing.
"""

import argparse
import filecmp
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
LEFT_OUT = {".git", "build", "out", "vectors"}
SECONDS = 600  # for one check
SKIPPED = 77


class TableError(Exception):
    """What is wrong with a table."""


class Missing(Exception):
    """What a table needs and this machine has not."""


def edited(text, edit, new):
    """`text` with `new` instead of edit["old"]. TableError where `text` does not have that once."""
    count = text.count(edit["old"])
    if count != 1:
        raise TableError(f"{edit['file']} has {count} times instead of once: {edit['old']}")
    return text.replace(edit["old"], new)


def refresh(source, copy, left_out=frozenset({"__pycache__"})):
    """Makes `copy` a copy of the folder `source`; files that are equal keep their time, so that little is built."""
    copy.mkdir(parents=True, exist_ok=True)
    names = {path.name for path in source.iterdir()} - left_out
    for name in {path.name for path in copy.iterdir()} - names - left_out:
        shutil.rmtree(copy / name) if (copy / name).is_dir() else (copy / name).unlink()
    for name in names:
        if (source / name).is_dir():
            refresh(source / name, copy / name)
        elif not (copy / name).exists() or not filecmp.cmp(source / name, copy / name, shallow=False):
            shutil.copy(source / name, copy / name)


class Table:
    """A table, its copy of the sources and its commands. `build` is the folder of built programs."""

    def __init__(self, name, build):
        content = tomllib.loads((FOLDER / f"{name}.toml").read_text())
        self.name, self.faults, self.checks = name, content["fault"], content["checks"]
        self.setup, self.make = content.get("setup", []), content["make"]
        self.needs = content.get("needs", [])
        self.passes, self.switch = content.get("status", 0), content.get("switch", False)
        self.scratch = ROOT / "out/faults" / name
        self.tree = self.scratch / "tree"
        self.places = {"tree": self.tree, "scratch": self.scratch, "build": build, "root": ROOT, "python": sys.executable}

    def check_texts(self):
        """TableError where an edit does not fit, or a fault names no check."""
        for edit in self.setup + self.faults:
            edited((ROOT / edit["file"]).read_text(), edit, edit["new"])
        for fault in self.faults:
            self.check_of(fault)

    def check_of(self, fault):
        """The name of the check that finds `fault`, and what the check is to look at."""
        names = [key for key in fault if key in self.checks]
        if len(names) != 1:
            raise TableError(f"{self.name}: {fault['is']}: names {len(names)} checks instead of one")
        return names[0], fault[names[0]]

    def run(self, command, seconds=None, **more):
        """The exit status of a command and what it printed; None where it does not end in `seconds`."""
        for name, value in {**self.places, **more}.items():
            command = command.replace("{" + name + "}", str(value))
        try:
            done = subprocess.run(
                ["bash", "-c", command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                errors="replace", timeout=seconds, check=False, cwd=self.scratch,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return None, "no end"
        return done.returncode, done.stdout

    def build_tree(self):
        """Builds what stands in the tree. TableError where that fails."""
        for command in self.make:
            status, text = self.run(command)
            if status != 0:
                raise TableError(f"{self.name}: {command} fails:\n{text}")

    def plant(self, edits):
        """Makes the tree the sources with these pairs of an edit and its new text."""
        texts = {}
        for edit, new in [(edit, edit["new"]) for edit in self.setup] + edits:
            file = edit["file"]
            texts[file] = edited(texts.get(file) or (ROOT / file).read_text(), edit, new)
        for file, text in texts.items():
            (self.tree / file).write_text(text)
        return texts

    def restore(self, texts):
        for file in texts:
            shutil.copy(ROOT / file, self.tree / file)

    def check(self, fault, number):
        """Whether the check that `fault` names notices what is planted, and what it printed. Missing: it is skipped."""
        name, it = self.check_of(fault)
        status, text = self.run(self.checks[name], SECONDS, it=it, number=number)
        if status == SKIPPED:
            raise Missing(f"{self.name}: {text}")
        return status is not None and status != self.passes, text

    def missed(self, chosen):
        """The faults that are not found. TableError where a check fails without one; Missing."""
        if absent := [program for program in self.needs if not shutil.which(program)]:
            raise Missing(f"{self.name}: needs {' '.join(absent)}")
        self.scratch.mkdir(parents=True, exist_ok=True)
        refresh(ROOT, self.tree, LEFT_OUT)
        if not (self.tree / "vectors").is_symlink():
            (self.tree / "vectors").symlink_to(ROOT / "vectors")
        numbered = list(enumerate(self.faults, 1))
        choices = [(f, f"(hmlfc_pkg::fault == {n} ? {f['new']} : {f['old']})") for n, f in numbered]
        self.plant(choices if self.switch else [])
        self.build_tree()
        for fault in {self.check_of(fault): fault for fault in chosen}.values():
            noticed, text = self.check(fault, 0)
            if noticed:
                raise TableError(f"{self.name}: {self.check_of(fault)} fails without a fault:\n{text}")
        return [fault for number, fault in numbered if fault in chosen and not self.found(fault, number)]

    def found(self, fault, number):
        """Plants one fault, says whether it is found, and takes it out again."""
        texts = {} if self.switch else self.plant([(fault, fault["new"])])
        try:
            if texts:
                self.build_tree()
            noticed, text = self.check(fault, number)
        finally:
            self.restore(texts)
        print(f"{self.name} {number}: {'found' if noticed else 'MISSED'}: {fault['is']} ({self.check_of(fault)[1]})", flush=True)
        (self.scratch / f"{number}.txt").write_text(text)
        return noticed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tables", nargs="*", metavar="TABLE")
    parser.add_argument("--build", type=lambda text: Path(text).resolve())
    parser.add_argument("--only", default="", help="faults whose description has this text")
    parser.add_argument("--texts", action="store_true", help="whether every table fits the sources")
    options = parser.parse_args()
    names = options.tables or sorted(path.stem for path in FOLDER.glob("*.toml"))
    if not options.texts and not options.build:
        parser.error("--build is needed")
    missed = []
    try:
        for table in [Table(name, options.build) for name in names]:
            table.check_texts()
            if not options.texts:
                missed += table.missed([fault for fault in table.faults if options.only in fault["is"]])
    except TableError as error:
        print(error)
        return 1
    except Missing as reason:
        print(reason)
        return SKIPPED
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
