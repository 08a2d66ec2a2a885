"""Writing: outputs appear complete or not at all, and no failure to write is silent."""

import os
import resource
import subprocess

from program import OUTPUT, PROGRAM, USAGE, CliTest, main


def limit_files(size):
    """The child cannot make a file longer than `size` bytes."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class Output(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene noise --grid 2x2 --size 64x48 -o views".split())
        cls.hmlfc("encode", "views", "-o", "a.hmlfc")

    def test_a_stream_that_does_not_fit_leaves_what_was_there(self):
        (self.folder / "old.hmlfc").write_bytes(b"\x89HMLFC\r\nas it was")
        before = sorted(os.listdir(self.folder))
        for name in ("new.hmlfc", "old.hmlfc"):
            command = ["encode", "views", "-o", name]
            self.refused(OUTPUT, *command, preexec_fn=limit_files(4096), says=name)
            self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.assertEqual((self.folder / "old.hmlfc").read_bytes(), b"\x89HMLFC\r\nas it was")

    def test_pictures_that_do_not_fit(self):
        for command in [
            ["decode", "a.hmlfc", "-o", "small"],
            ["decode", "a.hmlfc", "-o", "small", "--view", "0,0"],
            ["synth", *"--scene noise --grid 1x1 --size 64x48 -o small".split()],
        ]:
            with self.subTest(command=command):
                says = "small/00_00.png"
                self.refused(OUTPUT, *command, preexec_fn=limit_files(512), says=says)
                self.assertEqual(os.listdir(self.folder / "small"), [])

    def test_a_picture_that_does_not_fit(self):
        command = ["picture", "sheet", "views", "-o", "sheet.png"]
        self.refused(OUTPUT, *command, preexec_fn=limit_files(512), says="sheet.png")
        self.assertFalse((self.folder / "sheet.png").exists())

    def test_places_that_cannot_hold_the_output(self):
        (self.folder / "file").write_text("")
        (self.folder / "folder").mkdir(exist_ok=True)
        for path, named in [
            ("nowhere/a.hmlfc", "nowhere/a.hmlfc"),
            ("file/a.hmlfc", "file/a.hmlfc"),
            ("folder", "folder"),
            ("folder/", "folder"),
            ("/dev/null", "/dev/null"),
            ("", "--output"),
        ]:
            with self.subTest(path=path):
                self.refused(USAGE, "encode", "views", "-o", path, says=named)
                self.refused(USAGE, "picture", "sheet", "views", "-o", path, says=named)
        for path in ("file", "file/below", "/dev/null"):
            with self.subTest(path=path):
                self.refused(USAGE, "decode", "a.hmlfc", "-o", path, says=path)
                scene = "--scene flat --grid 1x1 --size 8x8".split()
                self.refused(USAGE, "synth", *scene, "-o", path, says=path)

    def test_an_unusable_place_is_told_before_the_input_is_read(self):
        self.refused(USAGE, "encode", "no-views", "-o", "nowhere/a.hmlfc", says="nowhere/a.hmlfc")

    def test_a_full_standard_output(self):
        for command in [
            ["info", "a.hmlfc"],
            ["info", "a.hmlfc", "--json"],
            ["--help"],
            ["--version"],
            ["bise", "enc", "3", "1"],
            ["inspect", "a.hmlfc", *"--view 0,0 --plane Y --block 0,0".split()],
            ["compare", "views", "views"],
        ]:
            with self.subTest(command=command), open("/dev/full", "wb") as full:
                result = self.run_hmlfc(*command, stdout=full)
                self.assertEqual(result.returncode, OUTPUT)
                self.assertIn("standard output", result.stderr.decode())

    def test_a_closed_pipe(self):
        reading, writing = os.pipe()
        os.close(reading)
        result = self.run_hmlfc("info", "a.hmlfc", stdout=writing)
        os.close(writing)
        self.assertEqual((result.returncode, result.stderr), (OUTPUT, b""))

    def test_no_standard_output_at_all(self):
        command = ["sh", "-c", f"'{PROGRAM}' info a.hmlfc >&-"]
        result = subprocess.run(
            command, cwd=self.folder, stderr=subprocess.PIPE, timeout=60, check=False
        )
        self.assertEqual(result.returncode, OUTPUT)

    def contents(self, folder):
        return {path.name: path.read_bytes() for path in (self.folder / folder).iterdir()}

    def test_what_another_wrote_is_replaced_by_force_alone(self):
        for command, name in [
            ("encode views -o other.hmlfc", "other.hmlfc"),
            ("decode a.hmlfc -o dec", "dec/01_00.png"),
            ("decode a.hmlfc --view 1,0 -o other.png", "other.png"),
            ("convert a.hmlfc con", "con/01_00.png"),
            ("convert a.hmlfc other.y4m", "other.y4m"),
            ("picture sheet a.hmlfc -o other.png", "other.png"),
            ("render a.hmlfc --camera 0,0 -o other.png", "other.png"),
            ("render a.hmlfc --path orbit --frames 2 -o ren", "ren/frame_0001.png"),
            ("disparity a.hmlfc -o other.pfm", "other.pfm"),
            ("synth --scene flat --grid 2x1 --size 8x8 -o syn", "syn/01_00.png"),
        ]:
            with self.subTest(command=command):
                path = self.folder / name
                path.parent.mkdir(exist_ok=True)
                path.write_text("as it was")
                self.refused(USAGE, *command.split(), says=(name, "--force"))
                self.assertEqual(path.read_text(), "as it was")
                self.hmlfc(*command.split(), "--force")
                self.assertNotEqual(path.read_bytes(), b"as it was")
                if not name.endswith(".pfm"):
                    self.hmlfc(*command.split())

    def test_decoding_over_the_originals(self):
        before = self.contents("views")
        self.refused(USAGE, "decode", "a.hmlfc", "-o", "views", says=("views/00_00.png", "3 more"))
        self.assertEqual(self.contents("views"), before)

    def test_an_input_is_no_output(self):
        before = self.contents("views")
        os.symlink("views", self.folder / "same")
        os.symlink("views/00_00.png", self.folder / "link")
        os.link(self.folder / "a.hmlfc", self.folder / "hard.hmlfc")
        for command in [
            "convert views views",
            "convert views same",
            "convert views ./views/../views",
            "convert a.hmlfc a.hmlfc",
            "convert a.hmlfc hard.hmlfc",
            "encode views -o link",
            "picture view views --view 0,0 -o views/00_00.png",
        ]:
            with self.subTest(command=command):
                self.refused(USAGE, *command.split(), "--force", says="input")
        self.assertEqual(self.contents("views"), before)

    def test_standard_output(self):
        self.hmlfc(*"decode a.hmlfc --view 1,0 -o one.png".split())
        self.hmlfc(*"disparity a.hmlfc -o one.pfm".split())
        self.hmlfc(*"convert a.hmlfc one.y4m".split())
        for command, same in [
            ("encode views -o -", "a.hmlfc"),
            ("decode a.hmlfc --view 1,0 -o -", "one.png"),
            ("disparity a.hmlfc -o -", "one.pfm"),
            ("convert a.hmlfc -", "one.y4m"),
        ]:
            with self.subTest(command=command):
                result = self.run_hmlfc(*command.split())
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(result.stdout, (self.folder / same).read_bytes())
                self.assertFalse((self.folder / "-").exists())
        for command in ("decode a.hmlfc -o -", "synth --scene flat --grid 2x1 --size 8x8 -o -"):
            self.refused(USAGE, *command.split(), says="standard output takes one file")

    def test_names_of_other_formats(self):
        for command, says in [
            ("encode views -o x.mp4", "a stream is written here, not .mp4"),
            ("encode views -o x.json", "not .json"),
            ("encode views -o x.hmlfc --plan", "a plan is written here"),
            ("decode a.hmlfc -o x.png", "a folder of views is written here"),
            ("convert a.hmlfc x.mp4", "not .mp4"),
            ("synth --scene flat --grid 2x1 --size 8x8 -o x.png", "a folder of views"),
        ]:
            with self.subTest(command=command):
                self.refused(USAGE, *command.split(), says=says)


if __name__ == "__main__":
    main()
