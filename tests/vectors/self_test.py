#!/usr/bin/env python3
"""Plants faults in copies of the suite: each check must find each."""

import copy
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import errors
import regenerate
import schema

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from program import PROGRAM, ROOT, main  # noqa: E402

SUITE = ROOT / "vectors"
FIRST = "real/cards-main"
BASE = "syntax/base-main"


def copy_part(target):
    """Copies the vectors of group real, one of group error and its base: enough to plant faults in."""
    manifest = json.loads((SUITE / "manifest.json").read_text())
    kept = [v for v in manifest["vectors"] if v["group"] == "real" or v["id"] in ("error/version-0", BASE)]
    manifest.update(vectors=kept, count=len(kept))
    shutil.copytree(SUITE / "real", target / "real")
    (target / "error").mkdir()
    shutil.copy(SUITE / "error/version-0.hmlfc", target / "error")
    (target / "syntax").mkdir()
    for path in SUITE.glob(f"{BASE}.*"):
        shutil.copy(path, target / "syntax")
    shutil.copytree(SUITE / "recipes", target / "recipes")
    (target / "manifest.json").write_text(json.dumps(manifest))


class CopiedSuite(unittest.TestCase):
    """A copy of a part of the suite for each test, in self.suite, and another in self.kept."""

    def setUp(self):
        folder = tempfile.mkdtemp(prefix="hmlfc-vectors-")
        self.addCleanup(shutil.rmtree, folder)
        self.suite, self.kept = Path(folder) / "vectors", Path(folder) / "kept"
        copy_part(self.suite)
        shutil.copytree(self.suite, self.kept)

    def restore(self):
        shutil.rmtree(self.suite)
        shutil.copytree(self.kept, self.suite)

    def flip(self, name, at=-1):
        path = self.suite / name
        data = bytearray(path.read_bytes())
        data[at] ^= 1
        path.write_bytes(data)


class Regenerate(CopiedSuite):
    def found(self):
        return list(regenerate.differences(self.suite, self.kept))

    def test_the_same(self):
        self.assertEqual(self.found(), [])

    def test_each_difference(self):
        for plant, found in (
            (lambda: self.flip(f"{FIRST}.hmlfc"), f"{FIRST}.hmlfc: other bytes than generated"),
            (lambda: self.flip("manifest.json", 30), "manifest.json: other bytes than generated"),
            ((self.suite / f"{FIRST}.blocks").unlink, f"{FIRST}.blocks: in the suite, but not generated"),
            ((self.suite / "real/new.hmlfc").touch, "real/new.hmlfc: generated, but not in the suite"),
        ):
            with self.subTest(found):
                plant()
                self.assertEqual(self.found(), [found])
                self.restore()


@unittest.skipIf(schema.jsonschema is None, "python3-jsonschema is missing")
class Schema(unittest.TestCase):
    def setUp(self):
        manifest, self.schema = schema.load(SUITE)
        self.manifest = copy.deepcopy(manifest)
        self.vector = self.manifest["vectors"][0]

    def found(self):
        return list(schema.complaints(self.manifest, self.schema))

    def test_as_it_is(self):
        self.assertEqual(self.found(), [])

    def test_each_required_field(self):
        for name in ("id", "group", "profile", "level", "clauses", "flags", "comment", "input", "expect"):
            with self.subTest(name):
                kept = self.vector.pop(name)
                self.assertNotEqual(self.found(), [])
                self.vector[name] = kept

    def test_wrong_values(self):
        for name, value in (("group", "other"), ("level", 4), ("profile", "high"), ("comment", ""), ("more", 1)):
            with self.subTest(name):
                kept = self.vector.get(name)
                self.vector[name] = value
                self.assertNotEqual(self.found(), [])
                self.vector[name] = kept
                if kept is None:
                    del self.vector[name]

    def test_reject_without_error(self):
        self.vector["expect"] = {"outcome": "reject"}
        self.assertNotEqual(self.found(), [])

    def test_short_sum(self):
        self.vector["input"]["sha256"] = "0" * 63
        self.assertNotEqual(self.found(), [])


