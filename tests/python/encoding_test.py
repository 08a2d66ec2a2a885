"""hmlfc.encode and hmlfc.read_views, against the program."""

import shutil
import signal
import subprocess
import sys

import numpy as np
from PIL import Image
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
        np.testing.assert_array_equal(np.asarray(self.views), self.views.pixels)
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
            (["--target-bpp", "1.5"], {"target_bpp": 1.5}),
            (["--references", "3x2", "--window", "9"], {"references": (3, 2), "window": 9}),
            (["--profile", "main", "--quality", "85", "--rate-distortion"],
             {"profile": "main", "quality": 85, "rate_distortion": True}),
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
        self.assertEqual(hmlfc.encode(self.views.pixels.astype(">u2"), depth=8), expected)
        self.assertEqual(hmlfc.encode([list(row) for row in self.views.pixels]), expected)

    def test_rigs(self):
        rig = hmlfc.Rig(0.5, np.arange(36).reshape(3, 4, 3) / 8, None, np.full((3, 4, 4), 12.5))
        found = hmlfc.open(hmlfc.encode(self.views, rig=rig)).rig
        np.testing.assert_array_equal(found.positions, rig.positions)
        np.testing.assert_array_equal(found.intrinsics, rig.intrinsics)
        self.assertEqual((found.metres_per_unit, found.rotations[2, 3].tolist()), (0.5, [1, 0, 0, 0]))
        self.assertIsNone(hmlfc.open(hmlfc.encode(self.views)).rig)

        posed, file = self.folder / "posed", self.folder / "rig.json"
        shutil.copytree(self.folder / "views", posed)
        (self.folder / "posed.hmlfc").write_bytes(hmlfc.encode(self.views, rig=rig))
        file.write_text(self.hmlfc("info", "posed.hmlfc", "--rig"))
        shutil.copy(file, posed)
        expected = self.program("--rig", "rig.json", "--max-bytes", "3000")
        self.assertEqual(hmlfc.encode(posed, max_bytes=3000), expected)
        self.assertEqual(hmlfc.encode(self.views, rig=file, max_bytes=3000), expected)
        self.assertEqual(hmlfc.encode(posed, rig=False), self.program())
        for wrong, says in [(rig._replace(positions=[0, 1, 2, 3, 4, 5]), "positions"), (rig, "extended")]:
            with self.assertRaisesRegex(ValueError, says):
                hmlfc.encode(self.views, rig=wrong, profile="main" if says == "extended" else "extended")

    def test_notes_are_warnings(self):
        (self.folder / "rgba").mkdir()
        for col in range(3):
            Image.new("RGBA", (8, 8), (9, 8, 7, 6)).save(self.folder / f"rgba/00_0{col}.png")
        for use in [hmlfc.read_views, hmlfc.encode]:
            with self.assertWarnsRegex(hmlfc.Note, "00_00.png and 2 more: .*alpha") as warned:
                use(self.folder / "rgba")
            self.assertEqual(warned.filename, __file__)
        with self.assertWarnsRegex(hmlfc.Note, r"target_psnr 99 was not reached: the stream has \d+\.\d\d dB"):
            hmlfc.encode(self.views, target_psnr=99, chroma="420")
        with self.assertWarnsRegex(hmlfc.Note, r"50 bytes were not enough: the stream has \d+"):
            hmlfc.encode(self.views, max_bytes=50)

    def test_depths_above_8(self):
        lf = hmlfc.open(DEEP)
        again = hmlfc.open(hmlfc.encode(lf[:, :], depth=10, lossless=True))
        np.testing.assert_array_equal(again[:, :], lf[:, :])

    def test_progress(self):
        told = []
        hmlfc.encode(self.views, progress=lambda done, total: told.append((done, total)))
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[-1][0], told[-1][1])

    def test_what_progress_raises_and_ctrl_c_end_it(self):
        def stop(done, total):
            calls.append(total)
            raise KeyError("enough")

        def interrupt(done, total):
            calls.append(total)
            signal.raise_signal(signal.SIGINT)

        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        views = np.tile(self.views.pixels, (10, 10, 1, 1, 1))
        for progress, raised in [(stop, KeyError), (interrupt, KeyboardInterrupt)]:
            calls = []
            with self.assertRaises(raised):
                hmlfc.encode(views, progress=progress)
            self.assertLess(len(calls), calls[0])

    def test_a_daemon_thread_ends_with_python(self):
        program = f"""
import sys; sys.path[:0] = {sys.path[:3]}
import hmlfc, threading, time
views = hmlfc.read_views("views")
threading.Thread(target=lambda: [hmlfc.encode(views) for _ in iter(int, 1)], daemon=True).start()
time.sleep(0.3)"""
        found = subprocess.run([sys.executable, "-c", program], cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual((found.returncode, found.stderr), (0, b""))

    def test_wrong_arguments(self):
        pixels = self.views.pixels
        for views, options, says in [
            (pixels[0], {}, r"shape \(rows, cols, height, width, 3\), not \(4, 20, 24, 3\)"),
            (pixels[..., :2], {}, "shape"),
            (pixels[:0], {}, "0 rows"),
            (pixels.astype(np.uint16), {}, "depth"),
            (pixels.astype(np.uint16) * 5, {"depth": 10}, "more than 10 bits hold"),
            (pixels, {"depth": 10}, "depth 8"),
            (pixels.astype(np.uint16), {"depth": 13}, r"\[8, 12\]"),
            (pixels, {"profile": "best"}, "'main', 'extended'"),
            (pixels, {"rate_distortion": True}, "profile 'main'"),
            (pixels, {"quality": 133}, r"quality lies in \[-64, 132\]"),
            (pixels, {"block_size": 5}, "block_size"),
            (pixels, {"tree_height": 16}, "tree_height"),
            (pixels, {"threads": 1025}, r"threads lies in \[0, 1024\]"),
            (np.ma.masked_equal(pixels, pixels[0, 0, 0, 0, 0]), {}, "masked samples"),
            (pixels, {"target_psnr": 30, "max_bytes": 9}, "exclude"),
            (pixels, {"quality": 30, "lossless": True}, "lossless and quality exclude"),
            (pixels, {"lossless": True, "chroma": "420"}, "lossless needs"),
            (pixels, {"references": (0, 2)}, r"references is \(rows, columns\), each in \[1, 255\]"),
            (self.folder / "views", {"grid": (3, 0)}, "grid is"),
            (self.folder / "views", {"grid": (2**40, 4)}, "grid cannot be"),
            (self.folder / "views", {"depth": 10}, "depth 8, not 10"),
        ]:
            with self.subTest(says=says), self.assertRaisesRegex(ValueError, says):
                hmlfc.encode(views, **options)
        for views, options, says in [
            (pixels.astype(np.float32), {}, "uint8 or uint16, not float32"),
            (pixels, {"quality": "high"}, "quality cannot be 'high'"),
            (pixels, {"progress": 3.5}, "progress"),
        ]:
            with self.subTest(says=says), self.assertRaisesRegex((TypeError, ValueError), says):
                hmlfc.encode(views, **options)


if __name__ == "__main__":
    main()
