"""`hmlfc conform`: which vectors run, what their results amount to, and how runs are put together."""

import json
import shutil
from pathlib import Path

from conform_case import COARSE, GOLDEN, INCOMPLETE, ROOT, SUITE, ConformTest, main
from program import DONE, INPUT, USAGE


class Runner(ConformTest):
    def declaration(self, name, **keys):
        """A DUT file of the golden model."""
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps({"name": name, "command": GOLDEN, "error_names": True, **keys}))
        return path

    def statuses(self, report):
        return {name: result["status"] for name, result in self.results(report).items()}

    def test_skipped_is_no_pass(self):
        status, report = self.conform(GOLDEN, "--shard", "99/99")
        self.assertEqual(status, INCOMPLETE)
        self.assertEqual(list(self.results(report)), [v["id"] for v in self.manifest["vectors"]])
        self.assertEqual(set(self.statuses(report).values()), {"skipped"})
        self.assertEqual(report["runs"][0]["counts"]["pass"], 0)
        self.assertEqual(report["runs"][0]["verdict"], "incomplete")

    def test_decoder_that_cannot_run_here_is_skipped(self):
        status, report = self.conform("sh -c 'echo no device >&2; exit 77' {input} {output}")
        self.assertEqual(status, INCOMPLETE)
        self.assertEqual(set(self.statuses(report).values()), {"skipped"})
        for result in self.results(report).values():
            self.assertIn("no device", result["reason"])

    def test_filter_by_id_clause_and_flag(self):
        vectors = self.manifest["vectors"]
        for pattern, chosen in (
            ("real/*", [v["id"] for v in vectors if v["id"].startswith("real/")]),
            ("KEY-2", [v["id"] for v in vectors if "KEY-2" in v["clauses"]]),
            ("depth10", [v["id"] for v in vectors if "depth10" in v["flags"]]),
        ):
            with self.subTest(pattern=pattern):
                self.assertTrue(chosen)
                _, report = self.conform(GOLDEN, "--filter", pattern)
                ran = [name for name, status in self.statuses(report).items() if status != "skipped"]
                self.assertEqual(set(ran), {name for v in vectors if v["id"] in chosen for name in (v["id"], v.get("base", v["id"]))})

    def test_claims_choose_vectors(self):
        dut = self.declaration("narrow", profile="main", level=0, limits={"width": 40, "block_log2": [2]})
        status, report = self.conform(dut)
        for vector in self.manifest["vectors"]:
            beyond = vector["profile"] == "extended" or vector["level"] > 0
            with self.subTest(vector=vector["id"]):
                result = self.results(report)[vector["id"]]
                if beyond:
                    self.assertEqual(result["status"], "not_supported")
                else:
                    self.assertIn(result["status"], ("pass", "not_supported"))
        self.assertEqual(status, DONE)

    def test_waiver(self):
        failing = {"command": "true {input} {output}", "error_names": False}
        reason = "the writer of pictures is not done"
        ids = [v["id"] for v in self.manifest["vectors"] if v["expect"]["outcome"] == "ok"]
        waivers = [{"vector": name, "reason": reason} for name in ids]
        dut = self.declaration("waived", **{**failing, "waivers": waivers})
        _, report = self.conform(dut)
        for name in ids:
            self.assertEqual(self.results(report)[name]["status"], "fail")
            self.assertEqual(self.results(report)[name]["waiver"], reason)
        self.assertEqual(report["runs"][0]["counts"]["waived"], len(ids))
        dut = self.declaration("partly", **{**failing, "waivers": waivers[1:]})
        status, _ = self.conform(dut)
        self.assertEqual(status, 1)

    def test_shards_merge(self):
        for shard in ("1/2", "2/2"):
            status, report = self.conform(GOLDEN, "--shard", shard, output=f"part{shard[0]}")
            self.assertEqual(status, INCOMPLETE)
            self.assertIn("skipped", self.statuses(report).values())
        result = self.run_hmlfc("conform", "--merge", "part1", "part2", "-o", "merged", "--json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertEqual(set(self.statuses(json.loads(result.stdout)).values()), {"pass"})
        one = self.run_hmlfc("conform", "--merge", "part1", "-o", "merged1")
        self.assertEqual(one.returncode, INCOMPLETE)

    def test_merge_compares_decoders(self):
        self.conform(self.declaration("first"), output="one")
        self.conform(self.declaration("second"), output="two")
        result = self.run_hmlfc("conform", "--merge", "one", "two", "-o", "both", "--json")
        runs = json.loads(result.stdout)["runs"]
        self.assertEqual([run["dut"] for run in runs], ["first", "second"])

    def test_resume(self):
        log = self.folder / "resumed" / "again" / "results.jsonl"
        self.conform(self.declaration("again"), output="resumed")
        lines = log.read_text().splitlines()
        # The last result is cut, as by an interruption; of the one before it the time is changed.
        kept = json.loads(lines[-2])
        kept["seconds"] = 1234.5
        log.write_text("\n".join([*lines[:-2], json.dumps(kept), lines[-1][:20]]))
        status, report = self.conform(self.declaration("again"), "--resume", output="resumed")
        self.assertEqual(status, DONE)
        results = self.results(report)
        self.assertEqual(results[kept["id"]]["seconds"], 1234.5)
        self.assertLess(results[json.loads(lines[-1])["id"]]["seconds"], 1000)

    def test_resume_refuses_another_decoder(self):
        self.conform(self.declaration("changed"), output="changed")
        dut = self.declaration("changed", command=GOLDEN + " --threads 1")
        self.refused(
            74, "conform", "--suite", self.small, "--dut", dut, "-o", "changed", "--resume",
            says="another suite or decoder",
        )  # fmt: skip

    def test_damaged_suite(self):
        suite = self.folder / "damaged"
        shutil.copytree(self.small, suite)
        first = self.manifest["vectors"][0]
        path = suite / first["input"]["file"]
        path.write_bytes(path.read_bytes()[:-1])
        command = ["conform", "--suite", suite, "--dut", GOLDEN, "-o", "report", "--json"]
        result = self.run_hmlfc(*command)
        self.assertEqual(result.returncode, 1)
        found = self.results(json.loads(result.stdout))[first["id"]]
        self.assertEqual(found["status"], "error")
        self.assertIn("SHA-256", found["reason"])

    def test_first_wrong_stage(self):
        """A decoder with a wrong view whose trace is right, and one whose trace is wrong, too."""
        naive = ROOT / "tests" / "naive_decoder" / "decode.py"
        trace = f"python3 {naive} {{input}} --trace {{view_row}},{{view_col}},{{plane}},{{block_x}},{{block_y}}"
        broken = Path(self.folder / "trace.py")
        broken.write_text(
            "import subprocess, sys, json\n"
            "for line in subprocess.run(sys.argv[1:], stdout=subprocess.PIPE).stdout.splitlines():\n"
            "    record = json.loads(line)\n"
            "    if record.get('stage') == 'residual': record['values'][0] += 1\n"
            "    print(json.dumps(record))\n"
        )
        for name, command, says in (
            ("right", trace, "all stages of plane"),
            ("wrong", f"python3 {broken} {trace}", "stage residual ("),
        ):
            with self.subTest(trace=name):
                dut = self.declaration(
                    f"traced-{name}", command=COARSE, trace=command, error_names=False
                )
                _, report = self.conform(dut, "--filter", "real/cards-main")
                stage = self.results(report)["real/cards-main"]["stage"]
                self.assertEqual(stage.count(says), 3, stage)  # of the planes that differ
                self.assertTrue("plane Y" in stage and "plane Cg" in stage, stage)

    def test_first_error_name_counts(self):
        """A decoder that lists all names does not name the error."""
        names = "bad_version bad_magic"
        for order, status in ((names, "fail"), ("bad_magic bad_version", "pass")):
            script = f'{{hmlfc}} decode "$0" -o "$1" 2>/dev/null || {{ echo {order} >&2; exit 1; }}'
            dut = self.declaration("names", command=f"sh -c '{script}' {{input}} {{output}}")
            _, report = self.conform(dut, "--filter", "error/magic")
            self.assertEqual(self.results(report)["error/magic"]["status"], status)

    def test_wrong_arguments(self):
        suite = ("conform", "--suite", self.small, "-o", "report")
        self.refused(USAGE, *suite, says="--dut")
        self.refused(USAGE, *suite, "--dut", GOLDEN, "--filter", "no such vector", says="no vector fits")
        self.refused(USAGE, *suite, "--dut", "decoder {input}", says="{output}")
        self.refused(USAGE, *suite, "--dut", "'decoder {input} {output}", says="quote")
        self.refused(USAGE, *suite, "--dut", "missing.so", says="no such library")
        self.refused(USAGE, *suite, "--dut", "missing.json", says="missing.json")
        self.refused(USAGE, *suite, "--dut", GOLDEN, "--shard", "3/2", says="I/N")
        self.refused(INPUT, "conform", "--suite", "nowhere", "--dut", GOLDEN, "-o", "report")
        for keys, says in (
            ({"levle": 1}, "levle"),
            ({"level": 4}, "[0, 3]"),
            ({"profile": "high"}, "high"),
            ({"limits": {"depth": 16}}, "[8, 12]"),
            ({"waivers": [{"vector": "real/x", "reason": ""}]}, "no reason"),
            ({"waivers": [{"vector": "real/x", "reason": "later"}]}, 'it waives "real/x", which the suite does not have'),
            ({"library": "x.so"}, "exactly one"),
        ):
            with self.subTest(keys=keys):
                self.refused(USAGE, *suite, "--dut", self.declaration("bad", **keys), says=says)

    def test_program_that_is_none(self):
        """A program that is not there, or a file that is no library, is named."""
        path = self.folder / "empty.so"
        path.write_bytes(b"no library")
        _, report = self.conform(path, output="empty")
        for result in self.results(report).values():
            self.assertEqual(result["status"], "error", result)
            self.assertIn("empty.so: cannot be loaded", result["reason"])
        for dut in ("missing-decoder {input} {output}", "lines: missing-decoder"):
            _, report = self.conform(dut, "--filter", "syntax/base-main", output="missing")
            result = self.results(report)["syntax/base-main"]
            self.assertEqual(result["status"], "error")
            self.assertIn("missing-decoder cannot be started: No such file or directory", result["reason"])


if __name__ == "__main__":
    main()
