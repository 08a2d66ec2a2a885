"""picture view, sheet, difference and epipolar, from folders and from streams."""

from pictures import read_png
from program import INPUT, USAGE, CliTest, main


class Pictures(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 2x3 --size 40x24 -o views".split())
        cls.hmlfc("encode", "views", "-o", "a.hmlfc")
        cls.hmlfc("decode", "a.hmlfc", "-o", "decoded")

    def picture(self, *arguments):
        text = self.hmlfc("picture", *arguments, "-o", "picture.png")
        picture = read_png(self.folder / "picture.png")
        self.assertEqual(text, f"picture.png: {picture.width} x {picture.height} pixels\n")
        return picture

    def test_view(self):
        for folder, source in [("views", "views"), ("decoded", "decoded"), ("decoded", "a.hmlfc")]:
            with self.subTest(source=source):
                expected = read_png(self.folder / folder / "01_02.png")
                self.assertEqual(self.picture("view", source, "--view", "1,2"), expected)

    def test_sheet(self):
        sheet = self.picture("sheet", "views")
        self.assertEqual((sheet.width, sheet.height), (3 * 40 + 2 * 2, 2 * 24 + 2))
        for row in range(2):
            for col in range(3):
                view = read_png(self.folder / "views" / f"{row:02}_{col:02}.png")
                self.assertEqual(sheet.crop(col * 42, row * 26, 40, 24), view)
        self.assertEqual(self.picture("sheet", "decoded"), self.picture("sheet", "a.hmlfc"))

    def test_sheet_is_reduced(self):
        sheet = self.picture("sheet", "views", "--max-width", "64")
        self.assertEqual((sheet.width, sheet.height), (3 * 20 + 2 * 2, 2 * 12 + 2))
        view = read_png(self.folder / "views" / "00_00.png")
        box = [view.pixel(x, y) for y in (0, 1) for x in (0, 1)]
        mean = [(sum(channel) + 2) // 4 for channel in zip(*box)]
        self.assertEqual(sheet.pixel(0, 0), mean)

    def test_difference(self):
        a = read_png(self.folder / "views" / "01_00.png")
        b = read_png(self.folder / "decoded" / "01_00.png")
        for gain in (1, 8, 100):
            expected = [
                max(0, min(255, 128 + gain * (p - q))) for p, q in zip(a.samples, b.samples)
            ]
            extra = ["--gain", gain] if gain != 8 else []
            got = self.picture("difference", "views", "a.hmlfc", "--view", "1,0", *extra)
            self.assertEqual(got.samples, expected)
        self.assertTrue(any(sample != 128 for sample in expected))

    def test_epipolar(self):
        views = {(r, c): read_png(self.folder / f"decoded/{r:02}_{c:02}.png") for r in range(2) for c in range(3)}
        of_row = self.picture(*"epipolar a.hmlfc --row 1 --y 20 --thickness 1".split())
        for col in range(3):
            self.assertEqual(of_row.crop(0, col, 40, 1), views[1, col].crop(0, 20, 40, 1))
        of_column = self.picture(*"epipolar decoded --col 2 --x 7".split())
        self.assertEqual((of_row.height, of_column.width, of_column.height), (3, 2 * 8, 24))
        for x in range(16):
            self.assertEqual(of_column.crop(x, 0, 1, 24), views[x // 8, 2].crop(7, 0, 1, 24))
        for place in ["", "--row 1", "--row 2 --y 0", "--row 0 --y 24", "--col 0 --y 0", "--col 0 --x 40"]:
            self.refused(USAGE, "picture", "epipolar", "views", *place.split(), "-o", "x.png")

    def test_refused(self):
        self.hmlfc(*"synth --scene flat --grid 2x3 --size 16x16 -o other".split())
        view = ["--view", "0,0", "-o", "x.png"]
        self.refused(INPUT, "picture", "difference", "views", "other", *view, says="size")
        self.refused(INPUT, "picture", "view", "nowhere", *view, says="nowhere")
        self.assertFalse((self.folder / "x.png").exists())


if __name__ == "__main__":
    main()
