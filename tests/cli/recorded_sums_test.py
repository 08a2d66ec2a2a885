"""Streams, decoded views and frames are byte for byte those of recorded_sums.json.

recorded_sums_test.py PROGRAM VERSION --record writes that file anew: only for a change that is meant
to alter what the encoder decides or what the renderer computes, never to make the test pass.
"""

import hashlib
import json
import sys
from pathlib import Path

from pictures import read_png
from program import CliTest, main

RECORD = Path(__file__).with_name("recorded_sums.json")

# Light field: arguments of synth.
SCENES = {
    "cards": "--scene cards --grid 4x5 --size 72x52",
    "knights": "--scene knights --grid 5x3 --size 64x48 --baseline 4",
    "glass": "--scene glass --grid 3x3 --size 50x46 --baseline 1",
    "noise": "--scene noise --grid 2x3 --size 40x36",
    "flat": "--scene flat --grid 3x3 --size 48x48",
    "deep": "--scene cards --grid 3x4 --size 44x36 --depth 12",
}
# Arguments of encode.
CODINGS = [
    *(f"--profile {p} --method {m}" for p in ("main", "extended") for m in ("hmlfc", "rlfc", "mc")),
    "--profile main --height 2 --block 2 --window 8 --cluster 3x2 --references 2x3 --chroma 444",
    "--profile main --block 8 --threshold-ref 10 --threshold-pred 200 --chroma 420",
    "--profile main --chroma 444 --target-psnr 33",
    "--profile extended --preset fast --quality 30",
    "--profile extended --preset slow --quality 80",
    "--profile extended --height 2 --references 2x2 --chroma 444",
    "--profile extended --block 8 --window 16",
    "--profile extended --chroma 444 --target-psnr 31",
    "--lossless",
    "--profile main --lossless",
]
# Arguments of render.
FRAMES = [
    "--path orbit --frames 3 --size 40x30",
    "--path line --frames 2 --size 33x21 --filter views --focus 1.5",
    "--camera 2,1.5,-1 --size 48x40 --aperture 1 --focus 2",
    "--camera 1.3,1.1,0.2 --look-at 1.5,1.5,4 --size 36x36 --filter nearest --fov 50",
]


def digest(data):
    return hashlib.sha256(data).hexdigest()


class RecordedSums(CliTest):
    def pixels(self, folder):
        """The sum of the pixels of all pictures in `folder`, whatever their compression."""
        total = hashlib.sha256()
        for path in sorted((self.folder / folder).iterdir()):
            picture = read_png(path)
            total.update(f"{path.name} {picture.width} {picture.height} ".encode())
            total.update(b"".join(sample.to_bytes(2, "big") for sample in picture.samples))
        return total.hexdigest()

    def measure(self):
        sums = {}
        for scene, arguments in SCENES.items():
            self.hmlfc("synth", *arguments.split(), "-o", scene)
            sums[f"synth {scene}"] = self.pixels(scene)
            for index, coding in enumerate(CODINGS):
                file = f"{scene}-{index}.hmlfc"
                self.hmlfc("encode", scene, "-o", file, "--threads", 1 + index % 3, *coding.split())
                sums[f"encode {scene} {coding}"] = digest((self.folder / file).read_bytes())
        for scene, index in (("cards", 0), ("knights", 11), ("deep", 3), ("glass", 14)):
            file = f"{scene}-{index}.hmlfc"
            self.hmlfc("decode", file, "-o", f"{file}.views")
            sums[f"decode {scene} {CODINGS[index]}"] = self.pixels(f"{file}.views")
            for number, frames in enumerate(FRAMES):
                folder = f"{file}.frames{number}"
                self.hmlfc("render", file, "-o", folder, "--geometry", "plane", *frames.split())
                sums[f"render {scene} {CODINGS[index]} {frames}"] = self.pixels(folder)
        return sums

    def test_sums(self):
        recorded = json.loads(RECORD.read_text())
        measured = self.measure()
        self.assertEqual(list(measured), list(recorded))
        different = [name for name in recorded if measured[name] != recorded[name]]
        self.assertEqual(different, [])


def record():
    RecordedSums.setUpClass()
    try:
        RECORD.write_text(json.dumps(RecordedSums().measure(), indent=1) + "\n")
    finally:
        RecordedSums.doClassCleanups()


if __name__ == "__main__":
    if "--record" in sys.argv:
        record()
    else:
        main()
