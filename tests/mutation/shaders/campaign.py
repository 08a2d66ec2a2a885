#!/usr/bin/env python3
"""Mutants of the decode shaders: changes one place of a shader, compiles it as the build does, and
lets the GPU decoder decode the conformance vectors with it. A mutant that no vector tells from the
shader survives, and is printed.

A mutant that compiles to the same code in every variant that decoding uses is equivalent; so is one
of equivalent.json, which states why no stream can tell it. A process each: one that crashes (an
access past a buffer does) or takes too long is killed, and counted by name.

Exit: 0 all killed or equivalent, 1 some survived or the shaders as they are fail, 2 wrong usage, 77
no shader compiler or no device.
"""

import argparse
import json
import os
import shutil
import sys
import tempfile
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock

from mutants import KERNELS, draw, kernels_by_file
from report import counts_of, exit_status, report_json, report_text
from tools import SKIPPED, Broken, Compiler, Decoder, Unusable, Verdict, prepare_device

# Both of kChunked and kReferencePass; decoding leaves kStages and kCounted off.
VARIANTS = ["0:false 1:false", "0:true 1:false", "0:false 1:true", "0:true 1:true"]
# Small enough that most vectors' streams and reference areas are in several chunks.
CHUNK_BYTES = 1024
# Groups of vectors, those first that tell most mutants by a stream.
GROUPS = ["stress", "error", "boundary", "real", "syntax", "performance"]


class Campaign:
    """Judges mutants of the shaders of `root`."""

    def __init__(self, root, decoder, work, chunks=True):
        self.shaders = root / "gpu_ref" / "shaders"
        self.compiler = Compiler(root)
        self.decoder, self.work, self.chunks = decoder, work, chunks
        self.kernels = kernels_by_file(self.shaders)
        self.reasons = read_reasons(Path(__file__).with_name("equivalent.json"))
        self.base, self.base_variants = {}, {}
        for kernel in KERNELS:
            self.base[kernel] = work / f"{kernel}.spv"
            if not self.compiler.compile(self.shaders, kernel, self.base[kernel]):
                raise Broken(f"{kernel}.comp does not compile")
        self.lock, self.chunks_measured = Lock(), False
        decoder.measure([])

    def judge(self, mutant):
        """The verdict on a mutant."""
        with tempfile.TemporaryDirectory(dir=self.work) as name:
            folder = Path(name) / "shaders"
            shutil.copytree(self.shaders, folder)
            source = (self.shaders / mutant.file).read_text()
            (folder / mutant.file).write_text(mutant.apply(source))
            changed = {}
            for kernel in self.kernels[mutant.file]:
                out = Path(name) / f"{kernel}.spv"
                if not self.compiler.compile(folder, kernel, out):
                    return Verdict("not_compiled")
                if out.read_bytes() != self.base[kernel].read_bytes():
                    changed[kernel] = out
            if not changed:
                return Verdict("equivalent", "the same SPIR-V")
            return self.judge_kernels(mutant, source, changed)

    def judge_kernels(self, mutant, source, changed):
        verdict = self.decoder.run(changed)
        if verdict.result == "survived" and self.same_variants(changed):
            return Verdict("equivalent", "the same SPIR-V in all variants that decode")
        if verdict.result == "survived" and self.chunks:
            verdict = self.judge_chunks(changed)
        reason = self.reasons.get(place_of(mutant, source))
        if verdict.result == "survived" and reason:
            return Verdict("equivalent", reason)
        return verdict

    def judge_chunks(self, changed):
        options = ["--chunk-bytes", str(CHUNK_BYTES)]
        with self.lock:
            if not self.chunks_measured:
                self.decoder.measure(options)
            self.chunks_measured = True
        return self.decoder.run(changed, *options)

    def same_variants(self, changed):
        return all(
            self.compiler.variant(spirv, constants) == self.base_variant(kernel, constants)
            for kernel, spirv in changed.items()
            for constants in VARIANTS
        )


    def base_variant(self, kernel, constants):
        """The code of the kernel as it is; made when it is first wanted."""
        if (kernel, constants) not in self.base_variants:
            folder = Path(tempfile.mkdtemp(dir=self.work))
            copy = shutil.copy(self.base[kernel], folder)
            self.base_variants[kernel, constants] = self.compiler.variant(Path(copy), constants)
        return self.base_variants[kernel, constants]