class Errors(unittest.TestCase):
    def setUp(self):
        self.text = (ROOT / "docs/specification.md").read_text()
        self.manifest = json.loads((SUITE / "manifest.json").read_text())

    def found(self):
        return list(errors.complaints(self.text, self.manifest))

    def test_as_it_is(self):
        self.assertEqual(self.found(), [])

    def test_error_without_vector(self):
        for vector in self.manifest["vectors"]:
            if vector["expect"].get("error") == "mask_outside":
                vector["expect"]["error"] = "bad_mode"
        self.assertEqual(self.found(), ["mask_outside: no vector expects this error"])

    def test_new_error(self):
        self.text = self.text.replace("| 27 | bus_error |", "| 28 | new_error | x |\n| 27 | bus_error |")
        self.assertEqual(self.found(), ["new_error: no vector expects this error"])

    def test_exemption_of_nothing(self):
        self.text = self.text.replace("| 27 | bus_error |", "| 27 | port_error |")
        self.assertEqual(
            self.found(),
            ["port_error: no vector expects this error", "bus_error: exempt, but annex A does not have it"],
        )


class Lint(CopiedSuite):
    def lint(self):
        command = [PROGRAM, "vectors", "lint", "--suite", self.suite]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        return result.returncode, result.stdout

    def change_manifest(self, change):
        path = self.suite / "manifest.json"
        manifest = json.loads(path.read_text())
        change(manifest["vectors"])
        manifest["count"] = len(manifest["vectors"])
        path.write_text(json.dumps(manifest))

    def test_as_it_is(self):
        self.assertEqual(self.lint()[0], 0)

    def test_each_fault(self):
        def cut_hex():
            path = self.suite / f"{FIRST}.trace.hex"
            path.write_text("".join(path.read_text().splitlines(keepends=True)[:-1]))

        def changed(change):
            return lambda: self.change_manifest(change)

        def vector(vectors, name):
            return next(v for v in vectors if v["id"] == name)

        files = [f"{FIRST}.{end}" for end in ("hmlfc", "blocks", "trace.jsonl", "trace.hex")]
        for plant, text in (
            *((lambda name=name: self.flip(name, 40), "the SHA-256 differs") for name in files),
            ((self.suite / f"{FIRST}.hmlfc").unlink, FIRST),
            ((self.suite / "real/stray.hmlfc").touch, "real/stray.hmlfc: no vector names this file"),
            (cut_hex, "count or end marker is wrong"),
            (changed(lambda vectors: vectors[-1].update(level=3)), "is of another conformance level"),
            (changed(lambda vectors: vectors.reverse()), "ids are not sorted"),
            (changed(lambda vectors: vector(vectors, FIRST)["output"].update(width=1)), "output has another shape"),
            (
                changed(lambda vectors: vector(vectors, "error/version-0")["expect"].update(error="bad_magic")),
                "for another reason",
            ),
        ):
            with self.subTest(text):
                plant()
                status, output = self.lint()
                self.assertEqual(status, 1, output)
                self.assertIn(text, output)
                self.restore()


