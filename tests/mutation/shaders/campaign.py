#!/usr/bin/env python3
"""Mutants of the shaders: changes one place of a shader, compiles it as the build does, and lets the
GPU decoder decode the conformance vectors with it; with --renderer, the GPU renderer draw frames. A
mutant that no vector or no frame tells from the shader survives, and is printed.

A mutant that compiles to the same code in every variant that is used is equivalent; so is one of
equivalent.json (renderer.json), which states why nothing can tell it. A process each: one that crashes (an
access past a buffer does) or takes too long is killed, and counted by name. Mutants that do not
compile are left out.

Exit: 0 all killed or equivalent, 1 some survived or the shaders as they are fail, 2 wrong usage, 77
no shader compiler or no device.
"""

import argparse
import itertools
import json
import re
import shutil
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[2]
sys.path.insert(0, str(FOLDER.parent))

import session  # noqa: E402  (its folder is known only now)
from changes import KINDS, mutants_of  # noqa: E402
from mutants import reasons_of, shuffled  # noqa: E402
from session import SKIPPED, Broken, Unusable, Verdict  # noqa: E402
from tools import Compiler, Program, prepare_device  # noqa: E402

SHADERS = ROOT / "gpu_ref/shaders"
# Included by kernels, but generated, or of what programs record.
LEFT_OUT = {"hmlfc_tables.glsl", "shared_numbers.glsl", "texels.glsl"}
BOTH = ("false", "true")


@dataclass(frozen=True)
class Subject:
    """What is mutated."""

    kernels: tuple
    left_out: frozenset  # files that they include
    constants: tuple  # of the variants that are run
    runs: tuple  # options of the program
    reasons: str
    lines: tuple = ()  # pairs of a file and what a line of it that is mutated has; of other files all are


# The decoder leaves kStages and kCounted off.
DECODER = Subject(
    ("expand", "walk", "residuals", "samples", "colour"),
    frozenset(LEFT_OUT | {"frame.glsl", "frame_arguments.glsl"}),
    tuple(f"0:{chunked} 1:{pass_} 2:false 3:false" for chunked in BOTH for pass_ in BOTH),
    # Chunks are so small that most vectors' streams and reference areas are in several.
    ((), ("--chunk-bytes", "1024")),
    "equivalent.json",
)
# Groups of vectors, those first that tell most mutants by a stream.
GROUPS = ["stress", "error", "boundary", "real", "syntax", "performance"]


def included(file, seen=None):
    """The files that `file` includes, itself too."""
    seen = set() if seen is None else seen
    if file not in seen:
        seen.add(file)
        for name in re.findall(r'^#include "([^"]+)"', (SHADERS / file).read_text(), re.MULTILINE):
            included(name, seen)
    return seen


@cache
def kernels_by_file(subject):
    """For each source that is mutated, the kernels that include it."""
    kernels = {}
    for kernel in subject.kernels:
        for file in included(f"{kernel}.comp") - subject.left_out:
            kernels.setdefault(file, []).append(kernel)
    return kernels


# What the decoder has, too, is mutated there, but for the lines that are for frames.
RENDERER = Subject(
    ("surface", "mark", "compact", "walk", "samples", "render"),
    frozenset((LEFT_OUT | set(kernels_by_file(DECODER))) - {"samples.comp"}),
    tuple(f"0:{chunked} 1:false 2:false 3:true 4:{chunked} 5:{geometry} 6:false" for chunked in BOTH for geometry in BOTH),
    ((),),
    "renderer.json",
    (("samples.comp", "frame()"), ("samples.comp", "kCounted"), ("samples.comp", "note_error")),
)


def all_mutants(subject):
    partly = {file for file, _ in subject.lines}
    return [
        mutant
        for file in sorted(kernels_by_file(subject))
        for mutant in mutants_of(file, (SHADERS / file).read_text())
        if file not in partly or any(file == name and text in mutant.code for name, text in subject.lines)
    ]


def drawn(mutants, seed):
    """`mutants`, shuffled by the seed, one of each kind in turn."""
    order = shuffled(mutants, lambda m: f"{seed} {m.file} {m.begin} {m.kind} {m.new}")
    queues = [[mutant for mutant in order if mutant.kind == kind] for kind in KINDS]
    while any(queues):
        for queue in queues:
            if queue:
                yield queue.pop(0)


