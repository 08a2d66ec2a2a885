#!/usr/bin/env python3
"""driver_mutants_test.py CC DRIVER_TESTS VIEW_TESTS [--count N]: the tests of the C driver notice small changes of it.

A mutant is one changed operator or constant of rtl/driver, but hmlfc_openjpeg.c. It is compiled into a library that takes the place of the
driver in both test programs, one of which must fail. N mutants, or all with 0, in an order that does not change.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
DRIVER = HERE.parents[1] / "rtl" / "driver"
sys.path[:0] = [str(HERE.parent / "mutation"), str(HERE.parent / "mutation" / "model")]

from cpp import mutants_of  # noqa: E402  (its folder is known only now)
from mutants import reasons_of, shuffled  # noqa: E402

SECONDS = 60
VIEW_FILTER = "--gtest_filter=" + ":".join(f"Seed/ViewDma.EqualsTheModel/{seed}" for seed in (1, 2, 3))


def comment_lines(text):
    """Numbers of the lines of comments that stand alone."""
    lines = set()
    for comment in re.finditer(r"^[ ]*/\*.*?\*/", text, re.S | re.M):
        first = text.count("\n", 0, comment.start()) + 1
        lines.update(range(first, first + comment.group().count("\n") + 1))
    return lines


def all_mutants(sources):
    files = [file for file in sources if file != "hmlfc_openjpeg.c"]
    return [mutant for file in files for mutant in mutants_of(file, sources[file], comment_lines(sources[file]))]


class Judge:
    def __init__(self, options, sources, scratch):
        self.options, self.sources, self.scratch = options, sources, Path(scratch)
        flags = subprocess.run(["pkg-config", "--cflags", "libopenjp2"], capture_output=True, text=True, check=True)
        self.compile = [options.cc, "-std=c99", "-O1", "-w", "-fPIC", "-ftrapv", f"-I{DRIVER}", *flags.stdout.split()]
        self.objects = {}
        for file in sources:
            self.objects[file] = self.scratch / f"{file}.o"
            subprocess.run([*self.compile, "-c", DRIVER / file, "-o", self.objects[file]], check=True)

    def library(self, name, file=None, text=None):
        """The driver, with `text` in the place of a file; None where it does not compile."""
        objects = dict(self.objects)
        if file is not None:
            source = self.scratch / f"{name}.c"
            source.write_text(text)
            objects[file] = self.scratch / f"{name}.o"
            if subprocess.run([*self.compile, "-c", source, "-o", objects[file]], capture_output=True).returncode:
                return None
        library = self.scratch / f"{name}.so"
        subprocess.run([self.options.cc, "-shared", "-o", library, *objects.values(), "-lopenjp2"], check=True)
        return library

    def passes(self, library):
        environment = {**os.environ, "LD_PRELOAD": str(library)}
        for command in ([self.options.driver_tests], [self.options.view_tests, VIEW_FILTER]):
            try:
                options = {"capture_output": True, "env": environment, "timeout": SECONDS}
                done = subprocess.run([*command, "--gtest_fail_fast"], **options)
                if done.returncode or b"[  PASSED  ] 0 tests" in done.stdout:
                    return False
            except subprocess.TimeoutExpired:
                return False
        return True

    def verdict(self, number, mutant):
        library = self.library(f"m{number}", mutant.file, mutant.apply(self.sources[mutant.file]))
        if library is None:
            return "not compiled"
        survived = self.passes(library)
        library.unlink()
        return "survived" if survived else "killed"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cc")
    parser.add_argument("driver_tests")
    parser.add_argument("view_tests")
    parser.add_argument("--count", type=int, default=24)
    options = parser.parse_args()
    sources = {file.name: file.read_text() for file in sorted(DRIVER.glob("*.c"))}
    mutants = all_mutants(sources)
    reasons = reasons_of(json.loads((HERE / "driver_equivalents.json").read_text()), mutants)
    mutants = shuffled(mutants, lambda mutant: f"{mutant.file} {mutant.code} {mutant.change()}")
    chosen = mutants[: options.count or len(mutants)]
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(2) as pool:
        judge = Judge(options, sources, scratch)
        assert judge.passes(judge.library("same")), "the driver fails as it is"
        counts = {}
        for mutant, verdict in zip(chosen, pool.map(judge.verdict, range(len(chosen)), chosen)):
            if verdict == "survived" and mutant in reasons:
                verdict = "equivalent"
            counts[verdict] = counts.get(verdict, 0) + 1
            if verdict == "survived":
                print(f"survived: {mutant}    {mutant.code}", flush=True)
    print(f"{len(chosen)} of {len(mutants)} mutants: " + ", ".join(f"{counts[key]} {key}" for key in sorted(counts)))
    sys.exit(1 if counts.get("survived") else 0)


if __name__ == "__main__":
    main()
