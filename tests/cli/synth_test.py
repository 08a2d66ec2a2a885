"""synth: folders that encode understands, the same for the same arguments."""

import os

from pictures import read_png
from program import USAGE, CliTest, main


class Synth(CliTest):
    def synth(self, folder, *options, scene="cards", grid="2x3", size="32x20"):
        text = self.hmlfc(
            "synth", "--scene", scene, "--grid", grid, "--size", size, "-o", folder, *options
        )
        return text, self.contents(folder)

    def contents(self, folder):
        names = sorted(os.listdir(self.folder / folder))
        return {name: (self.folder / folder / name).read_bytes() for name in names}

    def test_names_and_sizes(self):
        for scene in ("cards", "knights", "glass", "flat", "noise"):
            with self.subTest(scene=scene):
                text, files = self.synth(scene, scene=scene)
                names = [f"{row:02}_{col:02}.png" for row in range(2) for col in range(3)]
                self.assertEqual(list(files), names)
                for name in names:
                    picture = read_png(self.folder / scene / name)
                    self.assertEqual((picture.width, picture.height), (32, 20))
                self.assertIn("2 x 3 views of 32 x 20 pixels, 8 bits", text)

    def test_options_matter_and_threads_do_not(self):
        _, first = self.synth("first")
        _, same = self.synth("same", "--seed", "1", "--threads", "3")
        _, seeded = self.synth("seeded", "--seed", "2")
        _, wider = self.synth("wider", "--baseline", "5.5")
        self.assertEqual(first, same)
        self.assertNotEqual(first, seeded)
        self.assertNotEqual(first, wider)

    def test_deep(self):
        self.synth("deep", "--depth", "10")
        samples = read_png(self.folder / "deep" / "00_00.png").samples
        self.assertGreater(max(samples), 255)
        # Ten bits fill sixteen: the low six repeat the high six.
        self.assertTrue(all(sample & 63 == sample >> 10 for sample in samples))

    def test_disparity(self):
        text, files = self.synth("known", "--disparity", "truth", "--threads", "2")
        self.assertEqual(files, self.synth("unknown")[1])
        truth = self.contents("truth")
        self.assertEqual(list(truth), [name.replace(".png", ".pfm") for name in files])
        for content in truth.values():
            self.assertTrue(content.startswith(b"Pf\n32 20\n-1.0\n"))
            self.assertEqual(len(content), 14 + 4 * 32 * 20)

    def test_noise_has_no_disparity(self):
        arguments = "synth --scene noise --grid 1x1 --size 4x4 -o noisy --disparity none".split()
        self.refused(USAGE, *arguments, says=["--disparity", "noise"])
        self.assertFalse((self.folder / "noisy").exists())


if __name__ == "__main__":
    main()
