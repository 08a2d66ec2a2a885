#!/usr/bin/env python3
"""The mutants of a source, what a campaign says of changes whose outcome is known, and a small campaign."""

import itertools
import unittest

import mutate  # makes the folders of the others known
from changes import KINDS, Source, mutants_of
from mutants import Mutant
from suite import Suite

SOURCE = '''\
"""1 + 1"""
def f(a, b, *c):
    """2 < 3"""
    if (a) < b and not c:  # 4
        return -min(a, 1)
    for x in c:
        require(x in a, "bad_mode")
        require(x is b, "bad_levels")
        b -= x[True]
    return [clamp(g(a, b), 0, b) for x in c if x]
'''
CHANGES = {
    "comparison": ["< -> <=", "< -> >=", "in -> not in", "is -> is not"],
    "operator": ["and -> or", "not c -> (c)", "-min(a, 1) -> (min(a, 1))", "-= -> +="],
    "constant": ["1 -> 2", "1 -> 0", "True -> False", "0 -> 1", "0 -> (-1)"],
    "condition": [
        *("(a) < b and not c -> (not ((a) < b and not c))", "(a) < b and not c -> True"),
        *("(a) < b and not c -> False", "(a) < b -> True", "not c -> True"),
        *("x -> (not (x))", "x -> True", "x -> False"),
    ],
    "statement": [
        *("return -min(a, 1) -> pass", 'require(x in a, "bad_mode") -> pass', "b -= x[True] -> pass"),
        'require(x is b, "bad_levels") -> pass',
    ],
    "argument": ["g(a, b), 0 -> 0, g(a, b)", "0, b -> b, 0", "a, b -> b, a"],
    "clamp": [
        *("min -> max", "min(a, 1) -> (a)", "min(a, 1) -> (1)", "clamp(g(a, b), 0, b) -> (g(a, b))"),
        *("clamp(g(a, b), 0, b) -> max(g(a, b), 0)", "clamp(g(a, b), 0, b) -> min(g(a, b), b)"),
    ],
    "order": [
        'require(x in a, "bad_mode") require(x is b, "bad_levels") -> '
        'require(x is b, "bad_levels") require(x in a, "bad_mode")'
    ],
}
VECTORS = ["syntax/depth-8", "error/reference-late-block"]
# Any block with a wrong step fails all blocks of the tile.
ALL_HEADERS = """lengths = []
    ahead = Cursor(head.record, head.block_headers)
    for _ in range(bin(head.residual_mask).count("1")):
        ahead.skip(head.level_bits)
        require(head.step_base + ahead.take(head.step_bits) <= GREATEST_STEP_CODE, "bad_levels")
        ahead.skip(head.bias_bits)"""
# File, old text, new text, result and detail: of changes that only VECTORS are tried on.
CASES = [
    ("residual.py", "value - (levels >> 1)", "value + (levels >> 1)", "killed", "syntax/depth-8"),
    ("integers.py", "lo if x < lo", "lo if x <= lo", "survived", ""),
    ("residual.py", "lengths = []", ALL_HEADERS, "killed", "error/reference-late-block by block"),
    ("colour.py", "t = y - (cg >> 1)", "t = y - (cg >> one)", "crash", "syntax/depth-8"),
    ("colour.py", "t = y - (cg >> 1)", "t = y\n    while t == y: pass", "timeout", "syntax/depth-8"),
    ("colour.py", "t = y - (cg >> 1)", "t = bytes(2**40)", "crash", "syntax/depth-8"),
    ("colour.py", "t = y - (cg >> 1)", "t = y - (cg >> 1", "not compiled", ""),
    ("groups.py", "from integers import ceil_div", "import nothing", "crash", "error/reference-late-block"),
]


class ChangesTest(unittest.TestCase):
    def test_places_and_kinds(self):
        found = {kind: [] for kind in KINDS}
        for mutant in mutants_of("f.py", SOURCE):
            found[mutant.kind].append(mutant.change())
            compile(mutant.apply(SOURCE), "f.py", "exec")
        for kind in KINDS:
            self.assertCountEqual(found[kind], CHANGES[kind], kind)

    def test_sites(self):
        source = Source("f.py", SOURCE)
        sites = {(m.change(), source.site(m)) for m in mutants_of("f.py", SOURCE)}
        for change, line in (("and -> or", 4), ("1 -> 2", 5), ("True -> False", 9), ("0 -> 1", 10)):
            self.assertIn((change, line), sites)
        constant = mutants_of("g.py", "A = 1\n")[0]
        self.assertIsNone(Source("g.py", "A = 1\n").site(constant))

    def test_letters_beyond_ascii_are_refused(self):
        with self.assertRaisesRegex(ValueError, "f.py"):
            mutants_of("f.py", "a = '\u00e9' + b\n")

    def test_choice(self):
        mutants = mutate.all_mutants()
        few, more = (list(itertools.islice(mutate.drawn(mutants, 5), count)) for count in (100, 200))
        self.assertEqual(more[:100], few)
        self.assertNotEqual(few, list(itertools.islice(mutate.drawn(mutants, 6), 100)))
        self.assertEqual({mutant.kind for mutant in few}, set(KINDS))


class CampaignTest(unittest.TestCase):
    def test_outcomes_that_are_known(self):
        judge = mutate.Judge(Suite(VECTORS))
        for file, old, new, result, detail in CASES:
            text = mutate.text_of(file)
            mutant = Mutant.of("statement", file, text, text.index(old), old, new)
            verdict = judge.of_mutant(mutant)
            self.assertEqual((verdict.result, verdict.detail), (result, detail), str(mutant))

    def test_reasons_fit_the_decoder(self):
        self.assertTrue(all(mutate.equivalents(mutate.all_mutants()).values()))

    def test_a_small_campaign(self):
        mutants = mutate.all_mutants()
        reasons, judge = mutate.equivalents(mutants), mutate.Judge(Suite())
        chosen = itertools.islice((m for m in mutate.drawn(mutants, 1) if m not in reasons), 24)
        for mutant in chosen:
            self.assertIn(judge.of_mutant(mutant).result, mutate.session.KILLED, str(mutant))


if __name__ == "__main__":
    unittest.main()
