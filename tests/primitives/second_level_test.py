"""The golden model and the naive decoder agree on the cases of level 2 of `hmlfc primitives`, and on those
of another seed."""

from primitives_case import PrimitivesTest, main


class SecondLevel(PrimitivesTest):
    @classmethod
    def prepare(cls):
        cls.drawn = [primitive for primitive in cls.hmlfc_json("primitives", "list") if not primitive["exhaustive"]]

    def test_second_level(self):
        for primitive in self.drawn:
            with self.subTest(primitive=primitive["name"]):
                lines = self.agree(primitive["name"], "--level", 2)
                self.assertEqual(len(lines), 32 * primitive["cases"])

    def test_other_seed(self):
        for primitive in self.drawn:
            with self.subTest(primitive=primitive["name"]):
                self.agree(primitive["name"], "--seed", 2**64 - 1)


if __name__ == "__main__":
    main()
