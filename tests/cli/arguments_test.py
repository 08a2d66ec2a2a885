"""Arguments are read strictly, and each that is refused is named: exit status 2."""

import shutil

from program import INPUT, USAGE, VERSION, CliTest, main

SYNTH = ["synth", "--scene", "flat", "--grid", "2x2", "--size", "16x8", "-o", "views"]


def with_value(arguments, option, value):
    """`arguments` with another value of `option`, or with the option added."""
    arguments = list(arguments)
    if option in arguments:
        arguments[arguments.index(option) + 1] = value
        return arguments
    return [*arguments, option, value]


class Arguments(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*SYNTH)
        cls.hmlfc(*"encode views -o a.hmlfc --profile main".split())

    def test_version(self):
        self.assertEqual(self.hmlfc("--version"), f"hmlfc {VERSION}\n")

    def test_a_command_is_needed(self):
        self.refused(USAGE, says=["a command is needed", "synth", "picture"])
        self.refused(USAGE, "nonsense", says=["'nonsense'", "synth"])
        self.refused(USAGE, "bise", says="enc dec")
        self.refused(USAGE, "picture", "view.png", says=["'view.png'", "view sheet difference"])

    def test_each_command_names_what_is_missing(self):
        for command, missing in [
            (["synth"], "--scene"),
            (["encode", "views"], "--output"),
            (["encode", "-o", "x.hmlfc"], "INPUT"),
            (["decode", "a.hmlfc"], "--output"),
            (["info"], "FILE"),
            (["compare", "views"], "B"),
            (["inspect", "a.hmlfc", "--plane", "Y", "--block", "0,0"], "--view"),
            (["bise", "dec", "3"], "COUNT"),
            (["picture", "view", "views", "-o", "x.png"], "--view"),
        ]:
            with self.subTest(command=command):
                message = self.refused(USAGE, *command, says=missing)
                self.assertIn(f"hmlfc {command[0]}", message)
                self.assertIn("--help", message)

    def test_values_of_synth(self):
        for option, values in {
            "--scene": ["", "Cards", "cards ", "horse"],
            "--grid": ["", "4", "4x", "x4", "4x4x4", "0x1", "1x0", "4097x1", "1x4097", "4X4",
                       "+4x4", "-4x4", " 4x4", "4x4 ", "4.0x4", "0x4x4", "99999999999x1"],
            "--size": ["16", "0x8", "16x0", "65537x1", "1x65537", "16,8"],
            "--baseline": ["-0.5", "64.1", "nan", "inf", "two", "2px", ""],
            "--seed": ["-1", "1.5", "0x10", "", "18446744073709551616"],
            "--depth": ["7", "13", "8bit"],
            "--threads": ["-1", "1025", "two"],
        }.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    self.refused(USAGE, *with_value(SYNTH, option, value), says=option)

    def test_values_of_encode(self):
        for option, values in {
            "--grid": ["4", "0x2"],
            "--views": ["", "0", "0,", ",0", "0,0,0", "0x0", "1..0,0", "0,1..0:2", "0..1:0,0", "0..1:,0",
                        "0..1:-1,0", "0..1:1.5,0", "0:1,0", "0..,0", "..1,0", "0.1,0", "0...1,0", "0..1..2,0",
                        "0..1:1:1,0", "-1..1,0", "0..-1,0", "0, 1", " 0,1", "0 ..1,0", "a,b", "all",
                        "4294967296,0", "0..1:4294967296,0"],
            "--profile": ["Main", ""],
            "--preset": ["medium-fast", ""],
            "--quality": ["-65", "132.5", "nan", "best"],
            "--method": ["hevc", ""],
            "--cluster": ["0x1", "256x1", "2"],
            "--height": ["-1", "16", "3.0"],
            "--block": ["3", "16", "04"],
            "--window": ["-1", "128", "16px"],
            "--references": ["0x4", "4x256"],
            "--threshold-ref": ["-1", "1.5", "1e3"],
            "--threshold-pred": ["-1", ""],
            "--target-psnr": ["0.9", "100.1", "nan", "40dB"],
            "--target-bpp": ["0", "-1", "nan", "1001"],
            "--max-bytes": ["0", "-5", "1e6", "10k"],
            "--chroma": ["422", "4:2:0"],
            "--threads": ["-1"],
        }.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    self.refused(
                        USAGE, "encode", "views", "-o", "b.hmlfc", option, value, says=option
                    )

    def test_leading_zeros_are_decimal(self):
        threshold = ["--profile", "main", "--threshold-pred", "010"]
        json = self.hmlfc_json("encode", "views", "-o", "b.hmlfc", *threshold)
        self.assertEqual(json["threshold_pred"], 10)

    def test_contradictions_of_encode(self):
        for extra, named in [
            (["--lossless", "--target-psnr", "40"], "--target-psnr"),
            (["--target-bpp", "1", "--target-psnr", "40"], "--target-bpp"),
            (["--max-bytes", "1000", "--quality", "40"], "--max-bytes"),
            (["--lossless", "--threshold-ref", "0"], "--lossless"),
            (["--lossless", "--threshold-pred", "5"], "--lossless"),
            (["--lossless", "--chroma", "420"], "--chroma"),
            (["--target-psnr", "40", "--threshold-ref", "5"], "--target-psnr"),
            (["--target-psnr", "40", "--threshold-pred", "5"], "--target-psnr"),
            (["--quality", "40", "--target-psnr", "5"], "--target-psnr"),
            (["--quality", "40", "--lossless"], "--lossless"),
            (["--profile", "main", "--quality", "40", "--threshold-ref", "5"], "--quality"),
            (["--threshold-ref", "5"], "--profile main"),
            (["--profile", "main", "--preset", "fast"], "--profile extended"),
            (["--method", "mc", "--height", "2"], "--method mc"),
            (["--method", "rlfc", "--window", "4"], "--method rlfc"),
            (["--method", "rlfc", "--references", "2x2"], "--method rlfc"),
        ]:
            with self.subTest(extra=extra):
                self.refused(USAGE, "encode", "views", "-o", "b.hmlfc", *extra, says=named)
        self.hmlfc("encode", "views", "-o", "b.hmlfc", "--lossless", "--chroma", "444")
        self.hmlfc("encode", "views", "-o", "b.hmlfc", "--method", "mc", "--height", "0")

    def test_places_that_are_not_there(self):
        decode = ["decode", "a.hmlfc", "-o", "out"]
        inspect = ["inspect", "a.hmlfc", "--view", "0,0", "--plane", "Y", "--block", "0,0"]
        for command, option, values in [
            (decode, "--view", ["2,0", "0,2", "1", "-1,0", "0,0,0", "0x0"]),
            (decode, "--rect", ["0,0,17,1", "0,0,1,9", "16,0,1,1", "0,8,1,1", "0,0,0,1", "0,0,1,0",
                                "4294967295,0,2,1", "0,0,4294967295,1", "0,0,1", "-1,0,1,1"]),
            (decode, "--levels", ["0", "3", "-1", "all"]),
            (inspect, "--view", ["2,0", "0,2"]),
            (inspect, "--plane", ["y", "Cb", "0"]),
            (inspect, "--block", ["4,0", "0,2", "0", "0,0,0"]),
            (inspect, "--levels", ["0", "3"]),
            (["picture", "view", "views", "-o", "p.png"], "--view", ["2,0", "0,2"]),
            (["picture", "difference", "views", "a.hmlfc", "-o", "p.png"], "--view", ["2,0"]),
        ]:  # fmt: skip
            for value in values:
                with self.subTest(command=command[0], option=option, value=value):
                    self.refused(USAGE, *with_value(command, option, value), says=option)
        self.assertFalse((self.folder / "out").exists())
        self.assertFalse((self.folder / "p.png").exists())

    def test_blocks_of_halved_chroma(self):
        inspect = ["inspect", "a.hmlfc", "--view", "0,0", "--plane", "Co", "--block"]
        self.hmlfc(*inspect, "1,0")
        self.refused(USAGE, *inspect, "2,0", says="--block")
        self.refused(USAGE, *inspect, "0,1", says="--block")

    def test_what_is_misspelt_is_suggested(self):
        for arguments, says in [
            (["encode", "views", "-o", "b.hmlfc", "--qualty", "5"], "--qualty is not an option; did you mean --quality?"),
            (["encode", "views", "--outptu=b.hmlfc"], "--outptu is not an option; did you mean --output?"),
            (["encode", "views", "--thresh", "5"], "did you mean --threshold-ref?"),
            (["--verison"], "did you mean --version?"),
            (["encod", "views"], "'encod' is not one of its commands; did you mean encode?"),
            (["picture", "shete", "views"], "did you mean sheet?"),
            (["encode", "views", "--grid", "3", "-o", "b.hmlfc"], "'3' is not rows x columns, each in [1, 4096], such as 9x9"),
            (["decode", "a.hmlfc", "--view", "9,9", "-o", "out"], "view 9,9 does not exist: rows 0 to 1, columns 0 to 1"),
            (["picture", "view", "views", "--view", "2,0", "-o", "p.png"], "view 2,0 does not exist: rows 0 to 1, columns 0 to 1"),
        ]:  # fmt: skip
            with self.subTest(arguments=arguments):
                self.refused(USAGE, *arguments, says=says)
        self.assertNotIn("did you mean", self.refused(USAGE, "nonsense") + self.refused(USAGE, "info", "--zzz"))

    def test_options_that_do_not_apply(self):
        shutil.copy(self.folder / "views/00_00.png", self.folder / "one_qs1x1.png")
        self.hmlfc("convert", "views", "all.y4m")
        (self.folder / "one.pfm").write_bytes(b"Pf\n1 1\n-1.0\n" + bytes(4))
        (self.folder / "wide.json").write_text('[{"aperture": 1}]')
        for command, says in [
            ("convert all.y4m out --names {row}_{col}", "--names does not apply: frames of a video"),
            ("compare a.hmlfc a.hmlfc --grid 2x2", "--grid does not apply: a.hmlfc is a stream"),
            ("compare one.pfm one.pfm --view 0,0", "--view does not apply: a map"),
            ("compare one.pfm one.pfm --names *", "--names does not apply: a map"),
            ("picture sheet a.hmlfc -o p.png --order raster", "--order does not apply: a.hmlfc is a stream"),
            ("view a.hmlfc --grid 2x2", "--grid does not apply: it is for the folder of --original"),
            ("view a.hmlfc --timeout 5", "--timeout requires --dut"),
            ("encode one_qs1x1.png -o b.hmlfc --order raster", "--order does not apply: views in one picture"),
            ("encode -o b.hmlfc views --names {row}_{col} --order raster", "leave one out"),
            ("encode -o b.hmlfc views --order serpentine", "row and column of 2x2 views"),
            ("encode views -o b.hmlfc --cluster 2x2", "--cluster is of a tree"),
            ("render a.hmlfc -o p.png --frames 3", "--frames does not apply: it is for --path"),
            ("render a.hmlfc -o out --frames 3 --path wide.json", "wide.json has its own number"),
            ("render a.hmlfc -o p.png --aperture 1 --geometry stream", "--geometry stream does not apply"),
            ("render a.hmlfc -o out --path wide.json --geometry stream", "--geometry stream does not apply"),
            ("info one_qs1x1.png", "not a stream, but one picture; hmlfc encode"),
            ("compare a.hmlfc all.y4m", "not a stream, but a video; hmlfc encode"),
            ("render one.pfm -o p.png", "not a stream, but a map; hmlfc compare"),
            ("info views", "not a stream, but a folder; hmlfc encode"),
            ("render a.hmlfc -o out --trace 1,1", "--output excludes --trace"),
        ]:
            with self.subTest(command=command):
                is_usage = "views --" not in command and "not a stream" not in says
                self.refused(USAGE if is_usage else INPUT, *command.split(), says=says)
        self.assertIn(b"2 x 2 views", self.run_hmlfc(*"compare a.hmlfc views --grid 2x2".split()).stdout)

    def test_twice_and_unknown(self):
        self.refused(USAGE, *SYNTH, "--seed", "1", "--seed", "2", says="--seed")
        self.refused(USAGE, *SYNTH, "--sed", "1", says="--sed")
        self.refused(USAGE, "info", "a.hmlfc", "b.hmlfc", says="b.hmlfc")


if __name__ == "__main__":
    main()
