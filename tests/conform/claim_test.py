"""`hmlfc conform --claim` and `--verify`: what a claim holds, and that a changed one is refused."""

import hashlib
import json
import shlex

from conform_case import ConformTest, main
from program import DONE, INPUT, USAGE

DECODER = """#!/bin/sh
# the decoder
exec "$HMLFC" decode "$@"
"""


def sum_of(claim):
    text = json.dumps(claim, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()


class Claims(ConformTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.decoder = cls.folder / "decoder.sh"
        cls.decoder.write_text(DECODER)
        cls.decoder.chmod(0o755)
        cls.dut = f"{shlex.quote(str(cls.decoder))} {{input}} -o {{output}}"
        result = cls.claim(cls.dut, cls.folder / "claim.json")
        assert result.returncode == DONE, result.stderr
        cls.whole = json.loads((cls.folder / "claim.json").read_text())

    @classmethod
    def claim(cls, dut, file, *arguments):
        command = ["conform", "--suite", cls.small, "--dut", dut, "-o", "report", "--claim", file]
        return cls.run_hmlfc(*command, *arguments)

    def verify(self, whole):
        (self.folder / "other.json").write_text(json.dumps(whole))
        result = self.run_hmlfc("conform", "--suite", self.small, "--verify", "other.json", "--run-claimed", "-o", "check")
        return result.returncode, result.stdout.decode() + result.stderr.decode()

    def changed(self, change):
        """The claim with a change and the hash that belongs to it."""
        claim = json.loads(json.dumps(self.whole["claim"]))
        change(claim)
        return {"sha256": sum_of(claim), "claim": claim}

    def test_content(self):
        claim = self.whole["claim"]
        self.assertEqual(self.whole["sha256"], sum_of(claim))
        self.assertEqual(set(claim["results"]), {v["id"] for v in self.manifest["vectors"]})
        self.assertEqual(set(claim["results"].values()), {"pass"})
        file = {"name": "decoder.sh", "sha256": hashlib.sha256(self.decoder.read_bytes()).hexdigest()}
        self.assertEqual(claim["decoder"]["files"], [file])
        suite = hashlib.sha256((self.small / "manifest.json").read_bytes()).hexdigest()
        self.assertEqual(claim["suite"]["manifest_sha256"], suite)
        self.assertEqual(claim["claims"]["profile"], "extended")
        self.assertIn("T", claim["date"])

    def test_verify(self):
        self.assertEqual(self.verify(self.whole), (DONE, "other.json: verified, 6 results\n"))

    def test_only_a_named_decoder_is_run(self):
        """The command of a claim is shown, and run where the user says so."""
        def name(claim):
            claim["decoder"].update(dut="sh -c 'touch ran; exit 1' \x1b {input} {output}", files=[])

        (self.folder / "foreign.json").write_text(json.dumps(self.changed(name)))
        command = ("conform", "--suite", self.small, "--verify", "foreign.json", "-o", "foreign")
        message = self.refused(USAGE, *command, says=("touch ran; exit 1' \\u001b {input}", "--run-claimed", "--dut"))
        self.assertNotIn("\x1b", message)
        self.assertFalse((self.folder / "ran").exists() or (self.folder / "foreign").exists())
        self.refused(USAGE, *command, "--dut", self.dut, "--run-claimed", says="not both")
        self.refused(USAGE, "conform", "--suite", self.small, "--dut", self.dut, "--run-claimed", "-o", "foreign", says="--verify")
        named = self.run_hmlfc(*command, "--dut", self.dut)
        self.assertEqual(named.returncode, 1)
        self.assertIn("differs: decoder/files", named.stdout.decode())
        self.assertFalse((self.folder / "ran").exists())

    def test_changed_claims_are_refused(self):
        for change in (
            lambda claim: claim["results"].update({"error/magic": "not_supported"}),
            lambda claim: claim["claims"].update(level=2),
            lambda claim: claim["suite"].update(version="9.9.9"),
            lambda claim: claim["decoder"]["files"].clear(),
            lambda claim: claim["waivers"].update({"error/magic": "none"}),
        ):
            whole = {"sha256": self.whole["sha256"], "claim": self.changed(change)["claim"]}
            status, text = self.verify(whole)
            self.assertEqual(status, INPUT)
            self.assertIn("has been changed", text)

    def test_other_results_are_found(self):
        """Claims whose hash is right, but which are not true."""
        for change, says in (
            (lambda claim: claim["results"].update({"error/magic": "skipped"}), 'results/error/magic: "pass" instead of "skipped"'),
            (lambda claim: claim["claims"].update(level=2), "claims/level: 3 instead of 2"),
            (lambda claim: claim["suite"].update(manifest_sha256="0"), "suite/manifest_sha256"),
            (lambda claim: claim["decoder"]["files"].clear(), "decoder/files"),
            (lambda claim: claim.update(verdict="fails"), 'verdict: "conforms" instead of "fails"'),
        ):
            status, text = self.verify(self.changed(change))
            self.assertEqual(status, 1, text)
            self.assertIn(says, text)

    def test_no_claim_of_a_failing_decoder(self):
        result = self.claim("false {input} {output}", self.folder / "none.json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no claim is written", result.stderr.decode())
        self.assertFalse((self.folder / "none.json").exists())

    def test_refusals(self):
        for option in (("--filter", "real/*"), ("--milestone", "motion"), ("--shard", "1/2"), ("--dut", "true {input} {output}")):
            self.assertEqual(self.claim(self.dut, "none.json", *option).returncode, USAGE, option)
        for text in ("", "{}", '{"claim": 3, "sha256": ""}', "[]"):
            (self.folder / "bad.json").write_text(text)
            command = ("conform", "--suite", self.small, "--verify", "bad.json", "--run-claimed", "-o", "check")
            self.refused(INPUT, *command, says="is not a claim")


if __name__ == "__main__":
    main()
