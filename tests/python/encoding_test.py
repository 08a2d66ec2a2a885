"""hmlfc.encode and hmlfc.read_views, against the program."""

import numpy as np
from python_case import DEEP, CliTest, hmlfc, main


class EncodingTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc("synth", "--scene", "cards", "--grid", "3x4", "--size", "24x20", "-o", "views")
        cls.views = hmlfc.read_views(cls.folder / "views")

    def program(self, *arguments):
        self.hmlfc("encode", "views", "-o", "a.hmlfc", *arguments)
        return (self.folder / "a.hmlfc").read_bytes()

    def test_views_of_a_folder(self):
        self.assertEqual((self.views.pixels.shape, self.views.pixels.dtype), ((3, 4, 20, 24, 3), np.uint8))
        self.assertEqual(self.views.depth, 8)
        with self.assertRaisesRegex(OSError, "nowhere"):
            hmlfc.read_views("nowhere")

    def test_the_bytes_are_those_of_the_program(self):
        for arguments, options in [
            ([], {}),
            (["--quality", "85", "--preset", "fast"], {"quality": 85, "preset": "fast"}),
            (["--profile", "main"], {"profile": "main"}),
            (["--lossless", "--block", "8"], {"lossless": True, "block_size": 8}),
            (["--target-psnr", "34"], {"target_psnr": 34}),
            (["--max-bytes", "2500", "--chroma", "420"], {"max_bytes": 2500, "chroma": "420"}),
        ]:
            with self.subTest(options=options):
                expected = self.program(*arguments)
                self.assertEqual(hmlfc.encode(self.views, **options), expected)
                self.assertEqual(hmlfc.encode(self.views.pixels, threads=1, **options), expected)
        self.assertEqual(hmlfc.encode(self.folder / "views"), self.program())

    def test_arrays_of_any_layout(self):
        expected = hmlfc.encode(self.views)
        self.assertEqual(hmlfc.encode(np.asfortranarray(self.views.pixels)), expected)
        turned = np.ascontiguousarray(self.views.pixels[::-1, :, ::-1])
        self.assertEqual(hmlfc.encode(turned[::-1, :, ::-1]), expected)

    def test_depths_above_8(self):
        lf = hmlfc.open(DEEP)
        again = hmlfc.open(hmlfc.encode(lf[:, :], depth=10, lossless=True))
        np.testing.assert_array_equal(again[:, :], lf[:, :])

    def test_progress(self):
        told = []
        hmlfc.encode(self.views, progress=lambda done, total: told.append((done, total)))
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[-1][0], told[-1][1])

    def test_what_progress_raises(self):
        def stop(done, total):
            raise KeyError("enough")

        with self.assertRaisesRegex(KeyError, "enough"):
            hmlfc.encode(self.views, progress=stop)

    def test_wrong_arguments(self):
        pixels = self.views.pixels
        for views, options, says in [
            (pixels[0], {}, "shape"),
            (pixels[..., :2], {}, "shape"),
            (pixels[:0], {}, "0 rows"),
            (pixels.astype(np.uint16), {}, "depth"),
            (pixels.astype(np.uint16) * 5, {"depth": 10}, "more than 10 bits hold"),
            (pixels, {"depth": 10}, "depth 8"),
            (pixels.astype(np.uint16), {"depth": 13}, r"\[8, 12\]"),
            (pixels, {"profile": "best"}, "'main', 'extended'"),
            (pixels, {"quality": 101}, "quality"),
            (pixels, {"block_size": 5}, "block_size"),
            (pixels, {"tree_height": 16}, "tree_height"),
            (pixels, {"target_psnr": 30, "max_bytes": 9}, "exclude"),
        ]:
            with self.subTest(says=says), self.assertRaisesRegex(ValueError, says):
                hmlfc.encode(views, **options)
        with self.assertRaisesRegex(TypeError, "uint8 or uint16"):
            hmlfc.encode(pixels.astype(np.float32))


if __name__ == "__main__":
    main()