def place_of(mutant, source):
    """What names a mutant in equivalent.json: its file, line of code and column, and the change."""
    line = source.splitlines()[mutant.line - 1]
    column = mutant.begin - source.rfind("\n", 0, mutant.begin) - 1
    change = mutant.name().split(": ", 2)[2]
    return (mutant.file, line.strip(), column, change)


def read_reasons(path):
    """Why each listed mutant is equivalent, by its place."""
    return {
        (entry["file"], entry["code"], entry["column"], entry["change"]): entry["reason"]
        for entry in json.loads(path.read_text())
    }


def vectors_in_order(suite):
    """Ids of the vectors that reach a shader, those that tell most mutants first."""
    manifest = json.loads((suite / "manifest.json").read_text())
    vectors = [v for v in manifest["vectors"] if v["expect"].get("operation") != "open"]
    vectors.sort(key=lambda v: (GROUPS.index(v["group"]), v["id"]))
    return [v["id"] for v in vectors]


def run_all(campaign, mutants, count, jobs, tell):
    """(mutant, verdict) of the first `count` mutants that compile, and those before that do not, in
    the order of `mutants`."""
    results, waiting = [], deque()
    compiled = 0
    with ThreadPoolExecutor(jobs) as pool:
        for mutant in mutants:
            waiting.append((mutant, pool.submit(campaign.judge, mutant)))
            while waiting and (len(waiting) == jobs or compiled + len(waiting) == count):
                done, future = waiting.popleft()
                results.append((done, future.result()))
                compiled += results[-1][1].result != "not_compiled"
                tell(compiled, results)
            if compiled == count:
                return results
        results += [(mutant, future.result()) for mutant, future in waiting]
    return results


def positive(text):
    """A whole number from 1 on."""
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 1 on")
    return int(text)


def arguments():
    parser = argparse.ArgumentParser(prog="./run mutate shaders", description=__doc__)
    parser.add_argument("--count", type=positive, default=200, help="mutants that compile (200)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, another choice (1)")
    parser.add_argument("--json", action="store_true", help="every mutant and its end, as JSON")
    parser.add_argument("--verbose", action="store_true", help="each mutant's end on stderr")
    parser.add_argument("-j", "--jobs", type=positive, default=os.cpu_count(), help="at a time")
    parser.add_argument("--program", type=Path, required=True, help=argparse.SUPPRESS)
    return parser.parse_args()


def progress(compiled, results):
    if sys.stderr.isatty():
        survived = counts_of(results)["survived"]
        print(f"\r\033[K{compiled} mutants, {survived} survived", end="", file=sys.stderr)


def print_verdict(compiled, results):
    mutant, verdict = results[-1]
    line = f"{compiled} {mutant.name()}: {verdict.result} {verdict.detail}"
    print(line.rstrip(), file=sys.stderr, flush=True)


def main():
    args = arguments()
    root = Path(__file__).resolve().parents[3]
    with tempfile.TemporaryDirectory() as work:
        prepare_device(work)
        decoder = Decoder(args.program, root / "vectors", vectors_in_order(root / "vectors"))
        try:
            campaign = Campaign(root, decoder, Path(work))
            mutants = draw(campaign.shaders, args.seed)
            tell = print_verdict if args.verbose else progress
            results = run_all(campaign, mutants, args.count, args.jobs, tell)
        except Unusable as reason:
            print(reason, file=sys.stderr)
            return SKIPPED
        except Broken as reason:
            print(reason, file=sys.stderr)
            return 1
    if sys.stderr.isatty() and not args.verbose:
        print(file=sys.stderr)
    text = report_json if args.json else report_text
    print(text(results, args.seed))
    return exit_status(results)


if __name__ == "__main__":
    sys.exit(main())
