"""Suites and reports of others: nothing outside the folder of a report is touched."""

import json
import shutil

from conform_case import COARSE, GOLDEN, SUITE, ConformTest, main, make_suite
from program import INPUT, OUTPUT

ONE = "syntax/base-main"
PICTURES = ("expected.png", "actual.png", "difference.png")


class Foreign(ConformTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.one = cls.folder / "one"
        make_suite(cls.one, (ONE,))

    def setUp(self):
        self.mine = self.folder / "mine" / "folder"
        self.mine.mkdir(parents=True)
        (self.mine / "file").write_text("mine")
        self.addCleanup(shutil.rmtree, self.folder / "mine")

    def assert_untouched(self):
        """What is nobody's output is as it was."""
        found = sorted(path.relative_to(self.folder) for path in (self.folder / "mine").rglob("*"))
        self.assertEqual([str(path) for path in found], ["mine/folder", "mine/folder/file"])
        self.assertEqual((self.mine / "file").read_text(), "mine")

    def suite_with(self, change):
        """A suite of one vector whose entry of the manifest is changed."""
        folder = self.folder / "foreign"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.one, folder, symlinks=True)
        manifest = json.loads((folder / "manifest.json").read_text())
        change(manifest["vectors"])
        manifest["count"] = len(manifest["vectors"])
        (folder / "manifest.json").write_text(json.dumps(manifest))
        return folder


class Suites(Foreign):
    def test_names_are_no_paths(self):
        inside = str(self.mine)
        changes = {
            inside: lambda vectors: vectors[0].update(id=inside),
            "mine/folder": lambda vectors: vectors[0].update(id="../../../mine/folder"),
            "syntax/..": lambda vectors: vectors[0].update(id="syntax/.."),
            "Upper": lambda vectors: vectors[0].update(id="syntax/Upper"),
            "a/b/c": lambda vectors: vectors[0].update(id="a/b/c"),
            "line\\u001bbreak": lambda vectors: vectors[0].update(id="syntax/line\x1bbreak"),
            "x.hmlfc": lambda vectors: vectors[0]["input"].update(file="../x.hmlfc"),
            "y.hmlfc": lambda vectors: vectors[0]["input"].update(file="/y.hmlfc"),
            "z/../z.blocks": lambda vectors: vectors[0]["blocks"].update(file="z/../z.blocks"),
            "two vectors": lambda vectors: vectors.append(vectors[0]),
        }
        for says, change in changes.items():
            for command in (["conform", "--dut", GOLDEN, "-o", "named"], ["vectors", "lint"]):
                with self.subTest(says=says, command=command[0]):
                    self.refused(INPUT, *command, "--suite", self.suite_with(change), says=says)
                    self.assert_untouched()

    def test_output_has_files_of_others(self):
        """Folders with the names of earlier temporary ones stay."""
        for place in ("kept/dec/work", "kept/dec/work/syntax/base-main", "kept/dec/failures/syntax/base-main"):
            (self.folder / place).mkdir(parents=True, exist_ok=True)
            (self.folder / place / "file").write_text("mine")
        dut = self.folder / "dec.json"
        dut.write_text(json.dumps({"name": "dec", "command": GOLDEN}))
        before = set((self.folder / "kept").rglob("*"))
        self.conform(dut, suite=self.one, output="kept")
        self.assertEqual(before - set((self.folder / "kept").rglob("*")), set())
        for command in (
            ("fuzz-dut", "--dut", GOLDEN, "--count", "1", "-o", "fuzzed"),
            ("minimise", SUITE / "boundary/view-1x1.hmlfc", "--dut", "false {input} {output}", "--trials", "2", "-o", "least"),
        ):
            folder = self.folder / ("fuzzed/work" if command[0] == "fuzz-dut" else "least.work")
            folder.mkdir(parents=True)
            (folder / "file").write_text("mine")
            self.hmlfc(*command)
            self.assertEqual((folder / "file").read_text(), "mine")

    def test_output_is_no_link(self):
        """A link instead of a decoder's folder, or of its pictures, is not followed."""
        dut = self.folder / "dec.json"
        dut.write_text(json.dumps({"name": "dec", "command": "true {input} {output}"}))
        (self.folder / "linked").mkdir()
        (self.folder / "linked" / "dec").symlink_to(self.mine)
        self.refused(OUTPUT, "conform", "--suite", self.one, "--dut", dut, "-o", "linked", says="symbolic link")
        (self.folder / "pictured" / "dec").mkdir(parents=True)
        (self.folder / "pictured" / "dec" / "failures").symlink_to(self.mine)
        _, report = self.conform(dut, suite=self.one, output="pictured")
        self.assertIn("symbolic link", self.results(report)[ONE]["reason"])
        for name in "report.json", "junit.xml", "report.html":
            (self.folder / f"to-{name}").mkdir()
            (self.folder / f"to-{name}" / name).symlink_to(self.mine / "file")
            self.refused(OUTPUT, "conform", "--suite", self.one, "--dut", dut, "-o", f"to-{name}", "--force", says="symbolic link")
        self.assert_untouched()


