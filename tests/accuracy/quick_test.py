#!/usr/bin/env python3
"""The small form of the accuracy report: what its points must say of each other, what a second run
measures, and what a run finds worse than a recorded one. quick_test.py HMLFC BENCH_ACCURACY"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import find, main  # noqa: E402  (here and below: found only now)

BENCH = find("accuracy", "numpy", "PIL", "skimage", "matplotlib", "hmlfc")

import studies  # noqa: E402
from results import read_json, write_json  # noqa: E402

HMLFC, PROGRAM = map(Path, sys.argv[1:3])
NOISE_SLACK = 1.01  # of the bytes that a larger window may take where nothing repeats


def errors(point):
    return {name: value for name, value in point.values.items() if name.startswith("mse.")}


class QuickTest(unittest.TestCase):
    """One run measures, all tests look at it."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.first = cls.run_bench("--record")
        cls.points = read_json(cls.folder / "recorded.json")
        cls.studies = {name: studies.Studies(facts["chroma"], quick=True)
                       for name, facts in cls.points.scenes.items()}

    @classmethod
    def run_bench(cls, *options, status=0):
        command = [sys.executable, "-B", BENCH, "--quick", "--json", "-o", cls.folder / "out"]
        command += ["--recorded", cls.folder / "recorded.json", "--hmlfc", HMLFC, "--bench", PROGRAM]
        result = subprocess.run([*command, *options], capture_output=True, text=True, check=False)
        if result.returncode != status:
            raise AssertionError(f"status {result.returncode}, not {status}: {result.stderr}")
        return json.loads(result.stdout)

    def of(self, scene, codings):
        found = [self.points.get(scene, coding) for coding in codings]
        self.assertNotIn(None, found)
        return found

    def test_every_point_was_measured(self):
        self.assertEqual(len(self.studies), 2)
        self.assertGreater(self.first["measured"], 50)
        self.assertEqual(self.first["reused"], 0)
        for scene in self.studies:
            self.assertTrue(self.points.of_scene(scene, frames=True))

    def test_predictions_are_measured(self):
        for facts in self.points.scenes.values():
            self.assertEqual(list(facts["prediction"]), ["mean_2", "mean_4", "vectors"])
            self.assertGreater(facts["prediction"]["mean_2"], facts["prediction"]["mean_4"])

    def test_sections_add_up_to_the_file(self):
        for point in self.points.points.values():
            if point.frame is None:
                sections = [v for name, v in point.values.items() if name.startswith("sections.")]
                self.assertEqual(sum(sections), point.values["bytes"])

    def test_measures_are_possible(self):
        for point in self.points.points.values():
            if point.frame is None:
                self.assertGreater(point.number("encode_cpu_seconds"), 0)
                self.assertGreater(point.number("decode_cpu_seconds"), 0)
                self.assertGreater(point.number("decode_peak_bytes"), point.number("bytes"))
                self.assertLessEqual(point.number("ssim_y"), 1)

    def test_coarser_parameters_take_fewer_bits_and_more_error(self):
        for scene, own in self.studies.items():
            falling = [(own.curve(method), ("bytes", "psnr_rgb")) for method in studies.CURVES]
            falling += [(own.preset(preset)[::-1], ("bytes", "psnr_rgb", "ssim_y"))
                        for preset in studies.QUICK["PRESETS"]]
            falling.append((own.block_size()[::-1], ("psnr_rgb",)))
            falling.append((own.by_references(), ("reference_bytes",)))
            for codings, values in falling:
                for value in values:
                    self.assert_falls(self.of(scene, codings), value, 0)

    def test_larger_windows_take_fewer_bits_where_views_have_parallax(self):
        for scene, own in self.studies.items():
            sizes = [point.number("bytes") for point in self.of(scene, own.window())]
            if scene == "synth-noise":
                self.assertLess(sizes[-1], NOISE_SLACK * sizes[0])
            else:
                self.assertEqual(sizes, sorted(set(sizes), reverse=True))

    def test_methods_without_motion_or_tree_hold_no_references(self):
        for scene, own in self.studies.items():
            self.assertGreater(self.of(scene, own.by_references())[0].number("reference_bytes"), 0)
            for method in ("rlfc", "mc"):
                for point in self.of(scene, own.curve(method)):
                    self.assertEqual(point.number("reference_bytes"), 0)

    def assert_falls(self, points, value, slack):
        numbers = [point.number(value) for point in points]
        for a, b in zip(numbers, numbers[1:]):
            self.assertLessEqual(b, a + slack, f"{value} of {[p.label() for p in points]}: {numbers}")

    def test_frames_have_the_errors_of_their_causes(self):
        for point in self.frames():
            n = point.number
            kind, levels, _, _ = point.frame.split(":")
            if kind == "quadrilinear":
                self.assertEqual(n("mse.filter"), 0)
                self.assertLessEqual(n("largest_fixed"), n("bound_fixed"))
                self.assertAlmostEqual(n("mse.total"), n("mse.stream"), delta=0.02 * n("mse.stream") + 1)
            else:
                self.assertGreater(n("mse.filter"), 0)
            self.assertLess(n("mse.fixed"), 1)

    def test_more_levels_are_nearer_and_a_cache_changes_work_alone(self):
        for scene, own in self.studies.items():
            for coding in own.renderer():
                points = [p for p in self.points.of_scene(scene, frames=True) if p.coding == coding]
                by = {p.frame: p for p in points}
                levels = max(int(frame.split(":")[1]) for frame in by)
                at = [by[f"quadrilinear:{k}:256:cpu"] for k in range(1, levels + 1)]
                self.assert_falls(at, "mse.total", 1e-9)
                none, whole = (by[f"quadrilinear:{levels}:{mib}:cpu"] for mib in (0, 256))
                self.assertEqual(errors(none), errors(whole))
                self.assertGreater(none.number("blocks_decoded"), whole.number("blocks_decoded"))
                golden = by[f"quadrilinear:{levels}:0:golden"]
                self.assertEqual(errors(golden), errors(whole))
                self.assertEqual(golden.number("blocks_needed"), whole.number("blocks_needed"))

    def frames(self):
        return [p for scene in self.studies for p in self.points.of_scene(scene, frames=True)]

    def test_files_are_there(self):
        for name in ("points.csv", "points.json", *(f"{study}.png" for study in studies.DRAWN)):
            self.assertGreater((self.folder / "out" / name).stat().st_size, 1000, name)

    def test_second_run_measures_nothing_and_finds_nothing(self):
        again = self.run_bench()
        skipped_groups = len({entry["what"].split()[0] for entry in again["skipped"]})
        self.assertLessEqual(again["measured"], 2 * skipped_groups)
        self.assertGreater(again["reused"], 50)
        self.assertEqual(again["changes"], [])
        self.assertEqual(again["compared"], len(self.points.points))

    def test_what_got_worse_is_named(self):
        recorded = self.folder / "recorded.json"
        kept = recorded.read_text()
        self.addCleanup(recorded.write_text, kept)
        other = read_json(recorded)
        scene, own = next(iter(self.studies.items()))
        point = other.get(scene, own.window()[0])
        point.values["bytes"] -= 1
        point.values["encode_peak_bytes"] //= 2
        write_json(other, recorded)
        found = self.run_bench("--studies", "window", status=1)["changes"]
        self.assertEqual({change["value"] for change in found}, {"bytes", "encode_peak_bytes"})
        for change in found:
            self.assertTrue(change["worse"])
            self.assertIn(point.label(), change["text"])


if __name__ == "__main__":
    main()
