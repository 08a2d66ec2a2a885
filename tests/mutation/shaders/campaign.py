#!/usr/bin/env python3
"""Mutants of the decode shaders: changes one place of a shader, compiles it as the build does, and
lets the GPU decoder decode the conformance vectors with it. A mutant that no vector tells from the
shader survives, and is printed.

A mutant that compiles to the same code in every variant that decoding uses is equivalent; so is one
of equivalent.json, which states why no stream can tell it. A process each: one that crashes (an
access past a buffer does) or takes too long is killed, and counted by name. Mutants that do not
compile are left out.

Exit: 0 all killed or equivalent, 1 some survived or the shaders as they are fail, 2 wrong usage, 77
no shader compiler or no device.
"""

import argparse
import json
import re
import shutil
import sys
import tempfile
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[2]
sys.path.insert(0, str(FOLDER.parent))

import session  # noqa: E402  (its folder is known only now)
from changes import KINDS, mutants_of  # noqa: E402
from mutants import reasons_of, shuffled  # noqa: E402
from session import SKIPPED, Broken, Unusable, Verdict  # noqa: E402
from tools import Compiler, Decoder, prepare_device  # noqa: E402

SHADERS = ROOT / "gpu_ref/shaders"
# The kernels that decode; the others belong to the renderer, which has no vectors.
KERNELS = ["expand", "walk", "residuals", "samples", "colour"]
# Included by them, but generated, or of the renderer or recorded decoding, which have no vectors.
LEFT_OUT = {"hmlfc_tables.glsl", "shared_numbers.glsl", "frame.glsl", "frame_arguments.glsl", "texels.glsl"}
# Options of the decoder. Chunks are so small that most vectors' streams and reference areas are in several.
RUNS = [[], ["--chunk-bytes", "1024"]]
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
def kernels_by_file():
    """For each source that is mutated, the kernels that include it."""
    kernels = {}
    for kernel in KERNELS:
        for file in included(f"{kernel}.comp") - LEFT_OUT:
            kernels.setdefault(file, []).append(kernel)
    return kernels


def all_mutants():
    return [
        mutant
        for file in sorted(kernels_by_file())
        for mutant in mutants_of(file, (SHADERS / file).read_text())
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
    """Judges mutants of the shaders."""

    def __init__(self, decoder, work):
        self.compiler, self.decoder, self.work = Compiler(ROOT), decoder, work
        self.base = {}
        for kernel in KERNELS:
            spirv = work / f"{kernel}.spv"
            if not self.compiler.compile(SHADERS, kernel, spirv):
                raise Broken(f"{kernel}.comp does not compile")
            self.base[kernel] = self.compiler.variants(spirv)
        for options in RUNS:
            decoder.measure(options)

    def compiles(self, mutant):
        with tempfile.TemporaryDirectory(dir=self.work) as name:
            return self.changed_kernels(mutant, Path(name)) is not None

    def judge(self, mutant):
        """The verdict on a mutant."""
        with tempfile.TemporaryDirectory(dir=self.work) as name:
            changed = self.changed_kernels(mutant, Path(name))
            if changed is None:
                return Verdict("not compiled")
            if not changed:
                return Verdict("same code")
            verdicts = (self.decoder.run(changed, options) for options in RUNS)
            return next((v for v in verdicts if v.result != "survived"), Verdict("survived"))

    def changed_kernels(self, mutant, folder):
        """The SPIR-V files of the kernels that decode otherwise, by name; None: one does not compile."""
        shutil.copytree(SHADERS, folder / "shaders")
        text = (SHADERS / mutant.file).read_text()
        (folder / "shaders" / mutant.file).write_text(mutant.apply(text))
        changed = {}
        for kernel in kernels_by_file()[mutant.file]:
            out = folder / f"{kernel}.spv"
            if not self.compiler.compile(folder / "shaders", kernel, out):
                return None
            if self.compiler.variants(out) != self.base[kernel]:
                changed[kernel] = out
        return changed


def vectors_in_order(suite):
    """Ids of the vectors that reach a shader, those that tell most mutants first."""
    manifest = json.loads((suite / "manifest.json").read_text())
    vectors = [v for v in manifest["vectors"] if v["expect"].get("operation") != "open"]
    vectors.sort(key=lambda v: (GROUPS.index(v["group"]), v["id"]))
    return [v["id"] for v in vectors]


def run(parser, options, work):
    """The results, or None where the mutants are only listed."""
    mutants = all_mutants()
    reasons = reasons_of(json.loads((FOLDER / "equivalent.json").read_text()), mutants)
    prepare_device(work)
    vectors = vectors_in_order(ROOT / "vectors")
    campaign = Campaign(Decoder(options.program, ROOT / "vectors", vectors), Path(work))
    compiling = filter(campaign.compiles, drawn(mutants, options.seed))
    chosen = session.selected(parser, options, mutants, compiling)
    if options.list:
        return print(*chosen, sep="\n")
    return session.run(chosen, campaign.judge, reasons, options)


def main():
    parser = argparse.ArgumentParser(prog="./run mutate shaders", description=__doc__)
    session.add_arguments(parser, 200)
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