class Reports(Foreign):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name in ("a b", "a-b"):
            dut = cls.folder / "coarse.json"
            dut.write_text(json.dumps({"name": name, "command": COARSE}))
            cls.run_hmlfc("conform", "--suite", SUITE, "--dut", dut, "--filter", "syntax/base-reference", "-o", name)

    def part(self, change=lambda report: None):
        shutil.rmtree(self.folder / "part", ignore_errors=True)
        shutil.copytree(self.folder / "a b", self.folder / "part")
        file = self.folder / "part" / "report.json"
        report = json.loads(file.read_text())
        change([result for result in report["runs"][0]["results"] if "pictures" in result][0], report["runs"][0])
        file.write_text(json.dumps(report))
        return self.folder / "part" / "a-b" / "failures" / "syntax" / "base-reference"

    def test_pictures_are_copied(self):
        self.part(lambda result, run: None)
        self.run_hmlfc("conform", "--merge", "part", "-o", "merged")
        copied = sorted(path.name for path in (self.folder / "merged/a-b/failures/syntax/base-reference").iterdir())
        self.assertEqual(copied, sorted(PICTURES))
        self.assertEqual((self.folder / "merged" / "report.html").read_text().count("data:image/png"), 3)

    def test_names_are_no_paths(self):
        for change in (
            lambda result, run: result.update(pictures="../mine/folder"),
            lambda result, run: result.update(pictures=str(self.mine)),
            lambda result, run: result.update(pictures="a-b/failures/syntax/other"),
            lambda result, run: result.update(id="../mine/folder"),
            lambda result, run: run.update(dut="c"),
        ):
            self.part(change)
            self.refused(INPUT, "conform", "--merge", "part", "-o", "refused", says="is not a report")
            self.assert_untouched()
            self.assertFalse((self.folder / "refused").exists())

    def test_links_are_not_followed(self):
        """Neither to read what a picture is said to be, nor to write."""
        picture = self.part(lambda result, run: None) / "actual.png"
        picture.unlink()
        picture.symlink_to(self.mine / "file")
        self.refused(INPUT, "conform", "--merge", "part", "-o", "links", says="symbolic link")
        self.part(lambda result, run: None)
        (self.folder / "elsewhere").mkdir()
        (self.folder / "elsewhere" / "a-b").symlink_to(self.mine)
        self.refused(INPUT, "conform", "--merge", "part", "-o", "elsewhere", says="symbolic link")
        self.assert_untouched()

    def test_long_words(self):
        """A million letters or digits are text like any other."""
        for word in ("1" * 10**6, "a" * 10**6):
            self.part(lambda result, run: (result.pop("difference"), result.update(reason=word, stage=f"stage {word}")))
            result = self.run_hmlfc("conform", "--merge", "part", "-o", "long")
            self.assertEqual(result.returncode, 1, result.stderr)

    def test_names_that_clash(self):
        self.refused(INPUT, "conform", "--merge", "a b", "a-b", "-o", "clash", says="give one another name")


if __name__ == "__main__":
    main()
