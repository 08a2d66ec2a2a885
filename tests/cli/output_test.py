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
        (self.folder / "old.hmlfc").write_text("as it was")
        before = sorted(os.listdir(self.folder))
        for name in ("new.hmlfc", "old.hmlfc"):
            command = ["encode", "views", "-o", name]
            self.refused(OUTPUT, *command, preexec_fn=limit_files(4096), says=name)
            self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.assertEqual((self.folder / "old.hmlfc").read_text(), "as it was")

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


if __name__ == "__main__":
    main()
