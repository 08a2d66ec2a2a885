#!/usr/bin/env python3
"""Plants mutants whose end is known, and checks that the campaign says so.

Exit: 0 good, 1 not (each wrong answer is printed), 77 no shader compiler or no device.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import campaign  # makes the folders of the others known
import session
import tools
from changes import mutants_of
from mutants import Mutant

ONE_VECTOR = ["syntax/depth-8"]
ONE_CASE = ["--case", "walk-0"]  # of an intact stream
SOURCE = """#version 450
// 1 + 1
const uint kOne = 1u;
struct Pair { uint low[2]; };
uint f(uint a, int b) {
  if (a < 3u) return a >> 2;
  uint c = a + kOne;
  c = min(c, 5u);
  return c;  /* 2 - 2 */
}
"""
CHANGES = {
    ("constant", "1u", "2u"), ("constant", "1u", "0u"), ("constant", "3u", "4u"),
    ("constant", "3u", "2u"), ("constant", "5u", "6u"), ("constant", "5u", "4u"),
    ("comparison", "<", "<="), ("shift", "2", "3"), ("shift", "2", "1"),
    ("operator", ">>", "<<"), ("operator", "+", "-"), ("min_max", "min", "max"),
    ("condition", "(a < 3u)", "(!(a < 3u))"), ("statement", "c = min(c, 5u)", ""),
    ("statement", "return a >> 2", ""),
}  # fmt: skip


# File, old text, new text, and what the campaign must say of it when only ONE_VECTOR is decoded or ONE_CASE is drawn.
STATUS = "if (status == ERROR_OK) status = arguments.statuses.word[sources.cg];"
CASES = [
    ("colour.comp", STATUS, "", "survived"),
    ("colour.comp", "(at & 1u) << 4", "(at & 0u) << 4", "killed"),
    ("colour.comp", "return;", ";", "crash"),
    ("colour.comp", "lane == 0u", "lane = 0u", "not compiled"),
    ("samples.comp", "place.number * 4u", "place.number * 5u", "same code"),
]
FRAME_CASES = [
    ("samples.comp", "note_error(q)", "", "survived"),
    ("compact.comp", "kCountNextPage], 1u", "kCountNextPage], 0u", "killed"),
    ("compact.comp", "if (kGeometry)", "if (!kGeometry)", "crash"),
    ("compact.comp", "if (kGeometry)", "if (kNoSuchName)", "not compiled"),
    ("render.comp", "kTexels", "(kTexels && true)", "same code"),
]


def endless(work):
    """A program without an end. On lavapipe loops of a shader have one, after 65536 rounds."""
    program = work / "endless"
    program.write_text("#!/bin/sh\nwhile :; do :; done\n")
    program.chmod(0o755)
    return program


def wrong_verdicts(judge, cases, results):
    """One line for each; all go to `results`."""
    for file, old, new, expected in cases:
        source = (campaign.SHADERS / file).read_text()
        mutant = Mutant.of("operator", file, source, source.rindex(old), old, new)
        verdict = judge.judge(mutant)
        results.append((mutant, verdict))
        if verdict.result != expected or judge.compiles(mutant) != (expected != "not compiled"):
            yield f"{mutant}: {verdict.result} ({verdict.detail}) instead of {expected}"


def complaints(program, renderer, work):
    """One line for each wrong answer."""
    found = {(m.kind, m.old, m.new) for m in mutants_of("source", SOURCE)}
    for change in sorted(CHANGES ^ found):
        yield f"{change}: {'missed' if change in CHANGES else 'no such place'}"
    frames = tools.Program(renderer, *ONE_CASE)
    yield from wrong_verdicts(campaign.Campaign(campaign.RENDERER, frames, work), FRAME_CASES, [])
    results = []
    judge = campaign.Campaign(campaign.DECODER, campaign.decoder(program, ONE_VECTOR), work)
    yield from wrong_verdicts(judge, CASES, results)
    hung = tools.Program(endless(work))
    hung.cpu_limit = 1
    if hung.run({}).result != "timeout":
        yield "a decoder without an end is no timeout"
    if session.exit_status(results) != 1 or session.exit_status(results[1:]) != 0:
        yield "a survivor does not decide the exit status"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="decode_vectors")
    parser.add_argument("renderer", type=Path, help="draw_frames")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        tools.prepare_device(work)
        try:
            wrong = list(complaints(args.program, args.renderer, Path(work)))
        except session.Unusable as reason:
            print(reason, file=sys.stderr)
            return session.SKIPPED
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
