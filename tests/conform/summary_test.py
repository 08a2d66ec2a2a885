"""What a report begins with, on results that are made up: `conform --merge` reads and reports them."""

import json

from conform_case import ConformTest, main


def passing(name, clauses, milestone="motion", **keys):
    return {"id": name, "status": "pass", "seconds": 0, "clauses": clauses, "milestone": milestone, "bytes": 100, **keys}


def failing(name, clauses, **keys):
    return {**passing(name, clauses), "status": "fail", "reason": "wrong", "inspect": "hmlfc inspect", **keys}


def differing(name, clauses, *planes, **keys):
    """A vector with wrong samples in some planes."""
    difference = dict.fromkeys(("view_row", "view_col", "block_x", "block_y", "x", "y", "expected", "actual"), 0)
    difference |= {"channel": "R", "planes": planes, "wrong_blocks": 1, "blocks": 2, "wrong_views": 1}
    return failing(name, clauses, difference=difference, **keys)


class Summaries(ConformTest):
    def report(self, *results, name="given", **keys):
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        run = {"dut": "made", "command": ["made"], "profile": "extended", "level": 3, "results": results, **keys}
        system = {"program": "", "date": "", "host": "", "processor": "", "threads": 1, "memory_mib": 1}
        report = {"vectors_version": "1", "manifest_sha256": "0", "system": system, "runs": [run]}
        (folder / "report.json").write_text(json.dumps(report))
        return folder

    def merged(self, *folders):
        """Exit status, JSON and text of the reports put together."""
        command = ("conform", "--merge", *folders, "-o", "merged")
        done = self.run_hmlfc(*command, "--json")
        self.assertEqual(done.stderr, b"")
        return done.returncode, json.loads(done.stdout)["runs"][0], self.run_hmlfc(*command).stdout.decode()

    def summary(self, *results, **keys):
        return self.merged(self.report(*results, **keys))[1]["begin"]

    def causes(self, *results):
        return [cause["cause"] for cause in self.summary(*results)["causes"]]

    def test_titles(self):
        stage = "stage residual (DEC-3) at level 0 image 0,0 plane Y block 0,0: value 0 (x 0, y 0) is 1 instead of 2"
        self.assertEqual(
            self.causes(differing("a/a", ["TIL-1"], "Y", stage=stage), differing("a/b", ["TIL-1"], "Co", stage=stage)),
            ["wrong samples; first wrong stage residual (DEC-3)"],
        )
        self.assertEqual(self.causes(differing("a/a", ["TIL-1"], "Y", "Co")), ["wrong samples in planes Y, Co"])
        kind = "wrong samples of plane Y at stop level 0"
        self.assertEqual(self.causes(failing("a/a", ["TIL-1"], kind=kind, stage=stage)), [kind + "; first wrong stage residual (DEC-3)"])
        self.assertEqual(self.causes(failing("a/a", ["TIL-1"], reason="exit status 3")), ["exit status N"])

    def test_vector_to_look_at(self):
        small = failing("boundary/small", ["TIL-1"], bytes=1)
        telling = failing("syntax/telling", ["TIL-1"], bytes=500, telling=True)
        larger = failing("syntax/larger", ["TIL-1"], bytes=600, telling=True)
        later = failing("syntax/later", ["TIL-1"], bytes=2, telling=True, milestone="tree")
        self.assertEqual(self.summary(small, larger, telling, later)["vector"], "syntax/telling")
        self.assertEqual(self.summary(small, later)["vector"], "boundary/small")

    def test_clauses_that_always_fail(self):
        """Of the first milestone that is not whole, the most frequent first, without general ones."""
        begin = self.summary(
            passing("a/0", ["TIL-2"], milestone="blocks"),
            failing("a/1", ["CNV-7", "TIL-1", "TIL-2", "MOT-3"]),
            failing("a/2", ["CNV-7", "TIL-2", "MOT-3"]),
            failing("a/3", ["DEC-1"], milestone="tree"),
        )
        self.assertEqual(begin["clauses"], ["MOT-3", "TIL-1"])
        self.assertEqual(self.summary(failing("a/1", ["CNV-7"]))["clauses"], ["CNV-7"])

    def test_long_lists_are_cut(self):
        text = self.merged(self.report(failing("a/1", [f"TIL-{i}" for i in range(60)])))[2]
        self.assertRegex(text, "clauses that fail in all vectors: TIL-0 TIL-1 .* TIL-15\\s+and 52 more\n")

    def test_milestone_is_whole(self):
        rest = [passing("a/2", ["TIL-1"], milestone="tree", status="skipped")]
        one = self.report(passing("a/1", ["TIL-1"]), *rest, milestone="motion")
        status, run, text = self.merged(one)
        self.assertEqual((status, run["verdict"]), (0, "milestone motion is whole"))
        self.assertIn("1 vectors were not run", text)
        self.assertIn("Next: --milestone tree", text)
        status, run, text = self.merged(self.report(*rest, passing("a/1", ["TIL-1"], status="skipped"), milestone="motion"))
        self.assertEqual((status, run["verdict"]), (5, "incomplete"))
        self.assertNotIn("Next", text)
        self.assertEqual(self.merged(self.report(passing("a/1", ["TIL-1"]), *rest))[0], 5)

    def test_milestone_of_another_is_not_whole(self):
        base = passing("a/1", ["TIL-1"])
        none = passing("a/2", ["TIL-1"], milestone="errors", status="not_supported")
        self.assertEqual(self.merged(self.report(base, none, milestone="errors"))[1]["verdict"], "incomplete")

    def test_milestones_together(self):
        skipped = {"status": "skipped"}
        first = self.report(passing("a/1", ["TIL-1"]), passing("a/2", ["TIL-1"], milestone="tree") | skipped, milestone="motion")
        second = self.report(passing("a/1", ["TIL-1"]) | skipped, passing("a/2", ["TIL-1"], milestone="tree"), name="second", milestone="tree")
        self.assertEqual(self.merged(first, second)[1]["verdict"], "conforms")


if __name__ == "__main__":
    main()
