"""hmlfc convert."""

import configparser
import json
import shutil

import pictures
from program import INPUT, ROOT, USAGE, CliTest, main

DEEP = ROOT / "vectors" / "real" / "glass-depth10.hmlfc"


def read_png(file):
    """Width, height and samples."""
    found = pictures.read_png(file)
    return found.width, found.height, found.samples


class ConvertTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc("synth", "--scene", "cards", "--grid", "3x4", "--size", "24x16", "-o", "views")

    def same_views(self, a, b):
        names = sorted(path.name for path in (self.folder / a).iterdir())
        self.assertEqual(names, sorted(path.name for path in (self.folder / b).iterdir()))
        for name in names:
            self.assertEqual(read_png(self.folder / a / name), read_png(self.folder / b / name), name)

    def test_there_and_back(self):
        for layout in "tiles", "lenslets":
            for file in f"{layout}.png", f"{layout}.ppm":
                with self.subTest(file=file):
                    told = self.hmlfc("convert", "views", file, "--to", layout)
                    self.assertEqual(told, f"{file}: 3 x 4 views of 24 x 16 pixels, 8 bits\n")
                    self.hmlfc("convert", file, f"from-{layout}-{file[-3:]}", "--from", layout, "--grid", "3x4")
                    self.same_views("views", f"from-{layout}-{file[-3:]}")

    def test_a_quilt(self):
        self.hmlfc("convert", "views", "row_qs2x2a1.5.png", "--row", "1")
        width, height, samples = read_png(self.folder / "row_qs2x2a1.5.png")
        self.assertEqual((width, height), (48, 32))
        left = read_png(self.folder / "views/01_00.png")[2]
        self.assertEqual(samples[3 * 48 * 16 : 3 * 48 * 16 + 72], left[:72])
        self.hmlfc("convert", "row_qs2x2a1.5.png", "row")
        for col in range(4):
            self.assertEqual(
                read_png(self.folder / f"row/00_0{col}.png"), read_png(self.folder / f"views/01_0{col}.png")
            )

    def test_quilts_of_other_programs(self):
        """Their sides are no multiples of the tiles', whose aspect is not that of the name."""
        self.hmlfc("convert", "views", "row_qs2x2.ppm", "--row", "1")
        rows = (self.folder / "row_qs2x2.ppm").read_bytes()[-48 * 32 * 3:]
        rows = b"".join(rows[at:at + 144] + b"xyz" for at in range(0, len(rows), 144))
        (self.folder / "Cat_QS2x2a0.75 (1).ppm").write_bytes(b"P6 49 33 255\n" + 147 * b"x" + rows)
        told = self.run_hmlfc("convert", "Cat_QS2x2a0.75 (1).ppm", "cat").stderr.decode()
        self.assertIn("1 column of pixels on the right and 1 row of pixels on top are cut off", told)
        self.assertIn("the aspect of a tile is 1.5, the name says 0.75", told)
        for col in range(4):
            self.assertEqual(read_png(self.folder / f"cat/00_0{col}.png"), read_png(self.folder / f"views/01_0{col}.png"))

    def test_encode_reads_quilts_and_videos(self):
        self.hmlfc("convert", "views", "row_qs4x1.png", "--row", "1")
        self.hmlfc("convert", "views", "all.y4m")
        rig = {"schema": 1, "positions": [[col, 0, 0] for col in range(4)]}
        (self.folder / "line.json").write_text(json.dumps(rig))
        self.hmlfc(*"encode row_qs4x1.png -o row.hmlfc --lossless --rig line.json".split())
        self.assertEqual(self.rig_of("row.hmlfc"), rig)
        self.hmlfc(*"encode all.y4m -o all.hmlfc --lossless".split())
        self.assertIn("Identical", self.hmlfc("compare", "views", "all.hmlfc"))
        self.hmlfc("convert", "row_qs4x1.png", "one-row")
        self.assertIn("Identical", self.hmlfc("compare", "one-row", "row.hmlfc"))
        self.hmlfc("convert", "views", "all.png", "--to", "tiles")
        encode = "encode {} -o x.hmlfc".format
        self.refused(USAGE, *encode("all.png").split(), says="hmlfc convert all.png FOLDER")
        self.refused(USAGE, *encode("all.y4m").split(), "--memory", "1G", says="--memory and --plan need a folder")

    def test_a_video(self):
        self.hmlfc("decode", DEEP, "-o", "deep-views")
        for source, views, bits in (("views", "views", 10), (DEEP, "deep-views", 12)):
            for order in "raster", "serpentine":
                with self.subTest(source=source, order=order):
                    self.hmlfc("convert", source, "all.y4m", "--order", order)
                    video = (self.folder / "all.y4m").read_bytes()
                    self.assertIn(f" C444p{bits} ".encode(), video.split(b"\n")[0])
                    self.hmlfc("convert", "all.y4m", "again.y4m", "--order", "columns")
                    self.hmlfc("convert", "again.y4m", f"from-{bits}-{order}")
                    self.same_views(views, f"from-{bits}-{order}")
        self.hmlfc("convert", "views", "eight.y4m", "--bits", "8")
        self.hmlfc("convert", "eight.y4m", "nearly")
        told = self.run_hmlfc("compare", "views", "nearly").stdout.decode()
        self.assertRegex(told, "Largest error +[12]\n")

    def test_names_of_jpeg_pleno(self):
        self.hmlfc("decode", DEEP, "-o", "ten")
        for views in "views", "ten":
            with self.subTest(views=views):
                self.hmlfc("convert", views, f"pleno-{views}", "--to", "pleno")
                self.hmlfc("convert", f"pleno-{views}", f"from-pleno-{views}", "--from", "pleno")
                self.same_views(views, f"from-pleno-{views}")
        names = sorted(path.name for path in (self.folder / "pleno-views").iterdir())
        self.assertEqual(names, [f"{col:03}_{row:03}.ppm" for col in range(4) for row in range(3)])
        deep = (self.folder / "pleno-ten/000_001.ppm").read_bytes()
        self.assertTrue(deep.startswith(b"P6\n33 25\n1023\n"), deep[:20])
        # A part of the grid, whose size is given as rows x columns.
        for name in names:
            if not name.endswith("000.ppm"):
                (self.folder / "pleno-views" / name).unlink()
        self.hmlfc("convert", "pleno-views", "top", "--from", "pleno", "--grid", "1x4")
        self.assertEqual(len(list((self.folder / "top").iterdir())), 4)

    def rig_of(self, stream):
        return self.hmlfc_json("info", stream)["rig"]

    def test_rigs_go_along(self):
        synth = "synth --scene cards --grid 3x4 --size 24x16 -o posed --rig"
        self.hmlfc(*synth.split(), "posed-rig.json")
        self.hmlfc(*synth.split(), "posed/rig.json")
        self.hmlfc("convert", "posed", "posed.hmlfc")
        rig = json.loads((self.folder / "posed-rig.json").read_text())
        self.assertEqual(self.rig_of("posed.hmlfc"), rig)
        self.hmlfc("convert", "posed.hmlfc", "again.hmlfc")
        self.assertEqual(self.rig_of("again.hmlfc"), rig)
        for to in [], ["--to", "pleno"]:
            self.hmlfc("convert", "posed.hmlfc", "folder", *to)
            self.assertEqual(json.loads((self.folder / "folder/rig.json").read_text()), rig)
            shutil.rmtree(self.folder / "folder")
        self.hmlfc("convert", "posed.hmlfc", "none.hmlfc", "--no-rig")
        self.assertIsNone(self.rig_of("none.hmlfc"))
        self.hmlfc("convert", "posed", "none.hmlfc", "--no-rig")
        self.assertIsNone(self.rig_of("none.hmlfc"))
        self.hmlfc("convert", "posed", "row.hmlfc", "--row", "1")
        row = {"schema": 1, "positions": rig["positions"][4:8], "intrinsics": rig["intrinsics"][4:8]}
        self.assertEqual(self.rig_of("row.hmlfc"), row)
        told = self.run_hmlfc("convert", "posed", "posed.y4m")
        self.assertIn(b"posed.y4m: holds no rig", told.stderr)
        damaged = ROOT / "vectors/boundary/rig-positions-one.hmlfc"
        told = self.run_hmlfc("convert", damaged, "damaged.hmlfc")
        self.assertIn(b"positions has 1 entries; 2 are needed, one for each view; it is left out", told.stderr)
        self.assertIsNone(self.rig_of("damaged.hmlfc"))

    def test_folders_of_the_hci_benchmark(self):
        self.hmlfc(*"synth --scene cards --grid 3x4 --size 24x16 -o hci-from --rig hci-from/rig.json".split())
        self.hmlfc("convert", "hci-from", "hci", "--to", "hci")
        names = [f"input_Cam{number:03}.png" for number in range(12)]
        self.assertEqual(sorted(path.name for path in (self.folder / "hci").iterdir()), [*names, "parameters.cfg"])
        found = configparser.ConfigParser()
        found.read(self.folder / "hci/parameters.cfg")
        rig = json.loads((self.folder / "hci-from/rig.json").read_text())
        step = rig["positions"][1][0] - rig["positions"][0][0]
        focal, _, first, _ = rig["intrinsics"][0]
        shift = rig["intrinsics"][1][2] - first
        for section, key, value in [
            ("intrinsics", "focal_length_mm", focal * 35 / 24), ("intrinsics", "sensor_size_mm", 35),
            ("extrinsics", "num_cams_x", 4), ("extrinsics", "num_cams_y", 3),
            ("extrinsics", "baseline_mm", 1000 * step), ("extrinsics", "focus_distance_m", focal * step / shift),
        ]:  # fmt: skip
            self.assertAlmostEqual(float(found[section][key]), value, 6, key)
        # The grid is not square: the file tells it, also with the name that another system gave it.
        (self.folder / "hci/parameters.cfg").rename(self.folder / "hci/PARAMETERS.CFG")
        self.hmlfc("convert", "hci", "hci.hmlfc")
        back = self.rig_of("hci.hmlfc")
        for member in "positions", "intrinsics":
            for a, b in zip(back[member], rig[member], strict=True):
                for one, other in zip(a, b, strict=True):
                    self.assertAlmostEqual(one, other, 9)
        self.hmlfc("convert", "hci.hmlfc", "hci-again")
        (self.folder / "hci-again/rig.json").unlink()
        self.same_views("views", "hci-again")
        (self.folder / "hci/PARAMETERS.CFG").write_text("[extrinsics]\nnum_cams_x = 4\nnum_cams_y = 3\n")
        self.hmlfc("convert", "hci", "no-rig.hmlfc", "--no-rig")
        (self.folder / "hci/PARAMETERS.CFG").unlink()
        self.refused(INPUT, "convert", "hci", "x.hmlfc", says="give --grid")
        self.hmlfc(*"synth --scene cards --grid 2x2 --size 24x16 --cameras sphere -o s --rig s/rig.json".split())
        self.refused(USAGE, "convert", "s", "hci-s", "--to", "hci", says=["parameters.cfg cannot hold", "rotations[0]"])
        self.hmlfc("convert", "s", "hci-s", "--to", "hci", "--no-rig")
        self.assertEqual(len(list((self.folder / "hci-s").iterdir())), 4)

    def test_what_does_not_fit(self):
        self.hmlfc("convert", "views", "all.png", "--to", "tiles")
        for arguments, says in [
            (("views", "a_qs2x2a1.5.png"), "one row of views"),
            (("views", "a_qs3x1a1.5.png", "--row", "0"), "the views are 4 of aspect 1.5"),
            (("views", "a_qs2x2a1.6.png", "--row", "0"), "aspect 1.6"),
            (("views", "a.png"), "--to"),
            (("views", "a.jpg"), "written as .png or .ppm"),
            (("views", "a.hmlfc", "--to", "tiles"), "--to"),
            (("views", "a.y4m", "--to", "pleno"), "a picture or a folder"),
            (("views", "a.png", "--to", "pleno"), "--to pleno"),
            (("views", "a.png", "--to", "hci"), "hci are for an output that is a folder"),
            (("all.png", "a", "--from", "pleno", "--grid", "3x4"), "--from tiles (or lenslets)"),
            (("views", "a", "--bits", "8"), "--bits is for"),
            ((DEEP, "a", "--order", "raster"), "--order does not apply"),
            ((DEEP, "a", "--grid", "3x3"), "is a stream, which has its grid"),
            (("views", "a", "--from", "pleno", "--names", "{row}_{col}"), "--from pleno says"),
            ((DEEP, "a.y4m", "--bits", "8"), "--bits 8 is less than the 10 bits"),
            (("views", "a", "--to", "tiles"), "--to"),
            (("views", "a", "--from", "tiles"), "--from"),
            (("views", "a", "--row", "3"), "3,0 does not exist"),
            (("all.png", "a"), "--from tiles (or lenslets) --grid ROWSxCOLS"),
            (("views", "nowhere/a.png", "--to", "tiles"), "nowhere"),
        ]:
            with self.subTest(arguments=arguments):
                self.refused(USAGE, "convert", *arguments, says=says)
        self.refused(INPUT, "convert", "all.png", "a", "--from", "tiles", "--grid", "5x4", says="cannot be divided")
        self.refused(INPUT, "convert", "nothing.png", "a", "--from", "tiles", "--grid", "1x1", says="nothing.png")
        self.assertFalse((self.folder / "a").exists())


if __name__ == "__main__":
    main()
