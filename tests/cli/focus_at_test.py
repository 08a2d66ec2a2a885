"""render --focus-at, the disparity of the surface that a pixel shows, in one frame and along a path; focal stacks."""

import json
import shutil
import struct

from pictures import read_png
from program import CORRUPT, INPUT, USAGE, CliTest, main

WIDTH, HEIGHT = 256, 192
NEAR = 0.3  # pixels a column


class FocusAt(CliTest):
    @classmethod
    def prepare(cls):
        synth = f"synth --scene cards --grid 3x3 --size {WIDTH}x{HEIGHT} --baseline 6 -o views --disparity truth"
        cls.hmlfc(*synth.split())
        cls.sharp = read_png(cls.folder / "views" / "01_01.png").samples
        cls.hmlfc(*"encode views -o a.hmlfc".split())
        cls.hmlfc(*"encode views -o still.hmlfc --profile main --method rlfc".split())
        cls.hmlfc(*"encode views -o main.hmlfc --profile main --method mc --references 3x3 --quality 60".split())

    def truth(self, row, col):
        """Rows from the top of what moves by how many pixels."""
        numbers = (self.folder / "truth" / f"0{row}_0{col}.pfm").read_bytes()[-4 * WIDTH * HEIGHT :]
        return [struct.unpack_from(f"<{WIDTH}f", numbers, 4 * WIDTH * y) for y in reversed(range(HEIGHT))]

    def even_places(self, row, col):
        """(x, y, disparity) of pixels around which 12 pixels to each side have one disparity."""
        truth = self.truth(row, col)
        for y in range(12, HEIGHT - 12, 8):
            for x in range(12, WIDTH - 12, 8):
                around = [d for line in truth[y - 12 : y + 13] for d in line[x - 12 : x + 13]]
                if max(around) - min(around) < 0.25:
                    yield x, y, truth[y][x]

    def around(self, samples, x, y):
        return [samples[3 * (WIDTH * j + i)] for j in range(y - 6, y + 7) for i in range(x - 6, x + 7)]

    def has_texture(self, x, y):
        samples = self.around(self.sharp, x, y)
        return max(samples) - min(samples) > 30

    def nearest_and_farthest(self):
        """Where there is texture: of what is plain a stream does not know how far away it is."""
        places = [place for place in self.even_places(1, 1) if self.has_texture(*place[:2])]
        places.sort(key=lambda place: place[2])
        self.assertGreater(places[-1][2] - places[0][2], 2)
        return places[0], places[-1]

    def focuses(self, *arguments, file="a.hmlfc"):
        shutil.rmtree(self.folder / "frames", ignore_errors=True)
        report = self.hmlfc_json("render", file, "-o", "frames", *arguments)
        return [frame["camera"]["focus"] for frame in report["frames"]]

    def blur_at(self, x, y, picture):
        """Mean difference from the sharp view within 6 pixels."""
        sharp, blurred = (self.around(s, x, y) for s in (self.sharp, read_png(self.folder / picture).samples))
        return sum(abs(a - b) for a, b in zip(sharp, blurred)) / len(sharp)

    def test_the_focus_is_that_of_the_surface(self):
        for x, y, truth in self.nearest_and_farthest():
            (found,) = self.focuses("--focus-at", f"{x},{y}")
            self.assertAlmostEqual(found, truth, delta=NEAR)
            text = self.hmlfc("render", "a.hmlfc", "--focus-at", f"{x},{y}", "--aperture", 2, "-o", "found.png")
            self.assertIn(f"\nfocus {found:g} at {x},{y}\n", text)
            self.hmlfc("render", "a.hmlfc", "--focus", found, "--aperture", 2, "-o", "given.png")
            self.assertEqual(*((self.folder / name).read_bytes() for name in ("found.png", "given.png")))

    def test_what_is_aimed_at_is_sharp_and_the_rest_is_not(self):
        near, far = self.nearest_and_farthest()
        for name, (x, y, _) in ("near.png", near), ("far.png", far):
            self.hmlfc("render", "a.hmlfc", "--focus-at", f"{x},{y}", "--aperture", 1, "-o", name)
        self.assertLess(self.blur_at(*near[:2], "near.png"), 0.5 * self.blur_at(*near[:2], "far.png"))
        self.assertLess(self.blur_at(*far[:2], "far.png"), 0.5 * self.blur_at(*far[:2], "near.png"))

    def test_a_path_keeps_what_its_first_frame_found(self):
        (x, y, _), _ = self.nearest_and_farthest()
        aimed = ["--focus-at", f"{x},{y}"]
        (first,) = self.focuses("--camera", "1.75,1", *aimed)
        self.assertEqual(self.focuses(*"--path orbit --frames 4".split(), *aimed), [first] * 4)
        # The second camera looks aside: the pixel shows something else.
        frames = [{"position": [1, 1, 0]}, {"position": [1, 1, 0], "look_at": [1.15, 1, 1]}]
        (self.folder / "aside.json").write_text(json.dumps(frames))
        (self.folder / "turned.json").write_text(json.dumps(frames[::-1]))
        here, there = (self.focuses("--path", name, *aimed) for name in ("aside.json", "turned.json"))
        self.assertEqual((here[1], there[1]), (here[0], there[0]))
        self.assertNotEqual(here, there)

    def test_a_file_aims_each_frame(self):
        (x, y, near), (far_x, far_y, far) = self.nearest_and_farthest()
        # The card moves by its disparity from a column to the next.
        frames = [{"position": [c, 1, 0], "focus_at": [round(x + (c - 1) * near), y]} for c in (0, 0.5, 1, 1.5, 2)]
        frames += [{"focus": -7.5}, {}, {"focus_at": [far_x, far_y]}, {"position": [0, 0, 0]}]
        (self.folder / "path.json").write_text(json.dumps(frames))
        found = self.focuses("--path", "path.json")
        for focus in found[:5]:
            self.assertAlmostEqual(focus, near, delta=NEAR)
        self.assertEqual(found[5:7], [-7.5, 0])
        self.assertAlmostEqual(found[7], far, delta=NEAR)
        self.assertEqual(found[8], 0)
        # With the option, frames that say nothing have what it finds in the first of them.
        again = self.focuses("--path", "path.json", "--focus-at", f"{x},{y}")
        self.assertEqual(again, [*found[:6], found[2], found[7], found[2]])

    def test_the_views_beside_a_key_image_know(self):
        (x, y, near), _ = self.nearest_and_farthest()
        self.assertIn("unknown", self.hmlfc(*"disparity main.hmlfc --view 1,1 -o none.png".split()))
        (found,) = self.focuses("--focus-at", f"{x},{y}", file="main.hmlfc")
        self.assertAlmostEqual(found, near, delta=0.6)  # vectors of whole samples

    def test_a_focal_stack_goes_from_near_to_far(self):
        near, far = self.nearest_and_farthest()
        found = self.focuses("--path", "focus", "--frames", 9)
        self.assertEqual(found, sorted(found))
        self.assertTrue(found[0] < near[2] + NEAR and found[-1] > far[2] - NEAR, found)
        for (x, y, disparity), other in (near, 8), (far, 0):
            own = min(range(9), key=lambda k: abs(found[k] - disparity))
            sharp, blurred = (self.blur_at(x, y, f"frames/frame_{k:04}.png") for k in (own, other))
            self.assertLess(sharp, 0.5 * blurred)
        self.assertEqual(self.focuses("--path", "focus", "--focus", "2..-1", "--frames", 3, file="still.hmlfc"), [2, 0.5, -1])
        self.refused(INPUT, *"render still.hmlfc --path focus -o frames".split(), says=["still.hmlfc", "--focus -2..2"])
        for wrong in ["--focus 1..2", "--path focus --focus 1", "--path focus --focus-at 1,1", "--path orbit --focus 1..2"]:
            self.refused(USAGE, "render", "a.hmlfc", *wrong.split(), "-o", "frames", says="--path focus")

    def test_refused(self):
        def refused(status, *arguments, says, file="a.hmlfc"):
            self.refused(status, "render", file, *arguments, "-o", "no.png", says=says)
            self.assertFalse((self.folder / "no.png").exists())

        refused(USAGE, "--focus-at", "1", says="--focus-at")
        refused(USAGE, "--focus-at", "1,-1", says="--focus-at")
        refused(USAGE, "--focus-at", "1,1", "--focus", "2", says=["--focus", "--focus-at"])
        refused(USAGE, "--focus-at", f"{WIDTH},0", says=[f"{WIDTH},0", f"{WIDTH} x {HEIGHT}"])
        refused(USAGE, "--focus-at", "9,30", "--size", "40x30", says="40 x 30")
        refused(USAGE, "--focus-at", "0,0", "--camera", "2.6,1", says="sees nothing")
        refused(USAGE, "--focus-at", "0,0", "--camera", "1e9,1", says="--camera's column")
        refused(INPUT, "--focus-at", "9,9", file="still.hmlfc", says=["9,9", "still.hmlfc", "--focus"])
        for camera, says in [
            ({"focus_at": [1]}, "focus_at is not"),
            ({"focus_at": [1, -1]}, "focus_at is not"),
            ({"focus_at": [1, 0.5]}, "focus_at is not"),
            ({"focus_at": [2**40, 1]}, "focus_at is not"),
            ({"focus_at": [1, 1], "focus": 1}, "both"),
        ]:
            (self.folder / "bad.json").write_text(json.dumps([{}, camera]))
            refused(INPUT, "--path", "bad.json", says=["frame 1", says])
        (self.folder / "bad.json").write_text(json.dumps([{}, {"focus_at": [WIDTH, 1]}]))
        refused(USAGE, "--path", "bad.json", says=["frame 1", f"{WIDTH},1"])
        whole = (self.folder / "a.hmlfc").read_bytes()
        damaged = whole[: len(whole) // 2] + b"\xff" * (len(whole) - len(whole) // 2)
        (self.folder / "damaged.hmlfc").write_bytes(damaged)
        refused(CORRUPT, "--focus-at", "70,50", file="damaged.hmlfc", says="damaged.hmlfc")


if __name__ == "__main__":
    main()
