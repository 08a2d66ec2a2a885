"""`hmlfc conform --frames`: renderers under test."""

import json

from conform_case import INCOMPLETE, PROGRAM, ROOT, SUITE, ConformTest, main, manifest
from program import DONE, USAGE

MODEL = PROGRAM.parent / "libhmlfc_dut_model.so"
RENDER = "{hmlfc} render {input} --inputs {camera} --levels {levels} -o {output}/frame.png"
CARDS = SUITE / "real/cards-main.hmlfc"
FAULTY = f"lines: python3 -B {ROOT}/tests/conform/faulty_renderer.py"


class Frames(ConformTest):
    def frames(self, dut, *arguments, output="frames"):
        return self.conform(dut, "--frames", *arguments, suite=SUITE, output=output)

    def test_a_command_line_with_a_camera(self):
        code, report = self.frames(RENDER, "--milestone", "rays")
        self.assertEqual(code, DONE)
        self.assertEqual(report["runs"][0]["verdict"], "milestone rays is whole")
        names = [step["name"] for step in report["runs"][0]["begin"]["milestones"]]
        self.assertEqual(names, [step["name"] for step in manifest()["frame_milestones"]])

    def test_a_command_line_with_a_record(self):
        """It takes no cameras: those that must be refused are not asked for."""
        shot = '{"record": [{record}], "stop_level": {stop_level}}'
        command = f"python3 -B {ROOT}/tests/naive_decoder/render.py {{input}} '{shot}' -o {{output}}/frame.raw"
        code, report = self.frames(command, "--filter", "frames/refused-focal-*", "--filter", "frames/ray-odd-frame")
        self.assertEqual(code, INCOMPLETE)
        results = self.results(report)
        self.assertEqual(results["frames/ray-odd-frame"]["status"], "pass")
        self.assertEqual(results["frames/refused-focal-below"]["status"], "not_supported")

    def test_a_renderer_s_command_line(self):
        """It takes a record or a camera; and a milestone of renderers is one of --frames alone."""
        command = ("conform", "--suite", SUITE, "-o", "none", "--dut")
        self.refused(USAGE, *command, "true {input} {output}", "--frames", says="{record} or {camera}")
        self.refused(USAGE, *command, RENDER, "--milestone", "rays", says="add --frames")
        self.refused(USAGE, *command, RENDER, "--frames", "--milestone", "keys", says="leave out --frames")
        for words, says in (
            ("focal=0", "focal is 0, outside [1, 65536]"),
            ("filter=0,frame_width=1.5", "frame_width is 1.5, no integer up to 4096"),
            ("pu=1,pv=0", "pu, pv and pz are one point"),
            ("focs=1", '"focs" is no input of CAM-3: these are frame_width, '),
        ):
            self.refused(USAGE, "render", CARDS, "--inputs", words, "--trace", "1,1", says=says)

    def test_what_a_command_line_writes(self):
        """One file with the frame and nothing after it, unless an error is due."""
        for after, says in (
            ("cp $2/frame.png $2/frame.ppm", "output: has frame.png and frame.ppm: one is enough"),
            ("echo more >>$2/frame.png", "output/frame.png: goes on after the end of the picture"),
            ("mv $2/frame.png $2/view.png", 'output: has "view.png" instead of frame.raw or frame.png or frame.ppm, 6 x 5 pixels'),
            ("rm $2/frame.png", "output: is empty instead of frame.raw"),
        ):
            dut = f"sh -c '{PROGRAM} render $0 --inputs $1 -o $2/frame.png && {after}' {{input}} {{camera}} {{output}}"
            _, report = self.frames(dut, "--filter", "frames/start", output="writes")
            self.assertIn("wrong output: " + says, self.results(report)["frames/start"]["reason"])
        _, report = self.frames("true {input} {camera} {output}", "--filter", "frames/refused-focal-below", output="writes")
        self.assertEqual(self.results(report)["frames/refused-focal-below"]["reason"], "the frame: no error instead of focal")

    def test_a_wrong_frame(self):
        """Its first wrong pixel, pictures, and the command that shows how the pixel comes about."""
        wrong = RENDER.replace("{camera}", "{camera},filter=1")
        code, report = self.frames(wrong, "--filter", "frames/blend-turned", output="wrong")
        self.assertEqual(code, 1)
        self.assertEqual(report["runs"][0]["begin"]["causes"][0]["cause"], "wrong pixels in milestone plane")
        result = self.results(report)["frames/blend-turned"]
        self.assertRegex(result["reason"], r"^pixel \d+,\d+ [RGB]: \d+ instead of \d+; \d+ of 80 pixels$")
        for name in ("expected", "actual", "difference"):
            self.assertTrue((self.folder / "wrong" / result["pictures"] / f"{name}.png").is_file())
        program, *words = result["inspect"].split()
        self.assertEqual(program, "hmlfc")
        self.assertIn("SMP-3", self.hmlfc(*words))

    def test_the_first_wrong_number(self):
        wrong = r"pixel 0,0 R: \d+ instead of \d+; \d+ of \d+ pixels"
        for other, reason, stage in (
            ("", wrong, r"stage view \(RAY-4\), x of view 1,2: -?\d+ instead of -?\d+"),
            ("silent", wrong, "the renderer's trace has no number to compare"),
            ("failing", wrong, "no trace: bad_mode"),
            ("ending", wrong + "; and then its trace: exit status 0 without an answer at .*", ""),
            ("number-42", r'wrong answer to \'record .*\': "42" after 41 numbers', ""),
        ):
            code, report = self.frames(f"{FAULTY} {other}", "--filter", "frames/blend-focus-near", output="faulty")
            self.assertEqual(code, 1)
            result = self.results(report)["frames/blend-focus-near"]
            self.assertRegex(result["reason"], f"^{reason}$")
            self.assertRegex(result.get("stage", ""), f"^{stage}$")

    def test_a_profile_and_a_claim(self):
        """A renderer of profile plane claims no frame with geometry."""
        declared = {"name": "flat", "library": str(MODEL), "renderer": {"profile": "plane", "frame_width": 20}}
        (self.folder / "flat.json").write_text(json.dumps(declared))
        code, report = self.frames("flat.json", "--claim", self.folder / "flat-claim.json")
        self.assertEqual(code, DONE)
        results = self.results(report)
        self.assertEqual(results["frames/surface-knights"]["status"], "not_supported")
        self.assertEqual(results["frames/ray-whole-view"]["reason"], "frame of 40 x 32")
        claim = json.loads((self.folder / "flat-claim.json").read_text())["claim"]
        self.assertEqual(claim["claims"]["renderer"]["profile"], "plane")
        self.assertEqual(claim["suite"]["part"], "frames")
        self.assertEqual(claim["results"]["frames/blend-all"], "pass")
        self.assertRegex(claim["milestones"]["geometry"], r"^0 of \d+ pass$")
        self.hmlfc("conform", "--suite", SUITE, "--verify", "flat-claim.json", "--dut", "flat.json", "-o", "verified", "--json")

    def test_a_suite_without_frames(self):
        older = {key: value for key, value in self.manifest.items() if "frame" not in key}
        (self.folder / "older").mkdir()
        (self.folder / "older" / "manifest.json").write_text(json.dumps(older))
        command = ("conform", "--frames", "--suite", "older", "--dut", RENDER, "-o", "none")
        self.refused(3, *command, says="has no frames")

    def test_a_manifest_that_asks_for_what_the_stream_does_not_have(self):
        """An error of the suite, whatever the renderer does."""
        whole = manifest()
        frames = {frame["id"]: frame for frame in whole["frames"]}
        wide, level, tall, map_ = (json.loads(json.dumps(frames[f"frames/{name}"])) for name in (
            "ray-straight", "ray-odd-frame", "blend-all", "map-cards-main-1-2"))
        wide["frame"]["width"], level["stop_level"], map_["map"]["columns"] = 4096, 15, 4294967295
        tall["record"][1] = 4096
        folder = self.folder / "lies"
        folder.mkdir()
        (folder / "real").symlink_to(SUITE / "real")
        (folder / "manifest.json").write_text(json.dumps({**whole, "frames": [wide, level, tall, map_]}))
        _, report = self.conform(MODEL, "--frames", suite=folder, output="lied")
        results = self.results(report).values()
        self.assertEqual({(result["status"], result["reason"]) for result in results},
                         {("error", "the manifest asks for what the stream does not have")})

    def test_a_renderer_decodes_no_views(self):
        code, report = self.conform(RENDER, output="views")
        self.assertEqual(code, INCOMPLETE)
        self.assertEqual({result["status"] for result in report["runs"][0]["results"]}, {"not_supported"})

    def test_fuzz_and_minimise(self):
        right = self.run_hmlfc("fuzz-dut", "--frames", "--dut", MODEL, "--count", "12", "--seed", "3", "-o", "fuzz")
        self.assertEqual(right.returncode, DONE, right.stderr)
        wrong = RENDER.replace("{camera}", "{camera},focus=9")
        command = ("fuzz-dut", "--frames", "--dut", wrong, "--count", "8", "--failures", "1", "-o", "found")
        self.assertEqual(self.run_hmlfc(*command).returncode, 1)
        found = next((self.folder / "found").glob("*.frame.json"))
        camera = json.loads(found.read_text())["camera"]
        stream = found.with_name(found.name.replace(".frame.json", ".hmlfc"))
        words = ",".join(f"{name}={value}" for name, value in camera.items())
        self.hmlfc("minimise", stream, "--dut", wrong, "--inputs", words, "--trials", "20", "-o", "small.hmlfc")
        self.assertLess((self.folder / "small.hmlfc").stat().st_size, stream.stat().st_size)

    def test_minimise_a_map(self):
        """It keeps the view."""
        self.hmlfc("minimise", CARDS, "--dut", f"{FAULTY} map", "--map", "1,2", "--trials", "12", "-o", "map.hmlfc")
        self.assertLess((self.folder / "map.hmlfc").stat().st_size, CARDS.stat().st_size)
        self.assertGreaterEqual(self.hmlfc_json("info", "map.hmlfc")["cols"], 3)


if __name__ == "__main__":
    main()
