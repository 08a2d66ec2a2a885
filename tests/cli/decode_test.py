"""decode: all views, one view, rectangles, tree levels, corrupt streams."""

import os

from pictures import read_png
from program import CORRUPT, INPUT, USAGE, CliTest, main

GRID = [(row, col) for row in range(3) for col in range(4)]


class Decode(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 3x4 --size 45x27 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc --profile main --references 2x2".split())
        cls.hmlfc("decode", "a.hmlfc", "-o", "all")

    def pictures(self, folder):
        return {name: read_png(self.folder / folder / name) for name in self.names(folder)}

    def names(self, folder):
        return sorted(os.listdir(self.folder / folder))

    def test_all_views(self):
        self.assertEqual(self.names("all"), [f"{row:02}_{col:02}.png" for row, col in GRID])
        self.hmlfc("compare", "a.hmlfc", "all")
        for picture in self.pictures("all").values():
            self.assertEqual((picture.width, picture.height), (45, 27))

    def test_one_view(self):
        for row, col in GRID:
            folder = f"one{row}{col}"
            self.hmlfc("decode", "a.hmlfc", "-o", folder, "--view", f"{row},{col}")
            self.assertEqual(self.names(folder), [f"{row:02}_{col:02}.png"])
            name = self.names(folder)[0]
            self.assertEqual(self.pictures(folder)[name], self.pictures("all")[name])

    def test_rectangles_are_crops(self):
        whole = self.pictures("all")
        for i, rect in enumerate([
            (0, 0, 45, 27), (0, 0, 1, 1), (44, 26, 1, 1), (3, 5, 17, 9), (7, 1, 1, 26),
            (8, 8, 8, 8), (1, 26, 44, 1), (31, 0, 2, 27),
        ]):  # fmt: skip
            text = ",".join(map(str, rect))
            with self.subTest(rect=text):
                self.hmlfc("decode", "a.hmlfc", "-o", f"rect{i}", "--rect", text)
                expected = {name: picture.crop(*rect) for name, picture in whole.items()}
                self.assertEqual(self.pictures(f"rect{i}"), expected)
                one = f"rect{i}one"
                self.hmlfc("decode", "a.hmlfc", "-o", one, "--rect", text, "--view", "2,1")
                self.assertEqual(self.pictures(one), {"02_01.png": expected["02_01.png"]})

    def test_levels(self):
        self.assertEqual(self.hmlfc_json("info", "a.hmlfc")["tree_height"], 2)
        self.hmlfc("decode", "a.hmlfc", "-o", "three", "--levels", 3)
        self.assertEqual(self.pictures("three"), self.pictures("all"))
        self.hmlfc("decode", "a.hmlfc", "-o", "two", "--levels", 2)
        self.hmlfc("decode", "a.hmlfc", "-o", "root", "--levels", 1)
        # With clusters of 2 x 2 the views of a cluster share the picture of their parent.
        two, root = self.pictures("two"), self.pictures("root")
        for row, col in GRID:
            name = f"{row:02}_{col:02}.png"
            self.assertEqual(two[name], two[f"{row // 2 * 2:02}_{col // 2 * 2:02}.png"])
            self.assertEqual(root[name], root["00_00.png"])
        distinct = {tuple(picture.samples) for picture in two.values()}
        self.assertEqual(len(distinct), 4)
        self.hmlfc("decode", "a.hmlfc", "-o", "cut", "--levels", 2, "--rect", "5,4,9,8")
        cut = {name: picture.crop(5, 4, 9, 8) for name, picture in two.items()}
        self.assertEqual(self.pictures("cut"), cut)

    def test_more_levels_than_there_are(self):
        self.refused(USAGE, "decode", "a.hmlfc", "-o", "x", "--levels", 9, says=["--levels", "--height"])

    def test_corrupt_streams_are_named(self):
        stream = (self.folder / "a.hmlfc").read_bytes()
        header = 44 + 4 * 3 + 96 + 4

        def flipped(at):
            return stream[:at] + bytes([stream[at] ^ 1]) + stream[at + 1 :]

        for bad, name in [
            (b"", "truncated"),
            (stream[:11], "truncated"),
            (stream[:-1], "truncated"),
            (stream + b"\0", "trailing_bytes"),
            (flipped(0), "bad_magic"),
            (flipped(8), "bad_version"),
            (flipped(20), "bad_header_crc"),
            (flipped(header), "bad_top_entry"),
            (flipped(header + 100), "bad_section_crc"),
            (flipped(len(stream) - 1), "bad_section_crc"),
        ]:
            (self.folder / "bad.hmlfc").write_bytes(bad)
            inspect = "inspect bad.hmlfc --view 0,0 --plane Y --block 0,0".split()
            for command in [
                ["decode", "bad.hmlfc", "-o", "bad"],
                ["info", "bad.hmlfc"],
                ["compare", "views", "bad.hmlfc"],
                inspect,
                ["picture", "view", "bad.hmlfc", "--view", "0,0", "-o", "bad.png"],
            ]:
                with self.subTest(name=name, command=command[0]):
                    self.refused(CORRUPT, *command, says=["bad.hmlfc", name, "at byte"])
        self.assertFalse((self.folder / "bad").exists())
        self.assertFalse((self.folder / "bad.png").exists())

    def test_no_stream(self):
        self.refused(INPUT, "decode", "nowhere.hmlfc", "-o", "x", says="nowhere.hmlfc")
        self.refused(INPUT, "decode", "views", "-o", "x", says="views")


if __name__ == "__main__":
    main()
