"""decode.py as its users see it: files, trace, exit status, the error's name."""

import paths
import json
import subprocess
import sys

from program import CORRUPT, DONE, INPUT, USAGE, CliTest, main


class CommandTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc("synth", "--scene", "cards", "--grid", "1x2", "--size", "6x5", "--depth", 9, "-o", "views")
        cls.hmlfc("encode", "views", "-o", "good.hmlfc", "--lossless")
        data = (cls.folder / "good.hmlfc").read_bytes()
        (cls.folder / "bad.hmlfc").write_bytes(data[:-1])

    def decode(self, *arguments):
        command = [sys.executable, "-B", paths.DECODER / "decode.py", *arguments]
        options = {"capture_output": True, "text": True, "check": False, "timeout": 60}
        return subprocess.run(command, cwd=self.folder, **options)

    def test_raw_views_follow_each_other_row_by_row(self):
        self.assertEqual(self.decode("good.hmlfc", "-o", "out", "--ppm").returncode, DONE)
        raw = (self.folder / "out" / "views.raw").read_bytes()
        samples = [int.from_bytes(raw[at : at + 2], "little") for at in range(0, len(raw), 2)]
        pictures = [(self.folder / "out" / name).read_bytes() for name in ("00_00.ppm", "00_01.ppm")]
        head = b"P6\n6 5\n511\n"
        body = b"".join(picture.removeprefix(head) for picture in pictures)
        self.assertTrue(all(picture.startswith(head) for picture in pictures))
        self.assertEqual(samples, [int.from_bytes(body[at : at + 2], "big") for at in range(0, len(body), 2)])
        self.hmlfc("compare", "views", "out")

    def test_the_trace_names_the_block_then_its_stages(self):
        result = self.decode("good.hmlfc", "--trace", "0,1,Co,1,0")
        block, *stages = map(json.loads, result.stdout.splitlines())
        self.assertEqual(block, {"record": "block", "view": [0, 1], "plane": "Co", "block": [1, 0]})
        self.assertEqual((stages[-1]["stage"], len(stages[-1]["values"])), ("sample", 16))
        self.assertEqual(self.decode("good.hmlfc", "--trace", "0,1,1,1,0").stdout, result.stdout)

    def test_an_invalid_stream_is_named_and_leaves_no_folder(self):
        result = self.decode("bad.hmlfc", "-o", "none")
        self.assertEqual((result.returncode, result.stderr), (CORRUPT, "truncated\n"))
        self.assertFalse((self.folder / "none").exists())
        result = self.decode("good.hmlfc", "--trace", "1,0,Y,0,0")
        self.assertEqual((result.returncode, result.stderr), (CORRUPT, "bad_request\n"))

    def test_wrong_arguments_and_missing_files(self):
        self.assertEqual(self.decode("good.hmlfc").returncode, USAGE)
        for plane in ("X", "3", "12", ""):
            self.assertEqual(self.decode("good.hmlfc", "--trace", f"0,0,{plane},0,0").returncode, USAGE)
        self.assertEqual(self.decode("missing.hmlfc", "-o", "none").returncode, INPUT)


main()
