#!/usr/bin/env python3
"""hmlfc vectors: the commands on the suite that is checked in, and their refusals."""

import json

from program import CORRUPT, INPUT, ROOT, USAGE, CliTest, main

SUITE = ROOT / "vectors"


class Vectors(CliTest):
    @classmethod
    def vectors(cls, command, *arguments):
        return cls.hmlfc("vectors", command, *arguments, "--suite", SUITE)

    def test_list(self):
        manifest = json.loads((SUITE / "manifest.json").read_text())
        text = self.vectors("list")
        self.assertIn(f"{manifest['count']} of {manifest['count']} vectors", text)
        for vector in manifest["vectors"]:
            self.assertIn(f"{vector['id']} ", text)

    def test_list_chosen(self):
        rows = json.loads(self.vectors("list", "--group", "error", "--clause", "STP-1", "--json"))
        vectors = json.loads((SUITE / "manifest.json").read_text())["vectors"]
        chosen = [v["id"] for v in vectors if v["group"] == "error" and "STP-1" in v["clauses"]]
        self.assertIn("error/step-code", chosen)
        self.assertEqual([row["id"] for row in rows], chosen)
        row = next(row for row in rows if row["id"] == "error/step-code")
        self.assertEqual((row["outcome"], row["profile"]), ("reject", "extended"))

    def test_explain(self):
        text = self.vectors("explain", "error/sign-mode-3")
        for part in ("sign_mode 3", "TIL-6", "reject bad_mode at byte", "view 0,1 plane Y", "base-main"):
            self.assertIn(part, text)

    def test_show(self):
        picture = self.folder / "cards.png"
        self.assertIn("4 x 4 views", self.vectors("show", "real/cards-main", "-o", picture))
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))

    def test_show_of_a_damaged_stream(self):
        picture = self.folder / "none.png"
        arguments = ("vectors", "show", "error/sign-mode-3", "-o", picture, "--suite", SUITE)
        self.refused(CORRUPT, *arguments, says="bad_mode")
        self.assertFalse(picture.exists())

    def test_inspect(self):
        lines = self.vectors("inspect", "syntax/base-main").splitlines()
        self.assertIn("89 48 4d 4c 46 43 0d 0a", lines[0])
        (mode,) = [line for line in lines if line.endswith(" sign_mode = 0") and "IDX" not in line][:1]
        self.assertIn("2 bits", mode)
        self.assertIn("TIL-6", mode)

    def test_inspect_covers_every_bit_once(self):
        data = (SUITE / "syntax/base-main.hmlfc").read_bytes()
        done = 0
        for line in self.vectors("inspect", "syntax/base-main").splitlines():
            place, bits = line.split()[:2]
            byte, bit = place.split(".")
            self.assertEqual(int(byte, 16) * 8 + int(bit), done, line)
            done += int(bits)
        self.assertEqual(done, len(data) * 8)

    def test_inspect_names_errors_last(self):
        lines = self.vectors("inspect", "error/version-2").splitlines()
        self.assertIn("bad_version", lines[-1])
        self.assertIn("bad_mode", self.vectors("inspect", "error/sign-mode-3").splitlines()[-1])

    def test_refusals(self):
        self.refused(USAGE, "vectors", says="lint")
        self.refused(USAGE, "vectors", "show", "real/none", "-o", "x.png", "--suite", SUITE, says="real/none")
        self.refused(USAGE, "vectors", "explain", "frames/none", "--suite", SUITE, says="hmlfc vectors list --frames shows")
        self.assertIn("see also --frames", self.vectors("list", "--clause", "SMP-2"))
        self.refused(INPUT, "vectors", "list", "--suite", "nowhere", says="manifest.json")
        self.refused(INPUT, "vectors", "generate", "--suite", "nowhere", says="no recipes")


if __name__ == "__main__":
    main()
