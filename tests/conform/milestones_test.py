"""Milestones: a partition of the suite; what a report begins with; refusals that do not count."""

import json
import re
import shlex
import sys

from conform_case import GOLDEN, SUITE, ConformTest, main, make_suite, manifest
from program import USAGE

GROWTH = ["jpeg-2000", "keys", "blocks", "motion", "tree", "formats", "extended", "errors", "limits"]

# A decoder that has zero blocks and residuals, but no motion yet.
STOPS_AT_MOTION = """
import json, os, subprocess, sys
hmlfc, (file, _, folder) = os.environ["HMLFC"], sys.argv[1:]
info = subprocess.run([hmlfc, "info", "--json", file], stdout=subprocess.PIPE)
if info.returncode: sys.exit(1)
states = json.loads(info.stdout)["states"]
if states["motion"] + states["motion_residual"]: sys.exit("motion is not done")
sys.exit(subprocess.run([hmlfc, "decode", file, "-o", folder], stdout=subprocess.DEVNULL).returncode)
"""


class Milestones(ConformTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.whole = manifest()
        cls.names = [row["name"] for row in cls.whole["milestones"]]
        # The two smallest vectors of each milestone, and what they are based on; one that is telling.
        chosen = set()
        for name in cls.names:
            some = [v for v in cls.whole["vectors"] if v["milestone"] == name]
            for vector in sorted(some, key=lambda v: v["input"]["bytes"])[:2]:
                chosen |= {vector["id"], vector.get("base", vector["id"])}
        chosen.add("syntax/base-one-quad")
        cls.part = cls.folder / "part"
        cls.part_manifest = make_suite(cls.part, chosen)
        script = cls.folder / "stops_at_motion.py"
        script.write_text(STOPS_AT_MOTION)
        cls.growing = f"{sys.executable} -B {script} {{input}} -o {{output}}"

    def test_partition(self):
        self.assertEqual([name for name in self.names if name in GROWTH], GROWTH)
        found = []
        for name in self.names:
            rows = json.loads(self.hmlfc("vectors", "list", "--suite", SUITE, "--milestone", name, "--json"))
            self.assertTrue(rows, name)
            found += [row["id"] for row in rows]
        self.assertEqual(sorted(found), [v["id"] for v in self.whole["vectors"]])

    def test_program_that_only_refuses_passes_none(self):
        _, report = self.conform("false {input} {output}", suite=self.part, output="refuses")
        run = report["runs"][0]
        self.assertEqual(run["counts"]["pass"], 0)
        self.assertEqual(run["counts"]["fail"], self.part_manifest["count"])
        for vector in self.part_manifest["vectors"]:
            if vector["expect"]["outcome"] != "ok":
                result = self.results(report)[vector["id"]]
                self.assertTrue(result["not_counted"])
                self.assertIn(vector["base"], result["reason"])
        self.assertEqual(run["begin"]["milestone"], "jpeg-2000")
        self.assertEqual(run["begin"]["vector"], "syntax/header-one-view")  # "the stream to begin with"

    def test_decoder_that_stops_at_motion(self):
        status, report = self.conform(self.growing, suite=self.part, output="growing")
        self.assertEqual(status, 1)
        begin = report["runs"][0]["begin"]
        self.assertEqual(begin["milestone"], "motion")
        milestones = {row["name"]: row for row in begin["milestones"]}
        for name in ("jpeg-2000", "keys", "blocks"):
            self.assertEqual(milestones[name]["pass"], milestones[name]["claimed"], name)
        shape = next(v["output"] for v in self.whole["vectors"] if v["id"] == begin["vector"])
        self.assertGreater(shape["rows"] * shape["cols"], 1)
        self.assertGreater(min(shape["width"], shape["height"]), 4)
        self.hmlfc(*shlex.split(begin["inspect"])[1:])
        sizes = [len(cause["vectors"]) for cause in begin["causes"]]
        self.assertEqual(sizes[:-1], sorted(sizes[:-1], reverse=True))
        self.assertIn("motion is not done", begin["causes"][0]["cause"])
        self.assertIn("not counted", begin["causes"][-1]["cause"])
        bad = sum(r["status"] != "pass" for r in report["runs"][0]["results"])
        self.assertEqual(sum(sizes), bad)

    def test_milestone_selects(self):
        older = make_suite(self.folder / "older", {"boundary/light-field-1x1", "syntax/keys-clusters"})
        older["vectors"][0]["milestone"] = "header"  # as suites before 3.3.1 have it
        (self.folder / "older" / "manifest.json").write_text(json.dumps(older))
        for asked, suite in (("motion", self.part), ("header", self.folder / "older"), ("jpeg-2000", self.folder / "older")):
            status, report = self.conform(GOLDEN, "--milestone", asked, suite=suite)
            name = asked.replace("header", "jpeg-2000")
            self.assertEqual((status, report["runs"][0]["verdict"]), (0, f"milestone {name} is whole"))
            for result in report["runs"][0]["results"]:
                self.assertEqual(result["status"], "pass" if result["milestone"] == name else "skipped")

    def test_last_milestone(self):
        command = ("conform", "--suite", self.part, "--dut", GOLDEN, "--milestone", self.names[-1], "-o", "last")
        self.assertIn("the last one: now run all", self.hmlfc(*command))

    def test_unknown_milestone(self):
        self.refused(USAGE, "conform", "--dut", GOLDEN, "--milestone", "foo", "-o", "report", says=", ".join(self.names))

    def test_base_is_run_with_every_selection(self):
        _, report = self.conform(GOLDEN, "--filter", "error/magic")
        ran = {name for name, result in self.results(report).items() if result["status"] == "pass"}
        self.assertEqual(ran, {"error/magic", "syntax/base-main"})

    def test_waived_base_waives_what_it_spoils(self):
        dut = self.folder / "waives.json"
        waivers = [{"vector": "syntax/base-main", "reason": "later"}]
        dut.write_text(json.dumps({"name": "waives", "command": "false {input} {output}", "waivers": waivers}))
        _, report = self.conform(dut, "--filter", "error/*")
        for name in ("error/magic", "syntax/base-main"):
            self.assertEqual(self.results(report)[name].get("waiver"), "later", name)

    def test_clauses_beyond_the_claims(self):
        dut = self.folder / "main.json"
        dut.write_text(json.dumps({"name": "main", "command": GOLDEN, "profile": "main"}))
        status, _ = self.conform(dut, suite=self.part, output="main")
        self.assertEqual(status, 0)
        page = (self.folder / "main" / "report.html").read_text()
        self.assertRegex(page, r"<td>EXT-1</td><td class=\"n not_supported\">not claimed</td>")
        self.assertRegex(page, r"<td>two-references</td>.*not claimed")
        ran = [v for v in self.part_manifest["vectors"] if v["profile"] == "main" and "TIL-6" in v["clauses"]]
        count = re.search(r"<td>TIL-6</td><td class=\"n pass\">(\d+) / (\d+)</td>", page)
        self.assertEqual(set(map(int, count.groups())), {len(ran)})


if __name__ == "__main__":
    main()
