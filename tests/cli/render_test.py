"""render: frames, paths, what they took, and what is refused."""

import json
import os
import struct

from pictures import chunks_of, read_png
from program import CORRUPT, DONE, INPUT, USAGE, CliTest, main


class Render(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 4x5 --size 60x44 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc --profile main --height 2".split())
        cls.hmlfc("decode", "a.hmlfc", "-o", "all")
        cls.hmlfc("decode", "a.hmlfc", "-o", "coarse", "--levels", 2)

    def picture(self, *path):
        return read_png(self.folder.joinpath(*path))

    def render(self, *arguments):
        return self.hmlfc_json("render", "a.hmlfc", *arguments)

    def gpu_frames(self, frames, *options):
        """What --backend gpu reports; without a device the command says what is missing."""
        arguments = ["render", "a.hmlfc", *f"--path line --frames {frames} --size 40x30".split()]
        ran = self.run_hmlfc(*arguments, *options, *"--backend gpu -o gpu --json".split())
        if ran.returncode == USAGE:
            self.assertIn(b"--backend gpu: ", ran.stderr)
            self.skipTest(ran.stderr.decode().strip())
        self.assertEqual(ran.returncode, DONE, ran.stderr)
        report = json.loads(ran.stdout)
        for frame in report["frames"]:
            self.assertEqual(frame["blocks_needed"], frame["blocks_decoded"] + frame["blocks_reused"])
        return report

    def assert_same_frames(self, a, b, count):
        for k in range(count):
            name = f"frame_{k:04}.png"
            files = [(self.folder / folder / name).read_bytes() for folder in (a, b)]
            self.assertEqual(*files)

    def test_at_a_view_it_is_the_view(self):
        for filter_name in ("nearest", "views", "quadrilinear"):
            arguments = ["--camera", "3,2", "--focus", "inf", "--filter", filter_name]
            self.render(*arguments, "-o", "one.png")
            self.assertEqual(self.picture("one.png"), self.picture("all", "02_03.png"))
            self.render(*arguments, "--levels", 2, "-o", "one.png")
            self.assertEqual(self.picture("one.png"), self.picture("coarse", "02_03.png"))

    def test_orbit(self):
        arguments = "--path orbit --frames 6 --size 50x40".split()
        report = self.render(*arguments, "-o", "orbit", "--preview", "orbit.png")
        self.assertEqual(sorted(os.listdir(self.folder / "orbit")),
                         [f"frame_{k:04}.png" for k in range(6)])  # fmt: skip
        self.assertEqual((report["width"], report["height"]), (50, 40))
        self.assertEqual(len(report["frames"]), 6)
        for k, frame in enumerate(report["frames"]):
            self.assertEqual(
                frame["blocks_needed"], frame["blocks_decoded"] + frame["blocks_reused"]
            )
            self.assertGreater(frame["samples_interpolated"], 0)
            self.assertEqual(frame["bytes_touched"] % 64, 0)
            self.assertEqual(frame["blocks_decoded"] > 0, frame["bytes_touched"] > 0)
            self.assertEqual(frame["file"], f"orbit/frame_{k:04}.png")
        first = report["frames"][0]
        self.assertEqual(first["blocks_needed"], first["blocks_decoded"])
        self.assertLess(first["bytes_touched"], os.path.getsize(self.folder / "a.hmlfc"))
        self.check_preview(6)
        # Neither threads nor the cache change a byte.
        for more in (["--threads", 1], ["--cache", 0], ["--threads", 3]):
            self.render(*arguments, "-o", "again", *more)
            self.assert_same_frames("again", "orbit", 6)

    def test_progressive(self):
        arguments = "--path line --frames 2 --size 50x40".split()
        report = self.render(*arguments, "--progressive", "-o", "progressive")
        names = ["{}_levels_1.png", "{}_levels_2.png", "{}.png"]
        for levels, name in enumerate(names, 1):
            self.render(*arguments, "--levels", levels, "-o", "apart")
            for k in range(2):
                frame = f"frame_{k:04}"
                self.assertEqual(
                    (self.folder / "progressive" / name.format(frame)).read_bytes(),
                    (self.folder / "apart" / f"{frame}.png").read_bytes(),
                )
        self.assertEqual(len(os.listdir(self.folder / "progressive")), 6)
        seconds = 0
        for k, frame in enumerate(report["frames"]):
            passes = [*frame["coarse"], frame]
            self.assertEqual([p["levels"] for p in passes], [1, 2, 3])
            self.assertEqual([p["file"] for p in passes],
                             [f"progressive/{n.format(f'frame_{k:04}')}" for n in names])  # fmt: skip
            self.assertTrue(all("camera" not in p for p in frame["coarse"]))
            seconds += sum(p["seconds"] for p in passes)
        self.assertAlmostEqual(report["seconds"], seconds)
        # Key images and coarser levels are read in the passes before.
        first = report["frames"][0]
        cold = self.render(*arguments, "-o", "cold")["frames"][0]
        self.assertLess(first["bytes_touched"], cold["bytes_touched"])
        decoded = [p["key_samples_decoded"] for p in [*first["coarse"], first]]
        self.assertEqual(decoded, [cold["key_samples_decoded"], 0, 0])
        self.assertGreater(decoded[0], 0)

    def test_progressive_without_coarse_frames_says_so(self):
        self.hmlfc(*"encode views -o flat.hmlfc".split())
        for arguments in (["flat.hmlfc"], ["a.hmlfc", "--levels", 1]):
            ran = self.run_hmlfc("render", *arguments, *"--progressive -o p.png".split())
            self.assertEqual(ran.returncode, DONE)
            self.assertIn(b"no coarse frames", ran.stderr)
            self.assertIn(b"--height", ran.stderr)

    def check_preview(self, frames):
        chunks = list(chunks_of((self.folder / "orbit.png").read_bytes()))
        kinds = [kind for kind, _ in chunks]
        self.assertEqual(kinds[0], "IHDR")
        self.assertEqual(kinds[-1], "IEND")
        self.assertEqual(kinds.count("fcTL"), frames)
        self.assertEqual(dict(chunks)["acTL"], struct.pack(">II", frames, 0))
        numbers = [struct.unpack(">I", body[:4])[0] for kind, body in chunks
                   if kind in ("fcTL", "fdAT")]  # fmt: skip
        self.assertEqual(numbers, list(range(len(numbers))))
        # What reads PNG alone sees the first frame.
        self.assertEqual(self.picture("orbit.png"), self.picture("orbit", "frame_0000.png"))

    def test_line_and_file(self):
        self.render(*"--path line --frames 3 -o line".split())
        cameras = [{"position": [4 * k / 2, 1.5, 0]} for k in range(3)]
        (self.folder / "path.json").write_text(json.dumps(cameras))
        report = self.render(*"--path path.json -o file".split())
        self.assertEqual([f["camera"]["position"] for f in report["frames"]],
                         [c["position"] for c in cameras])  # fmt: skip
        self.assert_same_frames("line", "file", 3)

    def test_quality_vs_time(self):
        sweep = "--quality-vs-time --size 10x10 --camera 2,1".split()
        text = self.hmlfc("render", "a.hmlfc", *sweep)
        self.assertIn("against frames computed in real numbers", text)
        rows = self.render(*"--quality-vs-time --path orbit --frames 2 --size 30x30".split())
        self.assertEqual(len(rows), 3 * 3 * 2)
        settings = {(row["filter"], row["levels"], row["cache"]): row for row in rows}
        best = settings["quadrilinear", 3, True]["psnr_rgb"]
        self.assertGreater(best, 45)
        self.assertEqual(best, max(row["psnr_rgb"] for row in rows))
        self.assertGreater(best, settings["nearest", 3, True]["psnr_rgb"])
        self.assertGreater(best, settings["quadrilinear", 1, True]["psnr_rgb"])

    def test_gpu_draws_the_same_frames(self):
        report = self.gpu_frames(6)
        self.assertEqual(report["backend"], "gpu")
        self.render(*"--path line --frames 6 --size 40x30 -o cpu".split())
        self.assertEqual(report["frames"][0]["blocks_reused"], 0)
        self.assertGreater(report["frames"][1]["blocks_reused"], 0)
        for frame in report["frames"]:
            self.assertNotIn("bytes_touched", frame)
            self.assertNotIn("key_samples_decoded", frame)
        self.assert_same_frames("gpu", "cpu", 6)

    def test_cameras_that_see_nothing_are_black(self):
        for camera in (["--camera", "2,1,-3", "--look-at", "2,1,-4"], ["--camera", "40,40"]):
            report = self.render(*camera, "-o", "black.png")
            self.assertEqual(set(self.picture("black.png").samples), {0})
            self.assertEqual(report["frames"][0]["outside"], 1)
            text = self.hmlfc("render", "a.hmlfc", *camera, "-o", "black.png")
            self.assertIn("100.00 % of the pixels lie outside the light field", text)

    def test_the_share_of_pixels_outside_is_said(self):
        self.hmlfc(*"synth --scene flat --grid 3x3 --size 40x30 -o bright".split())
        self.hmlfc(*"encode bright -o bright.hmlfc".split())
        camera = "--camera 1.5,1.2,-3 --size 30x20".split()
        arguments = ["render", "bright.hmlfc", *camera, "-o", "part.png"]
        outside = self.hmlfc_json(*arguments)["frames"][0]["outside"]
        samples = self.picture("part.png").samples
        black = sum(samples[at : at + 3] == [0, 0, 0] for at in range(0, len(samples), 3))
        self.assertEqual(outside, black / 600)
        self.assertTrue(0.01 < outside < 0.99, outside)
        self.assertIn(f"\n{100 * outside:.2f} % of the pixels lie outside", self.hmlfc(*arguments))
        whole = ["render", "bright.hmlfc", "--camera", "1,1", "-o", "whole.png"]
        self.assertEqual(self.hmlfc_json(*whole)["frames"][0]["outside"], 0)
        self.assertNotIn("outside", self.hmlfc(*whole))
        (self.folder / "share.json").write_text('[{}, {"position": [1, 1, -4]}, {"position": [1, 1, -3]}]')
        path = "--path share.json -o path".split()
        report = self.hmlfc_json("render", "bright.hmlfc", *path)
        shares = [frame["outside"] for frame in report["frames"]]
        self.assertIn(f"{100 * sum(shares) / 3:.2f} % of the pixels lie outside the light field and are "
                      f"black, at most {100 * max(shares):.2f} % in frame {shares.index(max(shares))}\n",
                      self.hmlfc("render", "bright.hmlfc", *path))  # fmt: skip

    def test_other_formats_are_refused(self):
        for name in ("r.jpg", "r.JPEG", "r.mp4", "r.hmlfc"):
            self.refused(USAGE, "render", "a.hmlfc", "-o", name, says=[name, "PNG"])
            self.assertFalse((self.folder / name).exists())
        self.refused(USAGE, "render", "a.hmlfc", "-o", "v1.0", "--preview", "p.avi", says="p.avi")
        self.render("-o", "v1.0")
        self.assertEqual(os.listdir(self.folder / "v1.0"), ["frame_0000.png"])
        self.render("-o", "big.PNG")
        self.assertTrue((self.folder / "big.PNG").is_file())

    def test_bad_cameras(self):
        for arguments, says in [
            (["--fov", "0"], "--fov"),
            (["--fov", "nan"], "--fov"),
            (["--camera", "nan,1"], "--camera"),
            (["--camera", "1"], "--camera"),
            (["--camera", "1,1,1,1"], "--camera"),
            (["--camera", "1e9,1"], "--camera's column"),
            (["--camera", "1,1,0", "--look-at", "1,1,0"], "camera's place"),
            (["--camera", "1,1,0", "--look-at", "1,9,0"], "straight above or below"),
            (["--focus", "300"], "--focus"),
            (["--focal", "0"], "--focal is 0"),
            (["--row-pitch", "99"], "--row-pitch without its sign is 99"),
            (["--size", "0x9"], "--size"),
            (["--size", "4097x9"], "--size"),
            (["--aperture", "4"], "--aperture"),
            (["--levels", "4"], "--levels 4 is outside [1, 3]"),
            (["--backend", "gpu", "--device", "none such"], "--backend gpu: "),
            (["--device", "x"], "--device needs"),
            (["--frames", "0"], "--frames"),
            (["--path", "orbit"], "name a folder"),
        ]:
            with self.subTest(arguments=arguments):
                self.refused(USAGE, "render", "a.hmlfc", "-o", "x.png", *arguments, says=says)
                self.assertFalse((self.folder / "x.png").exists())
        self.refused(USAGE, "render", "a.hmlfc", says="-o is missing")

    def test_bad_inputs(self):
        for text, says in [
            ("{", "not a JSON array"), ("[]", "not a JSON array"), ("[1]", "frame 0: not an object"),
            ('[{}, {"position": [1, 2]}]', "frame 1: position"),
            ('[{"speed": 1}]', 'unknown key "speed"'), ('[{"fov": "x"}]', "fov is not a number"),
            ('[{"fov": 130}]', "fov is 130, outside [0.2, 126] degrees"),
        ]:  # fmt: skip
            (self.folder / "bad.json").write_text(text)
            arguments = ["--path", "bad.json", "-o", "bad"]
            self.refused(INPUT, "render", "a.hmlfc", *arguments, says=says)
        self.refused(INPUT, "render", "a.hmlfc", "--path", "spiral", "-o", "bad",
                     says=["spiral", "orbit, line, focus or a JSON file"])  # fmt: skip
        self.refused(INPUT, "render", "none.hmlfc", "-o", "bad")
        damaged = bytearray((self.folder / "a.hmlfc").read_bytes())
        damaged[len(damaged) // 2 :] = b"\xff" * (len(damaged) - len(damaged) // 2)
        (self.folder / "damaged.hmlfc").write_bytes(damaged)
        self.refused(CORRUPT, "render", "damaged.hmlfc", "-o", "bad.png", says="damaged.hmlfc")
        self.assertFalse((self.folder / "bad.png").exists())


if __name__ == "__main__":
    main()
