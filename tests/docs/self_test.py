#!/usr/bin/env python3
"""Each fault planted in a document is found: a command that fails, a changed number, a rule without use.

usage: self_test.py ROOT HMLFC
"""

import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import check_rules
import document
import label_costs
import links
import rules
import run_document
from sandbox import CPU_LIMIT, Sandbox

ROOT, HMLFC = (Path(argument).absolute() for argument in sys.argv[1:3])
INFO = "./run info vectors/real/cards-main.hmlfc"
GOOD = f"""# Page 12

```
{INFO}     # a comment
```

Views are 40 pixels wide:

```text from="Light field" to="Light field"
OUTPUT
```
"""


class RunTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.root = cls.folder / "root"
        (cls.root / "docs").mkdir(parents=True)
        build = HMLFC.parents[1]
        cls.sandbox = Sandbox(cls.folder / "sandbox", ROOT, build, HMLFC)
        cls.good = GOOD.replace("OUTPUT", cls.sandbox.run(INFO).stdout.splitlines()[0])

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def complaints(self, text, name="docs/page.md", updating=False):
        (self.root / name).write_text(text, encoding="utf-8")
        return run_document.check(self.root, self.sandbox, name, updating)[0]

    def assert_found(self, text, expected, name="docs/page.md"):
        found = self.complaints(text, name)
        self.assertEqual(len(found), 1, found)
        self.assertIn(expected, found[0])

    def test_true_page_passes(self):
        self.assertEqual(self.complaints(self.good), [])

    def test_broken_commands_are_found(self):
        self.assert_found("```\n./run encoed FOLDER -o x.hmlfc\n```\n", "page.md:2: exit status")
        self.assert_found("```\n./run encode FOLDER --nosuch 1 -o x.hmlfc\n```\n", "page.md:2: exit status 2")
        self.assert_found("See `./run bench nosuch`.\n", "page.md:1: exit status 2")
        self.assert_found("```\nhmlfc info nosuch.hmlfc\n```\n", "exit status 3")
        self.assert_found("Run `./run test -L nosuch-label`.\n", "./run test")
        self.assert_found("Run `./run coverage --nosuch`.\n", "./run coverage --help has no --nosuch")

    def test_expensive_command_is_found(self):
        self.assertNotEqual(self.sandbox.run("ulimit -t 1; while :; do :; done").returncode, 0)
        self.assertEqual(self.sandbox.run("ulimit -t").stdout, f"{CPU_LIMIT}\n")

    def test_changed_number_is_found(self):
        self.assertIn("40", self.good.splitlines()[-2])
        changed = self.good.splitlines()
        changed[-2] = changed[-2].replace("40", "41")
        self.assert_found("\n".join(changed), "the output is now")

    def test_missing_line_and_limits_are_found(self):
        lines = self.good.splitlines()
        self.assert_found("\n".join([*lines[:-2], lines[-1]]), "the output is now")
        self.assert_found(self.good.replace('from="Light field"', 'from="nosuch"'), "has no lines")

    def test_update_makes_the_page_true(self):
        stale = self.good.replace(self.good.splitlines()[-2], "stale")
        self.assertEqual(self.complaints(stale, updating=True), [])
        self.assertEqual((self.root / "docs/page.md").read_text(encoding="utf-8"), self.good)

    def test_number_of_the_text_that_no_output_has_is_found(self):
        name = run_document.CLOSED[0]
        page = self.good.replace("Page 12", "Page of BISE-12")
        self.assertEqual(self.complaints(page, name), [])
        self.assert_found(page.replace("are 40", "are 48"), "48 is in no output", name)


class StaticTest(unittest.TestCase):
    def test_rule_without_use_is_found(self):
        self.assertEqual(len(check_rules.unused([])), len(rules.WORDS) + len(rules.COMMANDS))

    def test_named_only_command_has_to_be_in_the_usage(self):
        self.assertIs(rules.substitute("./run demo")[0], rules.NAMED_ONLY)

    def test_commands_of_all_forms_are_found(self):
        text = ("```\n./run a \\\n  b\nhmlfc c  # d\n```\nSee `./run e\\|f`.\n"
                "```\nx = pseudo code\n```\n```json\n./run g\n```\n")
        found = [command.text for command in document.commands(text.splitlines(), "page.md")]
        self.assertEqual(found, ["./run a b", "hmlfc c", "./run e|f"])
        workflow = "jobs:\n  - run: ./run test\n  - run: |\n      cmake --preset asan\n"
        found = [command.text for command in document.commands(workflow.splitlines(), "x.yml")]
        self.assertEqual(found, ["./run test", "cmake --preset asan"])

    def test_line_that_is_no_command_is_found(self):
        for text in ("```\n./run a\nrm b\n```", "```text\nx\n```", "```\n./run a"):
            with self.assertRaises(document.DocumentError):
                list(document.commands(text.splitlines(), "page.md"))

    def test_dead_links_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "model").mkdir()
            (root / "model/a_file.cpp").touch()
            (root / "b.md").write_text("# Some *Head*, here\n", encoding="utf-8")
            good = "[b](b.md#some-head-here) `model/a_file.cpp` `model/NAME.cpp` [x](https://x)\n# c\n[c](#c)\n"
            for text, count in ((good, 0), ("[b](no.md)", 1), ("[b](b.md#no)", 1), ("`model/no.cpp`", 1)):
                (root / "a.md").write_text(text, encoding="utf-8")
                self.assertEqual(len(list(links.dead(root, "a.md"))), count, text)

    def test_costs_of_labels(self):
        table = "| a, b | proves | |\n| c | more | 7 |\n"
        self.assertEqual(label_costs.missing(table, ["a", "d", "c"]), ["d"])
        seconds, labels = {"x": 1.5, "y": 2.0, "z": 9.0}, {"x": ["a", "b"], "y": ["a"], "z": ["d"]}
        self.assertEqual(label_costs.updated(table, seconds, labels), "| a, b | proves | 4 |\n| c | more | |\n")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "junit.xml"
            path.write_text('<testsuite><testcase name="x" time="1.5"/></testsuite>', encoding="utf-8")
            self.assertEqual(label_costs.times(path), {"x": 1.5})

    def test_long_readme_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "docs").mkdir()
            (Path(folder) / "README.md").write_text("word\n" * (check_rules.README_LINES + 1), encoding="utf-8")
            self.assertEqual(len(list(check_rules.sizes(Path(folder)))), 1)
            (Path(folder) / "docs/a.md").write_text("word " * (check_rules.WORDS - check_rules.README_LINES), encoding="utf-8")
            self.assertEqual(len(list(check_rules.sizes(Path(folder)))), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
