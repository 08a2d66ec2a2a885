"""`hmlfc minimise`."""

from conform_case import SUITE, ConformTest, faulty, main
from program import INPUT

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
        """A fault of the chroma position needs pixels that differ, and no more."""
        self.hmlfc("minimise", CARDS, "--dut", faulty("chroma_shifted"), "--trials", "60", "-o", "chroma.hmlfc")
        self.assertLess((self.folder / "chroma.hmlfc").stat().st_size, CARDS.stat().st_size // 2)
        self.hmlfc("decode", "chroma.hmlfc", "-o", "chroma")

    def test_same_result_again(self):
        refuses = "sh -c 'exit 1' {input} {output}"
        for name in ("one", "two"):
            self.hmlfc("minimise", CARDS, "--dut", refuses, "-o", name)
        self.assertEqual((self.folder / "one").read_bytes(), (self.folder / "two").read_bytes())

    def test_right_decoder(self):
        right = "{hmlfc} decode {input} -o {output}"
        self.refused(INPUT, "minimise", CARDS, "--dut", right, "-o", "x.hmlfc", says="does not fail")
        self.assertFalse((self.folder / "x.hmlfc").exists())


if __name__ == "__main__":
    main()
