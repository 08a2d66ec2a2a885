"""encode: its JSON, its promise against the decoded pictures, parameters, inputs that it refuses."""

import os
import shutil
from json import loads

from pictures import Picture, errors, psnr, read_png, write_png, write_ppm
from program import DONE, INPUT, MISSED, CliTest, main

KEYS = [
    "bytes", "bpp", "ratio", "rows", "cols", "width", "height", "profile", "method", "sections",
    "depth", "seconds", "psnr_rgb", "psnr_y", "max_abs_error",
]  # fmt: skip
SECTIONS = ["header", "index", "motion", "residual", "top", "other"]

CODINGS = [(profile, method) for profile in ("main", "extended") for method in ("hmlfc", "rlfc", "mc")]


class Encode(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 3x4 --size 44x28 -o views".split())

    def encode(self, *options, views="views", file="a.hmlfc"):
        return self.hmlfc_json("encode", views, "-o", file, *options)

    def test_json(self):
        json = self.encode("--profile", "main")
        size = (self.folder / "a.hmlfc").stat().st_size
        self.assertEqual(list(json)[: len(KEYS)], KEYS)
        self.assertEqual(list(json["sections"]), SECTIONS)
        self.assertEqual(json["bytes"], size)
        self.assertEqual(sum(json["sections"].values()), size)
        pixels = 3 * 4 * 44 * 28
        self.assertAlmostEqual(json["bpp"], 8 * size / pixels, places=12)
        self.assertAlmostEqual(json["ratio"], 3 * pixels / size, places=12)
        shape = [json[key] for key in ("rows", "cols", "width", "height")]
        self.assertEqual(shape, [3, 4, 44, 28])
        self.assertEqual((json["profile"], json["method"]), ("main", "hmlfc"))
        self.assertGreater(json["seconds"], 0)
        self.assertGreaterEqual(json["cpu_seconds"], 0)

    def test_quality_is_that_of_the_decoded_pictures(self):
        for chroma in ("420", "444"):
            with self.subTest(chroma=chroma):
                json = self.encode("--chroma", chroma)
                shutil.rmtree(self.folder / "decoded", ignore_errors=True)
                self.hmlfc("decode", "a.hmlfc", "-o", "decoded")
                rgb, luma, greatest = zip(*(
                    errors(*(read_png(self.folder / folder / name) for folder in ("views", "decoded")))
                    for name in os.listdir(self.folder / "views")
                ))  # fmt: skip
                pixels = 3 * 4 * 44 * 28
                self.assertAlmostEqual(json["psnr_rgb"], psnr(sum(rgb), 3 * pixels), places=9)
                self.assertAlmostEqual(json["psnr_y"], psnr(sum(luma), pixels), places=9)
                self.assertEqual(json["max_abs_error"], max(greatest))

    def test_lossless(self):
        for profile, method in CODINGS:
            with self.subTest(profile=profile, method=method):
                json = self.encode("--lossless", "--profile", profile, "--method", method)
                self.assertEqual((json["psnr_rgb"], json["psnr_y"]), ("inf", "inf"))
                self.assertEqual(json["max_abs_error"], 0)
                if profile == "main":
                    self.assertEqual((json["threshold_ref"], json["threshold_pred"]), (0, 0))
                self.assertEqual(self.hmlfc_json("info", "a.hmlfc")["chroma"], "444")
                self.hmlfc("compare", "views", "a.hmlfc")

    def test_rate_and_distortion_in_profile_main(self):
        for method, target in (("hmlfc", 36.5), ("mc", 40)):  # in mc, blocks of more than 128 levels pay
            main = ("--profile", "main", "--method", method, "--chroma", "444", "--target-psnr", target)
            paper, weighed = (self.encode(*main, *more) for more in ((), ("--rate-distortion",)))
            self.assertLess(weighed["bytes"], paper["bytes"])
            self.assertGreaterEqual(weighed["psnr_rgb"], target)

    def test_methods(self):
        for profile, method in CODINGS:
            with self.subTest(profile=profile, method=method):
                json = self.encode("--profile", profile, "--method", method, "--height",
                                   0 if method == "mc" else 2)  # fmt: skip
                self.assertEqual((json["profile"], json["method"]), (profile, method))
                self.assertEqual(json["sections"]["motion"] > 0, method != "rlfc")

    def test_parameters_reach_the_stream(self):
        options = "--cluster 3x2 --height 1 --block 8 --window 5 --references 2x3 --chroma 444"
        self.encode(*options.split(), *"--profile main --threshold-ref 11 --threshold-pred 222".split())
        info = self.hmlfc_json("info", "a.hmlfc")
        got = [info[key] for key in ("cluster", "tree_height", "block", "window", "chroma")]
        self.assertEqual(got, [[3, 2], 1, 8, 5, "444"])
        level = {"level": 0, "rows": 3, "cols": 4, "ref_rows": 2, "ref_cols": 3, "key_images": 0, "keys": []}
        self.assertEqual(info["levels"][1], level)
        self.noted("if rows and columns are exchanged", "encode", "views", "-o", "b.hmlfc", "--names", "{col}_{row}.png")
        self.noted("beyond 2 no images", *"encode views -o b.hmlfc --profile main --height 3".split())

    def test_thresholds(self):
        main = ["--profile", "main"]
        json = self.encode(*main, "--threshold-ref", 11, "--threshold-pred", 222)
        self.assertEqual((json["threshold_ref"], json["threshold_pred"]), (11, 222))
        fine = self.encode(*main, "--threshold-ref", 0, "--threshold-pred", 0)
        coarse = self.encode(*main, "--threshold-ref", 1000, "--threshold-pred", 1000)
        self.assertGreater(fine["psnr_rgb"], json["psnr_rgb"])
        self.assertGreater(json["psnr_rgb"], coarse["psnr_rgb"])
        self.assertLess(coarse["bytes"], json["bytes"])

    def test_target_psnr(self):
        for profile in ("main", "extended"):
            with self.subTest(profile=profile):
                target = ["--target-psnr", "36.5", "--chroma", "444"]
                json = self.encode("--profile", profile, *target)
                self.assertGreaterEqual(json["psnr_rgb"], 36.5)
                self.assertLess(json["psnr_rgb"], 37.5)
                key = "threshold_pred" if profile == "main" else "quality"
                self.assertGreater(json[key], 0)

    def test_quality(self):
        for profile in ("main", "extended"):
            results = [self.encode("--profile", profile, "--quality", q) for q in (20, 60, 90)]
            for less, more in zip(results, results[1:]):
                self.assertGreater(more["psnr_rgb"], less["psnr_rgb"], profile)
                self.assertGreater(more["bytes"], less["bytes"], profile)
        self.assertEqual([json["quality"] for json in results], [20, 60, 90])
        usual = self.encode("--profile", "main", "--quality", 60)
        self.assertEqual((usual["threshold_ref"], usual["threshold_pred"]), (75, 75))

    def test_presets(self):
        for preset in ("fast", "medium", "slow"):
            json = self.encode("--preset", preset)
            self.assertEqual(json["preset"], preset)

    def test_a_target_that_is_missed_is_said(self):
        for chroma, hint in (("420", "--chroma 444"), ("444", "--lossless")):
            with self.subTest(chroma=chroma):
                target = ["--target-psnr", "99", "--chroma", chroma]
                result = self.run_hmlfc("encode", "views", "-o", "missed.hmlfc", *target, "--json")
                self.assertEqual(result.returncode, MISSED)
                got = loads(result.stdout)["psnr_rgb"]
                self.assertLess(got, 99)
                for part in ("--target-psnr 99 was not reached", f"{got:.2f} dB", hint):
                    self.assertIn(part, result.stderr.decode())
                self.hmlfc("info", "missed.hmlfc")

    def test_target_bytes(self):
        whole = self.encode("--quality", 60)["bytes"]
        pixels = 3 * 4 * 44 * 28
        most = whole * 3 // 4
        for target in (["--max-bytes", most], ["--target-bpp", 8 * most / pixels]):
            got = self.encode(*target)["bytes"]
            self.assertLessEqual(got, most)
            self.assertGreater(got, 0.9 * most)
        result = self.run_hmlfc("encode", "views", "-o", "tiny.hmlfc", "--max-bytes", 200)
        self.assertEqual(result.returncode, MISSED)
        self.assertIn("200 bytes were not enough", result.stderr.decode())
        self.hmlfc("info", "tiny.hmlfc")

    def test_text_names_what_counts(self):
        for profile, last in (("main", "75"), ("extended", "quality 60")):
            text = self.hmlfc("encode", "views", "-o", "a.hmlfc", "--profile", profile)
            for part in ("3 x 4 views of 44 x 28", "bpp", "dB", "residual", "top", profile, last):
                self.assertIn(part, text)

    def test_names_that_need_the_grid(self):
        folder = self.folder / "list"
        folder.mkdir()
        for i, name in enumerate(sorted(os.listdir(self.folder / "views"))):
            shutil.copy(self.folder / "views" / name, folder / f"photo{i + 1}.png")
        self.refused(INPUT, "encode", "list", "-o", "b.hmlfc", says="grid")
        self.refused(INPUT, "encode", "list", "-o", "b.hmlfc", "--grid", "4x4", says="list")
        self.assertFalse((self.folder / "b.hmlfc").exists())
        order = "3x4 views in the order of number 1 of the names (1 to 12), row by row"
        self.noted(order, "encode", "list", "-o", "b.hmlfc", "--grid", "3x4")
        self.encode(file="a.hmlfc")
        self.assertEqual(
            (self.folder / "b.hmlfc").read_bytes(), (self.folder / "a.hmlfc").read_bytes()
        )

    def test_deep_samples(self):
        folder = self.folder / "deep"
        folder.mkdir()
        for i in range(4):
            samples = [(x * 173 + i * 31) % 4096 for x in range(12 * 10 * 3)]
            write_ppm(folder / f"{i // 2}_{i % 2}.ppm", Picture(12, 10, samples), 4095)
        self.encode("--lossless", views="deep", file="deep.hmlfc")
        self.assertEqual(self.hmlfc_json("info", "deep.hmlfc")["depth"], 12)
        self.hmlfc("compare", "deep", "deep.hmlfc")

    def test_a_subset_of_a_grid(self):
        """--grid takes every second row and the last columns of a larger grid."""
        (self.folder / "part").mkdir()
        for row in (0, 2):
            for col in (1, 2, 3):
                shutil.copy(self.folder / "views" / f"{row:02}_{col:02}.png", self.folder / "part")
        self.noted("rows 0 to 2 in steps of 2, columns 1 to 3", "encode", "part", "-o", "part.hmlfc")
        self.refused(INPUT, "encode", "part", "-o", "part.hmlfc", "--grid", "3x2", says="not 3x2")
        self.noted("2x3 views", *"encode part -o part.hmlfc --lossless --grid 2x3".split())
        self.hmlfc("decode", "part.hmlfc", "-o", "back")
        for row in range(2):
            for col in range(3):
                self.assertEqual(read_png(self.folder / "back" / f"{row:02}_{col:02}.png"),
                                 read_png(self.folder / "views" / f"{2 * row:02}_{col + 1:02}.png"))  # fmt: skip

    def test_views_takes_a_part_of_the_grid(self):
        for part, rows, cols in [
            ("0..2:2,1..3", (0, 2), (1, 2, 3)),
            ("1,0..3:3", (1,), (0, 3)),
            ("0..2:3,3", (0,), (3,)),
            ("01..02,2..2:9", (1, 2), (2,)),
        ]:
            with self.subTest(part=part):
                json = self.encode("--lossless", "--views", part, file="part.hmlfc")
                self.assertEqual((json["rows"], json["cols"]), (len(rows), len(cols)))
                info = self.hmlfc_json("info", "part.hmlfc")
                self.assertEqual((info["rows"], info["cols"]), (len(rows), len(cols)))
                folder = self.folder / f"back {part}"
                self.hmlfc("decode", "part.hmlfc", "-o", folder)
                for i, row in enumerate(rows):
                    for j, col in enumerate(cols):
                        self.assertEqual(read_png(folder / f"{i:02}_{j:02}.png"),
                                         read_png(self.folder / "views" / f"{row:02}_{col:02}.png"))  # fmt: skip

    def test_views_of_the_whole_grid_changes_nothing(self):
        self.encode(file="a.hmlfc")
        self.encode("--views", "0..2,0..3", file="b.hmlfc")
        self.assertEqual(
            (self.folder / "b.hmlfc").read_bytes(), (self.folder / "a.hmlfc").read_bytes()
        )

    def test_views_reads_its_part_alone(self):
        folder = self.folder / "one damaged"
        shutil.copytree(self.folder / "views", folder)
        (folder / "01_02.png").write_bytes(b"not a picture")
        self.encode("--views", "0..2:2,0..3", views=folder, file="part.hmlfc")
        command = ["encode", folder, "-o", "c.hmlfc", "--views"]
        self.refused(INPUT, *command, "1,2", says="01_02.png")
        (folder / "01_02.png").unlink()
        self.refused(INPUT, *command, "0..2:2,0..3", says=["row 1, column 2", "missing"])
        self.assertFalse((self.folder / "c.hmlfc").exists())

    def test_views_beyond_the_grid(self):
        for part, says in [
            ("0..3,0", "views: --views asks for row 3, but the grid has 3 rows (0 to 2)"),
            ("0,4294967295", "column 4294967295, but the grid has 4 columns (0 to 3)"),
        ]:
            with self.subTest(part=part):
                self.refused(INPUT, "encode", "views", "-o", "c.hmlfc", "--views", part, says=says)
                self.assertFalse((self.folder / "c.hmlfc").exists())

    def test_what_a_stream_cannot_hold_is_said(self):
        """Samples over 12 bits and alpha; nothing is said of 12 bits without alpha."""
        def write(path, bits, alpha):
            peak = 1 << bits
            samples = [i * 997 % peak for i in range(6 * 4 * (4 if alpha else 3))]
            write_png(path, Picture(6, 4, samples), bits, alpha)

        for name, bits, alpha, said in [
            ("wide", 16, False, ["16 bits", "12 bits"]),
            ("clear", 8, True, ["alpha"]),
            ("both", 16, True, ["16 bits", "alpha"]),
        ]:
            with self.subTest(name=name):
                folder = self.folder / name
                folder.mkdir()
                write(folder / "0_0.png", 8 if bits == 8 else 16, False)
                write(folder / "0_1.png", bits, alpha)
                result = self.run_hmlfc("encode", name, "-o", "lossy.hmlfc")
                self.assertEqual(result.returncode, DONE, result.stderr)
                for part in (name, *said):
                    self.assertIn(part, result.stderr.decode())
                result = self.run_hmlfc("compare", name, name, "--view", "0,1")
                self.assertEqual(result.returncode, DONE)
        samples = [i * 997 % 65536 for i in range(72)]
        (self.folder / "pnm").mkdir()
        write_ppm(self.folder / "pnm" / "0_0.ppm", Picture(6, 4, samples), 65535)
        result = self.run_hmlfc("picture", "sheet", "pnm", "-o", "sheet.png")
        self.assertIn("16 bits", result.stderr.decode())

    def test_one_tiny_view(self):
        (self.folder / "one").mkdir()
        write_ppm(self.folder / "one" / "00_00.ppm", Picture(1, 1, [1, 2, 3]))
        json = self.encode("--lossless", views="one", file="one.hmlfc")
        self.assertEqual((json["rows"], json["cols"], json["width"]), (1, 1, 1))
        self.hmlfc("compare", "one", "one.hmlfc")

    def test_views_elsewhere(self):
        for name in "high/one/two/views", "beside/views":
            shutil.copytree(self.folder / "views", self.folder / name)
        for number in range(5):
            shutil.copy(self.folder / "views/00_00.png", self.folder / f"beside/thumb{number}.png")
        for file in sorted((self.folder / "views").iterdir()):
            (self.folder / "split" / file.name[:2]).mkdir(parents=True, exist_ok=True)
            shutil.copy(file, self.folder / "split" / file.name[:2] / file.name[3:])
        for folder, says in ("high", "high/one holds"), ("beside", "beside/views holds"), ("split/01", "split/ holds"):
            self.refused(INPUT, "encode", folder, "-o", "b.hmlfc", says=f"{says} 3x4 views")

    def test_refused_inputs_are_named(self):
        def copy(name):
            shutil.copytree(self.folder / "views", self.folder / name)
            return self.folder / name

        (copy("missing") / "01_02.png").unlink()
        folder = copy("double")
        shutil.copy(folder / "01_02.png", folder / "1_2.png")
        write_ppm(copy("odd") / "01_02.ppm", Picture(3, 2, [9] * 18))
        (self.folder / "odd" / "01_02.png").unlink()
        (copy("damaged") / "01_02.png").write_bytes(b"\x89PNG\r\n\x1a\nnot really")
        (self.folder / "empty").mkdir()
        for folder, named in [
            ("missing", ["row 1", "column 2"]),
            ("double", ["01_02.png", "1_2.png"]),
            ("odd", ["01_02.ppm", "3 x 2"]),
            ("damaged", ["01_02.png"]),
            ("empty", ["empty"]),
            ("nowhere", ["nowhere"]),
        ]:
            with self.subTest(folder=folder):
                self.refused(INPUT, "encode", folder, "-o", "c.hmlfc", says=named)
                self.assertFalse((self.folder / "c.hmlfc").exists())


if __name__ == "__main__":
    main()
