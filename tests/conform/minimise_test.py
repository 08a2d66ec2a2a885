"""`hmlfc minimise` and `hmlfc fuzz-dut`."""

import json

from conform_case import COARSE, PROGRAM, SUITE, ConformTest, main
from program import DONE, INPUT

CARDS = SUITE / "real" / "cards-main.hmlfc"


class Minimise(ConformTest):
    def info(self, file):
        return self.hmlfc_json("info", file)

    def test_any_stream_fails(self):
        """A decoder that refuses everything: the smallest stream there is."""
        refuses = "sh -c 'exit 1' {input} {output}"
        self.hmlfc("minimise", CARDS, "--dut", refuses, "-o", "small.hmlfc")
        self.assertLess((self.folder / "small.hmlfc").stat().st_size, 1000)
        shape = self.hmlfc("info", "small.hmlfc")
        self.assertIn("1 x 1", shape)
        self.hmlfc("decode", "small.hmlfc", "-o", "small")

    def test_failure_stays(self):
        """A decoder of the top level needs a second one that differs, and no more."""
        self.hmlfc("minimise", CARDS, "--dut", COARSE, "--trials", "15", "-o", "coarse.hmlfc")
        self.assertLess((self.folder / "coarse.hmlfc").stat().st_size, CARDS.stat().st_size // 2)
        self.assertIn("Tree level 1 ", " ".join(self.hmlfc("info", "coarse.hmlfc").split()))

    def test_same_result_again(self):
        refuses = "sh -c 'exit 1' {input} {output}"
        for name in ("one", "two"):
            self.hmlfc("minimise", CARDS, "--dut", refuses, "-o", name)
        self.assertEqual((self.folder / "one").read_bytes(), (self.folder / "two").read_bytes())

    def test_right_decoder(self):
        right = "{hmlfc} decode {input} -o {output}"
        self.refused(INPUT, "minimise", CARDS, "--dut", right, "-o", "x.hmlfc", says="does not fail")
        self.assertFalse((self.folder / "x.hmlfc").exists())


class Fuzz(ConformTest):
    def test_golden_model(self):
        right = f"{PROGRAM} decode {{input}} -o {{output}}"
        done = self.run_hmlfc("fuzz-dut", "--dut", right, "--count", "5", "--seed", "11", "-o", "clean")
        self.assertEqual(done.returncode, DONE)
        self.assertIn("seeds 11 to 15: 5 streams, 0 failures", done.stdout.decode())

    def test_finding(self):
        result = self.run_hmlfc(
            "fuzz-dut", "--dut", "false {input} {output}", "--count", "1", "--seed", "3", "-o", "found"
        )
        self.assertEqual(result.returncode, 1, result.stderr)
        found = self.folder / "found"
        stream, small = found / "seed-3.hmlfc", found / "seed-3.min.hmlfc"
        self.assertLess(small.stat().st_size, stream.stat().st_size)
        self.hmlfc("decode", small, "-o", "found-views")
        recipe = json.loads((found / "seed-3.json").read_text())
        self.assertEqual(recipe["vectors"][0]["stream"]["kind"], "random")


if __name__ == "__main__":
    main()
