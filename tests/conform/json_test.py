"""JSON of others, nested deeper or with other kinds of values than it may have: an error of the file or the vector."""

import json

from conform_case import ROOT, ConformTest, main
from program import INPUT, USAGE

DEPTH = 300_000  # enough to end a program that reads by recursion
NESTED = "[" * DEPTH + "]" * DEPTH
LONG = "\x1b[31m" + "x" * 1_000_000


class HostileJson(ConformTest):
    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def complaint(self, status, *arguments):
        """The one line of a refusal, which is short and holds no control character."""
        result = self.run_hmlfc(*arguments)
        self.assertEqual(result.returncode, status, result.stderr[:1000])
        text = result.stderr.decode().strip()
        self.assertLess(len(text), 500)
        self.assertTrue(text.isprintable(), text)
        return text

    def test_declarations(self):
        run = ("conform", "--suite", self.small, "-o", "none", "--dut", "dut.json")
        for text, says in [
            (NESTED, "nested deeper than the 3"),
            ('{"name": "a", "limits": ' + NESTED + "}", "nested deeper than the 3"),
            (json.dumps({"name": "a", LONG: 1}), "the unknown key"),
            (json.dumps({"name": "a", "command": LONG}), "does not have {input}"),
            (json.dumps({"name": "a", "command": "a {input} {output}", "profile": LONG}), '"profile": '),
            (json.dumps({"name": "a", "command": "a {input} {output}", "level": 1e300}), "not an integer in [0, 3]"),
            (json.dumps({"name": "a", "command": "a {input} {output}", "limits": {"block_log2": [1e300]}}), "block_log2"),
            ('{"name": "a", "name": "b"}', '"name" is there twice'),
        ]:
            self.write("dut.json", text)
            self.assertIn(says, self.complaint(USAGE, *run))

    def test_claims(self):
        claim = {"results": {}, "decoder": {"dut": "a"}}
        for text in (
            NESTED,
            '{"sha256": "", "claim": ' + NESTED + "}",
            json.dumps({"sha256": LONG, "claim": {**claim, "decoder": ["a"]}}),
            json.dumps({"sha256": LONG, "claim": {**claim, "results": 7}}),
        ):
            self.write("claim.json", text)
            said = self.complaint(INPUT, "conform", "--suite", self.small, "--verify", "claim.json", "-o", "none")
            self.assertIn("is not a claim", said)

    def test_reports(self):
        (self.folder / "other").mkdir(exist_ok=True)
        self.conform(f"{ROOT / 'vectors/duts/model.json'}", output="good")
        good = json.loads((self.folder / "good/report.json").read_text())
        fraction = json.loads(json.dumps(good))
        fraction["runs"][0]["results"][0]["bytes"] = 1e300
        for text, says in [
            (NESTED, "nested deeper than the 7"),
            ('{"runs": ' + NESTED + "}", "nested deeper than the 7"),
            (json.dumps(fraction), "is not a report"),
        ]:
            self.write("other/report.json", text)
            self.assertIn(says, self.complaint(INPUT, "conform", "--merge", "good", "other", "-o", "merged"))

    def test_manifests(self):
        (self.folder / "suite").mkdir(exist_ok=True)
        vector = self.manifest["vectors"][0]
        for changes, says in [
            ({"level": 1e300}, "out of range"),
            ({"milestone": LONG}, "is not a milestone"),
            ({"profile": LONG}, '"profile": '),
            ({"id": LONG, "level": {}}, "is no name GROUP/NAME"),
        ]:
            text = json.dumps({**self.manifest, "vectors": [{**vector, **changes}]})
            self.write("suite/manifest.json", text)
            self.assertIn(says, self.complaint(INPUT, "vectors", "list", "--suite", "suite"))
        self.write("suite/manifest.json", '{"vectors": ' + NESTED + "}")
        self.assertIn("nested deeper", self.complaint(INPUT, "vectors", "list", "--suite", "suite"))


if __name__ == "__main__":
    main()