class Campaign:
    """Judges mutants of `subject` by `program`."""

    def __init__(self, subject, program, work):
        self.subject, self.program, self.work = subject, program, work
        self.compiler = Compiler(ROOT, subject.constants)
        self.base = {}
        self.known = {}
        for kernel in subject.kernels:
            spirv = work / f"{kernel}.spv"
            if not self.compiler.compile(SHADERS, kernel, spirv):
                raise Broken(f"{kernel}.comp does not compile")
            self.base[kernel] = self.compiler.variants(spirv)
        for options in subject.runs:
            program.measure(options)

    def compiles(self, mutant):
        return self.compiled(mutant) is not None

    def those_that_compile(self, mutants, jobs):
        """Those of the iterator `mutants`, in their order."""
        with ThreadPoolExecutor(jobs) as pool:
            while some := list(itertools.islice(mutants, 2 * jobs)):
                yield from (mutant for mutant, good in zip(some, pool.map(self.compiles, some)) if good)

    def judge(self, mutant):
        """The verdict on a mutant."""
        kernels = self.compiled(mutant)
        if kernels is None:
            return Verdict("not compiled")
        changed = {name: file for name, file in kernels.items() if self.compiler.variants(file) != self.base[name]}
        if not changed:
            return Verdict("same code")
        verdicts = (self.program.run(changed, options) for options in self.subject.runs)
        return next((v for v in verdicts if v.result != "survived"), Verdict("survived"))

    def compiled(self, mutant):
        """The SPIR-V files of the kernels that have the mutant, by name; None: one does not compile."""
        if mutant not in self.known:
            self.known[mutant] = self.compile(mutant, Path(tempfile.mkdtemp(dir=self.work)))
        return self.known[mutant]

    def compile(self, mutant, folder):
        shaders = shutil.copytree(SHADERS, folder / "shaders")
        text = (SHADERS / mutant.file).read_text()
        (shaders / mutant.file).write_text(mutant.apply(text))
        kernels = {name: folder / f"{name}.spv" for name in kernels_by_file(self.subject)[mutant.file]}
        good = all(self.compiler.compile(shaders, name, file) for name, file in kernels.items())
        shutil.rmtree(shaders)
        return kernels if good else None


def vectors_in_order(suite):
    """Ids of the vectors that reach a shader, those that tell most mutants first."""
    manifest = json.loads((suite / "manifest.json").read_text())
    vectors = [v for v in manifest["vectors"] if v["expect"].get("operation") != "open"]
    vectors.sort(key=lambda v: (GROUPS.index(v["group"]), v["id"]))
    return [v["id"] for v in vectors]


def decoder(program, vectors):
    """decode_vectors on these vectors."""
    return Program(program, ROOT / "vectors", *(word for vector in vectors for word in ("--vector", vector)))


def run(parser, options, work):
    """The results, or None where the mutants are only listed."""
    subject = RENDERER if options.renderer else DECODER
    mutants = all_mutants(subject)
    reasons = reasons_of(json.loads((FOLDER / subject.reasons).read_text()), mutants)
    prepare_device(work)
    if options.renderer:
        program = Program(options.program)
    else:
        program = decoder(options.program, vectors_in_order(ROOT / "vectors"))
    campaign = Campaign(subject, program, Path(work))
    compiling = campaign.those_that_compile(drawn(mutants, options.seed), options.jobs)
    chosen = session.selected(parser, options, mutants, compiling)
    if options.list:
        return print(*chosen, sep="\n")
    return session.run(chosen, campaign.judge, reasons, options)


def main():
    parser = argparse.ArgumentParser(prog="./run mutate shaders", description=__doc__)
    session.add_arguments(parser, 200)
    parser.add_argument("--renderer", action="store_true", help="of the renderer's kernels")
    parser.add_argument("--program", type=Path, required=True, help=argparse.SUPPRESS)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        try:
            results = run(parser, options, work)
        except (Unusable, Broken) as reason:
            print(reason, file=sys.stderr)
            return SKIPPED if isinstance(reason, Unusable) else 1
    if results is None:
        return 0
    session.report(results, lambda mutant: mutant.kind)
    return session.exit_status(results)


if __name__ == "__main__":
    sys.exit(main())
