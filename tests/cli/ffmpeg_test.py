"""render --preview with the program ffmpeg itself: the animations have the frames. Skipped without it."""

import shutil
import subprocess
import sys

from pictures import read_png
from program import SKIPPED, CliTest, main

WIDTH, HEIGHT = 63, 47  # no even sides


class Video(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene knights --grid 4x4 --size 64x48 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc".split())
        # The folder has more frames, of two sizes, than the animations.
        cls.hmlfc(*"render a.hmlfc --path line --frames 9 -o orb%dit".split())
        cls.hmlfc(*f"render a.hmlfc --path line --frames 7 --size {WIDTH}x{HEIGHT} -o orb%dit".split())

    def frames_of(self, video, width, height):
        """Samples R, G, B of each frame."""
        command = ["ffmpeg", "-v", "error", "-i", video, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
        raw = subprocess.run(command, cwd=self.folder, capture_output=True, check=True, stdin=subprocess.DEVNULL).stdout
        size = 3 * width * height
        self.assertEqual(len(raw) % size, 0)
        return [raw[at : at + size] for at in range(0, len(raw), size)]

    def check(self, name, width, height):
        path = f"--path orbit --frames 5 --size {WIDTH}x{HEIGHT} -o orb%dit".split()
        self.hmlfc("render", "a.hmlfc", *path, "--preview", name)
        made = self.frames_of(name, width, height)
        self.assertEqual(len(made), 5)
        true = [read_png(self.folder / "orb%dit" / f"frame_{k:04}.png").samples for k in range(5)]

        def error(a, b):
            rows = [(a[3 * width * y :][: 3 * WIDTH], b[3 * WIDTH * y :][: 3 * WIDTH]) for y in range(HEIGHT)]
            return sum(abs(p - q) for row in rows for p, q in zip(*row)) / (3 * WIDTH * HEIGHT)

        for k in range(5):
            errors = [error(made[k], frame) for frame in true]
            self.assertEqual(errors.index(min(errors)), k, errors)
            self.assertLess(errors[k], 12)

    def test_gif(self):
        self.check("orbit.gif", WIDTH, HEIGHT)

    def test_mp4(self):
        self.check("orbit.mp4", WIDTH + 1, HEIGHT + 1)


if __name__ == "__main__":
    if shutil.which("ffmpeg") is None:
        print("skipped: no program ffmpeg")
        sys.exit(SKIPPED)
    main()
