"""`hmlfc conform --frames`: renderers under test."""

import json

from conform_case import INCOMPLETE, PROGRAM, ROOT, SUITE, ConformTest, main, manifest
from program import DONE, USAGE

MODEL = PROGRAM.parent / "libhmlfc_dut_model.so"
RENDER = "{hmlfc} render {input} --inputs {camera} --levels {levels} -o {output}/frame.png"
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
        self.refused(USAGE, "render", SUITE / "real/cards-main.hmlfc", "--inputs", "focal=0", "--trace", "1,1", says="focal is 0")

    def test_a_wrong_frame(self):
        """Its first wrong pixel, pictures, and the command that shows how the pixel comes about."""
        wrong = RENDER.replace("{camera}", "{camera},filter=1")
        code, report = self.frames(wrong, "--filter", "frames/blend-turned", output="wrong")
        self.assertEqual(code, 1)
        result = self.results(report)["frames/blend-turned"]
        self.assertRegex(result["reason"], r"^pixel \d+,\d+ [RGB]: \d+ instead of \d+; \d+ of 80 pixels$")
        for name in ("expected", "actual", "difference"):
            self.assertTrue((self.folder / "wrong" / result["pictures"] / f"{name}.png").is_file())
        program, *words = result["inspect"].split()
        self.assertEqual(program, "hmlfc")
        self.assertIn("SMP-3", self.hmlfc(*words))

    def test_the_first_wrong_number(self):
        code, report = self.frames(FAULTY, "--filter", "frames/blend-focus-near", output="faulty")
        self.assertEqual(code, 1)
        result = self.results(report)["frames/blend-focus-near"]
        self.assertRegex(result["stage"], r"^stage view \(RAY-4\), x of view 1,2: -?\d+ instead of -?\d+$")

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
        self.hmlfc("conform", "--suite", SUITE, "--verify", "flat-claim.json", "--dut", "flat.json", "-o", "verified")

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
        self.hmlfc("fuzz-dut", "--frames", "--dut", MODEL, "--count", "12", "--seed", "3", "-o", "fuzz")
        wrong = RENDER.replace("{camera}", "{camera},focus=9")
        command = ("fuzz-dut", "--frames", "--dut", wrong, "--count", "8", "--failures", "1", "-o", "found")
        self.assertEqual(self.run_hmlfc(*command).returncode, 1)
        found = next((self.folder / "found").glob("*.frame.json"))
        camera = json.loads(found.read_text())["camera"]
        stream = found.with_name(found.name.replace(".frame.json", ".hmlfc"))
        words = ",".join(f"{name}={value}" for name, value in camera.items())
        self.hmlfc("minimise", stream, "--dut", wrong, "--inputs", words, "--trials", "20", "-o", "small.hmlfc")
        self.assertLess((self.folder / "small.hmlfc").stat().st_size, stream.stat().st_size)
        self.refused(USAGE, "minimise", stream, "--dut", wrong, "--inputs", "nonsense=1", "-o", "x.hmlfc", says="CAM-3")


if __name__ == "__main__":
    main()
