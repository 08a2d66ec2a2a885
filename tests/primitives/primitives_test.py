"""The golden model and the naive decoder agree on every case of `hmlfc primitives`, and the cases with
their results are those whose SHA-256 recorded_sums.json has.

primitives_test.py PROGRAM VERSION --record writes that file anew: only where cases are meant to change.
"""

import hashlib
import json
import re
import subprocess
import sys
from pathlib import Path

from primitives_case import ANSWERS, DIFFERENT, DONE, ROOT, USAGE, PrimitivesTest, answered, main
from program import PROGRAM

RECORD = Path(__file__).with_name("recorded_sums.json")
FIXED_RANGE = re.compile(r"\[(-?\d+), (-?\d+)\]")


class Primitives(PrimitivesTest):
    @classmethod
    def prepare(cls):
        cls.list = cls.hmlfc_json("primitives", "list")

    def test_naive_decoder_agrees(self):
        sums = {}
        for primitive in self.list:
            name = primitive["name"]
            with self.subTest(primitive=name):
                lines = self.agree(name)
                self.assertEqual(len(lines), primitive["cases"])
                sums[name] = hashlib.sha256("".join(line + "\n" for line in lines).encode()).hexdigest()
        if "--record" in sys.argv:
            RECORD.write_text(json.dumps(sums, indent=2) + "\n")
        self.assertEqual(sums, json.loads(RECORD.read_text()))

    def test_list(self):
        self.assertEqual([primitive["name"] for primitive in self.list], list(ANSWERS))
        text = self.hmlfc("primitives", "list")
        clauses = set(re.findall(r"^\*\*\[(\w+-\d+)\]\*\*", (ROOT / "docs/specification.md").read_text(), re.MULTILINE))
        for primitive in self.list:
            self.assertRegex(text, rf"(?m)^{primitive['name']} +{primitive['cases']} .*{primitive['clauses']}$")
            self.assertLessEqual(set(primitive["clauses"].split()), clauses)
            one = self.hmlfc("primitives", "list", primitive["name"])
            for column in primitive["inputs"]:
                self.assertIn(f"  {column['name']:22} {column['range']}\n", one)

    def test_cases_reach_both_ends_of_every_range(self):
        for primitive in self.list:
            rows = [line.split() for line in self.cases(primitive["name"])]
            for at, column in enumerate(primitive["inputs"]):
                ends = FIXED_RANGE.fullmatch(column["range"])
                if ends:
                    with self.subTest(primitive=primitive["name"], column=column["name"]):
                        values = {int(row[at]) for row in rows}
                        self.assertEqual([min(values), max(values)], [int(end) for end in ends.groups()])

    def test_exhaustive_cases_are_all_there_are(self):
        expected = [f"{code} {count}" for code in range(40) for count in range(65)]
        self.assertEqual(self.cases("sequence-bits"), expected)
        self.assertEqual(len(set(self.cases("displacement"))), 2 * sum(2 * 127 * 2**p + 1 for p in range(4)))

    def test_seed_count_and_level(self):
        first = self.cases("colour")
        self.assertEqual(first, self.cases("colour", "--seed", 1))
        self.assertEqual(first[:5], self.cases("colour", "--count", 5))
        second_level = self.cases("colour", "--level", 2)
        self.assertEqual(len(second_level), 32 * len(first))
        self.assertEqual(first, second_level[: len(first)])
        other = self.cases("colour", "--seed", 2)
        self.assertLess(len(set(first) & set(other)), len(first) // 4)
        status, printed = self.check("colour", [answered("colour", case) for case in other], "--seed", 2)
        self.assertEqual((status, printed), (DONE, [f"colour: {len(other)} cases, all right"]))

    def test_pipe(self):
        for program, name in [
            ("examples/primitives.py", "colour"),
            ("examples/primitives.py", "block-number"),
            ("tests/primitives/answers.py", "field"),
        ]:
            pipe = f"'{PROGRAM}' primitives gen {name} | '{sys.executable}' -B '{ROOT / program}' {name}"
            pipe += f" | '{PROGRAM}' primitives check {name}"
            result = subprocess.run(["bash", "-o", "pipefail", "-c", pipe], capture_output=True, text=True, check=True)
            self.assertEqual(result.stderr, "")
            self.assertRegex(result.stdout, rf"^{name}: \d+ cases, all right\n$")

    def test_wrong_lines(self):
        cases = self.cases("block-number")
        right = [answered("block-number", case) for case in cases]
        for lines, says in (
            ([f"{case} 64" for case in cases], "line 1: i 0, j 0: result 1 of 1 is 64 instead of 0: k (TIL-2)"),
            (right[:-1], "the input ends before line 64"),
            (right[1:], "line 1 has to begin with"),
            ([*right, right[-1]], "there are 64 cases, but the input goes on with"),
            (cases, "0 results instead of 1"),
            (["\x1b[2J\x7f", *right], "but is '?[2J?'"),
        ):
            with self.subTest(says=says):
                status, printed = self.check("block-number", lines, "--errors", 3)
                self.assertEqual(status, DIFFERENT)
                self.assertIn(says, "\n".join(printed))
                self.assertLessEqual(len(printed), 4)

    def test_refused(self):
        for arguments, named in [
            (["gen", "color"], "one of field rank"),
            (["gen"], "NAME"),
            (["gen", "trits", "--count", 3], "trits always has all its 256 cases"),
            (["check", "trits", "--count", 3], "trits always has all its 256 cases"),
            (["gen", "colour", "--level", 3], "[1, 2]"),
            (["check", "colour", "--errors", 0], "[1, 4294967295]"),
        ]:
            with self.subTest(arguments=arguments):
                self.refused(USAGE, "primitives", *arguments, says=named)


if __name__ == "__main__":
    main()