class Recipes(CopiedSuite):
    """The generator must not take an expectation that the golden model contradicts."""

    def generate(self, recipe, name="one", pairs=()):
        shutil.rmtree(self.suite / "recipes")
        (self.suite / "recipes").mkdir()
        base = {
            "name": "base",
            "clauses": ["FIL-1"],
            "comment": "a base",
            "stream": {"kind": "fields", "header": {"rows": 1, "cols": 2, "levels": [[1, 2]]}},
        }
        recipe = {"name": name, "clauses": ["FIL-1"], "comment": "planted", **recipe}
        recipes = {"group": "error", "vectors": [base, recipe], "pairs": [*pairs]}
        (self.suite / "recipes/planted.json").write_text(json.dumps(recipes))
        before = (self.suite / "manifest.json").read_bytes()
        command = [PROGRAM, "vectors", "generate", "--suite", self.suite]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode:
            self.assertEqual((self.suite / "manifest.json").read_bytes(), before)
        return result

    def assert_refused(self, recipe, text, **arguments):
        result = self.generate(recipe, **arguments)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn(text, result.stderr)

    @staticmethod
    def edit(edit, error, offset, **more):
        return {
            "stream": {"kind": "edit", "base": "error/base", "edits": [edit]},
            "expect": {"error": error, "offset": offset, **more},
        }

    @staticmethod
    def fields(**rules):
        header = {"rows": 1, "cols": 2, "levels": [[1, 2]]}
        return {"kind": "fields", "header": header, "fields": {"residual_mask": "all", **rules}}

    VERSION = {"header": "version", "value": 2}

    def test_right(self):
        result = self.generate(self.edit(self.VERSION, "bad_version", 8))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_wrong_expectations(self):
        unstated = self.edit(self.VERSION, "bad_version", 8)
        del unstated["expect"]
        right = {"header": "version", "value": 1}
        block = {"view": [0, 0], "plane": "Y", "block": [0, 0]}
        for recipe, text in (
            (self.edit(self.VERSION, "bad_magic", 8), "the golden model answers bad_version"),
            (self.edit(self.VERSION, "bad_version", 9), "at byte 9"),
            (self.edit(right, "bad_version", 8), "an open stream"),
            (self.edit(right, "bad_mode", 8, blocks=[block]), "the golden model answers samples"),
            (unstated, "bad_version"),
        ):
            with self.subTest(text):
                self.assert_refused(recipe, text)

    def test_unknown_names(self):
        for stream, text in (
            ({"kind": "other"}, "is not a kind of stream"),
            ({"kind": "fields", "header": {"wide": 3}}, "is not a field of a header"),
            ({"kind": "fields", "header": {}, "fields": {"wide": 3}}, "is not a field of a stream"),
            ({"kind": "edit", "base": "error/none", "edits": []}, "there is no recipe"),
            ({"kind": "edit", "base": "error/one", "edits": []}, "form a cycle"),
            ({"kind": "edit", "base": "error/base", "edits": [{"x": 1}]}, "is not an edit"),
            ({"kind": "fields", "header": {"depth": 13}}, "bad_header_field"),
            (self.fields(level_base=3, level_bits=0, value=4), "value 4 of a sequence of 4 levels"),
            (self.fields(level_base=3, level_bits=1, level_code=6), "its tile has no bits"),
            (self.fields(bias_bits=2, bias=2), "its tile has no bits"),
        ):
            with self.subTest(text):
                self.assert_refused({"stream": stream}, text)

    def test_unknown_key(self):
        self.assert_refused({"stream": {}, "comments": "x"}, "a recipe has no")

    MAGIC = {"name": "magic", "comment": "x", "error": "bad_magic", "offset": 0,
             "edits": [{"header": "magic", "value": 0, "mend": False}]}

    def generate_pair(self, *errors):
        family = {"name": "pair", "base": "error/base", "clauses": ["FIL-4"], "errors": [*errors]}
        result = self.generate(self.edit(self.VERSION, "bad_version", 8), pairs=[family])
        manifest = json.loads((self.suite / "manifest.json").read_text())
        return result, {v["id"]: v["expect"]["error"] for v in manifest["vectors"] if "pair" in v["id"]}

    def version(self, **more):
        return {"name": "version", "comment": "x", "error": "bad_version", "offset": 8, "edits": [self.VERSION], **more}

    def test_pairs(self):
        result, pairs = self.generate_pair(self.MAGIC, self.version())
        self.assertEqual((result.returncode, pairs), (0, {"error/pair-magic-version": "bad_magic"}), result.stderr)
        for left_out in (self.version(without=["magic"]), {**self.MAGIC, "name": "again"}):
            self.assertEqual(self.generate_pair(self.MAGIC, left_out)[1], {})

    def test_pairs_in_another_order(self):
        result, _ = self.generate_pair(self.version(), self.MAGIC)
        self.assertEqual(result.returncode, 3)
        self.assertIn("error/pair-version-magic: the recipe expects bad_version", result.stderr)

    def test_pair_whose_second_error_is_not_there(self):
        result, _ = self.generate_pair(self.MAGIC, self.version(edits=[]))
        self.assertEqual(result.returncode, 3)
        self.assertIn("error/pair-version: the recipe expects bad_version", result.stderr)

    def test_second_of_one_name(self):
        self.assert_refused({"stream": {}}, "a second error/base", name="base")


if __name__ == "__main__":
    main()
