"""Traces of pixels by docs/rendering.md in Python, against hmlfc render; frames are compared by conform.naive--frames."""

import paths
import json
import subprocess
import sys

from camera import Camera
from frame import render
from frame_trace import trace
from picture_files import ppm_bytes, raw_bytes
from program import CORRUPT, DONE, ROOT, USAGE, CliTest, main

# Frames of the suite by what their pixels are made of.
TRACED = ("ray-straight", "ray-wide", "blend-views-focus", "aperture-2-border", "surface-knights", "surface-explicit-focus")


class TracesOfPixels(CliTest):
    def test_the_program_computes_the_same_numbers(self):
        frames = {frame["id"]: frame for frame in json.loads((ROOT / "vectors/manifest.json").read_text())["frames"]}
        stages = set()
        for name in TRACED:
            frame = frames[f"frames/{name}"]
            file = ROOT / "vectors" / frame["input"]["file"]
            inputs = ",".join(f"{name}={value}" for name, value in frame["camera"].items())
            for x, y in ((0, 0), (4, 3), (7, 5)):
                told = self.hmlfc_json("render", file, "--inputs", inputs, f"--trace={x},{y}")
                self.assertEqual(told, trace(file.read_bytes(), frame["record"], x, y), f"{name} {x},{y}")
                stages |= {stage["stage"] for stage in told["stages"]}
        self.assertEqual(stages, {"record", "cell ray", "proposal", "cell", "ray", "view", "sum"})

    def test_a_record_of_another_light_field(self):
        data = [(ROOT / f"vectors/{name}.hmlfc").read_bytes() for name in ("syntax/depth-9", "syntax/tree-3")]
        words = list(render(data[0], Camera()).record.values())
        for wrong in (words[:-1], words + [0]):
            self.assertRaises(ValueError, render, data[0], wrong)
        self.assertRaises(ValueError, render, data[1], words)


class RenderCommand(CliTest):
    """render.py as its users see it."""

    def ran(self, name, *arguments):
        command = [sys.executable, "-B", paths.DECODER / "render.py", ROOT / f"vectors/{name}.hmlfc", *arguments]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False, timeout=60)

    def test_files_and_counts(self):
        data = (ROOT / "vectors/syntax/depth-9.hmlfc").read_bytes()
        camera = Camera(position=(0.5, 0.5, 0.0), frame_width=5, frame_height=4)
        frame = render(data, camera)
        shots = [{"position": [0.5, 0.5, 0], "frame_width": 5, "frame_height": 4}]
        shots.append({"record": list(frame.record.values()), "stop_level": 0})
        for shot in shots:
            for file, as_bytes in (("frame.raw", raw_bytes), ("frame.ppm", ppm_bytes)):
                result = self.ran("syntax/depth-9", json.dumps(shot), "-o", file)
                self.assertEqual((result.returncode, json.loads(result.stdout)), (DONE, frame.counts), result.stderr)
                self.assertEqual((self.folder / file).read_bytes(), as_bytes(frame.samples, 9))
            result = self.ran("syntax/depth-9", json.dumps(shot), "--trace", "1,2")
            self.assertEqual(json.loads(result.stdout), trace(data, camera, 1, 2))

    def test_errors(self):
        self.assertEqual(self.ran("error/version-2", "{}", "-o", "none").stderr, "bad_version\n")
        result = self.ran("error/level-base-28", '{"position": [1, 0, 0]}', "-o", "none")
        self.assertEqual((result.returncode, result.stderr[:13]), (CORRUPT, "bad_levels 0 "))
        result = self.ran("syntax/depth-9", '{"focal": 0}', "-o", "none")
        self.assertEqual((result.returncode, result.stderr), (USAGE, "focal\n"))
        for shot in ("", "{", '{"zoom": 1}', '{"record": [1, 2]}', "[]", "3"):
            self.assertEqual(self.ran("syntax/depth-9", shot, "-o", "none").returncode, USAGE, shot)
        self.assertEqual(self.ran("syntax/missing", "{}", "-o", "none").returncode, 3)
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    main()
