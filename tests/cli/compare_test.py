"""compare against numbers computed here."""

import random
import shutil
from json import loads

from pictures import Picture, errors, psnr, write_png, write_ppm
from program import DIFFERENT, DONE, INPUT, USAGE, CliTest, main

KEYS = ["psnr_rgb", "psnr_y", "psnr_rgb_min", "max_abs_error", "identical", "first_difference"]


class Compare(CliTest):
    @classmethod
    def prepare(cls):
        cls.random = random.Random(5)
        cls.views = cls.make("a")

    @classmethod
    def make(cls, name, maximum=255, rows=2, cols=3, width=7, height=5):
        folder = cls.folder / name
        folder.mkdir()
        views = {}
        for row in range(rows):
            for col in range(cols):
                samples = [cls.random.randint(0, maximum) for _ in range(width * height * 3)]
                views[row, col] = Picture(width, height, samples)
                write_ppm(folder / f"{row:02}_{col:02}.ppm", views[row, col], maximum)
        return views

    def changed(self, name, view, changes, source="a", maximum=255):
        """A copy of `source` with samples {index: value} of one view replaced."""
        shutil.rmtree(self.folder / name, ignore_errors=True)
        shutil.copytree(self.folder / source, self.folder / name)
        picture = Picture(7, 5, list(self.views[view].samples))
        for index, value in changes.items():
            picture.samples[index] = value
        write_ppm(self.folder / name / f"{view[0]:02}_{view[1]:02}.ppm", picture, maximum)
        return picture

    def compare(self, a, b, status, *options):
        result = self.run_hmlfc("compare", a, b, "--json", *options)
        self.assertEqual((result.returncode, result.stderr), (status, b""))
        json = loads(result.stdout)
        self.assertEqual(list(json), KEYS)
        return json

    def test_identical(self):
        json = self.compare("a", "a", DONE)
        self.assertEqual(json, dict(zip(KEYS, ["inf", "inf", "inf", 0, True, None])))
        self.assertIn("Identical", self.hmlfc("compare", "a", "a"))

    def test_all_different(self):
        other = self.make("b")
        found = {view: errors(a, other[view]) for view, a in self.views.items()}
        rgb = {view: squares for view, (squares, _, _) in found.items()}
        luma = sum(squares for _, squares, _ in found.values())
        json = self.compare("a", "b", DIFFERENT)
        self.assertAlmostEqual(json["psnr_rgb"], psnr(sum(rgb.values()), 6 * 105, 255), places=9)
        self.assertAlmostEqual(json["psnr_y"], psnr(luma, 6 * 35, 255), places=9)
        self.assertAlmostEqual(json["psnr_rgb_min"], psnr(max(rgb.values()), 105, 255), places=9)
        worst = max(rgb, key=lambda view: (rgb[view], -view[0], -view[1]))
        text = self.run_hmlfc("compare", "a", "b").stdout.decode()
        self.assertIn(f"view {worst[0]},{worst[1]}", text)

    def test_first_difference(self):
        for view in self.views:
            for index in (0, 1, 2, 3, 20, 21, 104):
                old = self.views[view].samples[index]
                changes = {index: old ^ 1, 104: self.views[view].samples[104] ^ 128}
                if index == 104:
                    changes = {104: old ^ 128}
                picture = self.changed("c", view, changes)
                json = self.compare("a", "c", DIFFERENT)
                expected = {
                    "row": view[0],
                    "col": view[1],
                    "x": index // 3 % 7,
                    "y": index // 21,
                    "channel": "RGB"[index % 3],
                    "a": old,
                    "b": picture.samples[index],
                }
                self.assertEqual(json["first_difference"], expected)
                self.assertEqual(list(json["first_difference"]), list(expected))
                self.assertEqual(json["max_abs_error"], 128)
                self.assertIs(json["identical"], False)

    def test_parts(self):
        """One view, one rectangle, or both: only their samples count, at their own place."""
        self.changed("part", (1, 2), {3 * (7 * 2 + 4) + 1: 255 - self.views[1, 2].samples[55]})
        error = abs(255 - 2 * self.views[1, 2].samples[55])
        self.compare("a", "part", DONE, "--view", "1,1")
        self.compare("a", "part", DONE, "--rect", "0,0,4,5")
        for options, pixels in [
            (["--view", "1,2"], 35),
            (["--rect", "3,1,3,4"], 6 * 12),
            (["--view", "1,2", "--rect", "4,2,1,1"], 1),
        ]:
            json = self.compare("a", "part", DIFFERENT, *options)
            self.assertAlmostEqual(json["psnr_rgb"], psnr(error**2, 3 * pixels, 255), places=9)
            first = json["first_difference"]
            self.assertEqual([first[key] for key in ("row", "col", "x", "y")], [1, 2, 4, 2])
        self.refused(USAGE, "compare", "a", "part", "--view", "2,0", says="--view 2,0")
        self.refused(USAGE, "compare", "a", "part", "--rect", "5,0,3,1", says="--rect 5,0,3,1")

    def test_the_first_view_counts_whichever_is_read_first(self):
        # The first view, a PNG, takes longer to read than the others, which another core reads.
        samples = [self.random.randint(0, 63) for _ in range(400 * 300 * 3)]
        for name in ("slow", "slower"):
            (self.folder / name).mkdir()
            samples[777] += 1
            write_png(self.folder / name / "0_0.png", Picture(400, 300, samples))
            for col in range(1, 8):
                write_ppm(self.folder / name / f"0_{col}.ppm", Picture(400, 300, samples))
        for _ in range(5):
            text = self.run_hmlfc("compare", "slow", "slower").stdout.decode()
            self.assertRegex(text, r"worst .* view 0,0\n")
            self.assertRegex(text, r"First difference +view 0,0 x 259 y 0 channel R: ")

    def test_other_shapes_are_refused(self):
        self.make("rows", rows=3)
        self.make("wide", width=8)
        self.make("twelve", 4095)
        for other, named in [
            ("rows", "3 x 3 views of 7 x 5"),
            ("wide", "2 x 3 views of 8 x 5"),
            ("twelve", "12 bits"),
        ]:
            with self.subTest(other=other):
                self.refused(INPUT, "compare", "a", other, says=["2 x 3 views of 7 x 5", named])

    def test_a_view_of_another_size_is_named(self):
        shutil.copytree(self.folder / "a", self.folder / "odd")
        write_ppm(self.folder / "odd" / "01_01.ppm", Picture(2, 2, [0] * 12))
        self.refused(INPUT, "compare", "a", "odd", says=["01_01.ppm", "2 x 2"])
        write_ppm(self.folder / "odd" / "01_01.ppm", Picture(7, 5, [0] * 105), 1023)
        self.refused(INPUT, "compare", "a", "odd", says=["01_01.ppm", "10 bits"])


if __name__ == "__main__":
    main()
