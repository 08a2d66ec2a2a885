"""Lost tasks of tools/cluster/cluster.py: run again, counted, named. An sbatch of our own runs each task at once, and
a program of our own in place of hmlfc fails as told. Argument: cluster.py."""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CLUSTER = Path(sys.argv[1]).resolve()

# Runs the tasks of --array one after the other, else the command alone; keeps what it was asked.
SBATCH = """#!/usr/bin/env python3
import os, subprocess, sys
options = dict(word.partition("=")[::2] for word in sys.argv[1:])
with open(os.environ["ASKED"], "a") as asked:
    asked.write(options.get("--array", "merge") + "\\n")
print(7)
sys.stdout.flush()
for index in options.get("--array", "0").split(","):
    if index in os.environ.get("NEVER", "").split():
        continue
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run(options["--wrap"], shell=True, env={**os.environ, "SLURM_ARRAY_TASK_ID": index}, **quiet)
"""

# encode PLAN -o OUT --shard I/N ...: what FAILS says of task I, as often as it says so; --assemble joins shards.
PROGRAM = """#!/usr/bin/env python3
import json, os, signal, sys
from pathlib import Path
NODE_GONE = -99  # the task dies with its program
words = sys.argv[1:]
output = Path(words[words.index("-o") + 1])
if "--assemble" in words:
    output.write_text("".join(Path(shard).read_text() for shard in words[words.index("--assemble") + 1 :]))
    sys.exit(0)
index = words[words.index("--shard") + 1].split("/")[0]
if output.exists():
    sys.exit("a partial output of an earlier try is still there")
fails = json.loads(os.environ["FAILS"]).get(index, [])
tries = Path(os.environ["TRIES"]) / index
number = len(tries.read_text()) if tries.exists() else 0
tries.write_text("x" * (number + 1))
output.write_text(index + " ")
status = fails[number] if number < len(fails) else 0
if status == NODE_GONE:
    os.kill(os.getppid(), signal.SIGKILL)
if status < 0:
    os.kill(os.getpid(), -max(status, -9))
sys.exit(status)
"""


class Retry(unittest.TestCase):
    def run_job(self, fails, retries=2, never=""):
        """The summary of an encoding in 3 tasks, or None, and the array of each submission."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in ("sbatch", SBATCH), ("hmlfc", PROGRAM):
            (folder / name).write_text(text)
            (folder / name).chmod(0o755)
        (folder / "tries").mkdir()
        self.output = folder / "whole"
        environment = {
            **os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "HMLFC": str(folder / "hmlfc"), "NEVER": never,
            "FAILS": json.dumps(fails), "TRIES": str(folder / "tries"), "ASKED": str(folder / "asked"),
        }  # fmt: skip
        command = [sys.executable, CLUSTER, "submit", folder / "job", "encode", "--tasks", "3", "--retries", str(retries)]
        subprocess.run([*command, folder / "plan", self.output], check=True, env=environment, stdout=subprocess.DEVNULL)
        summary = folder / "job/summary.json"
        asked = (folder / "asked").read_text().split()
        return json.loads(summary.read_text()) if summary.exists() else None, [a for a in asked if a != "merge"]

    def test_nothing_is_lost(self):
        summary, arrays = self.run_job({})
        self.assertEqual(arrays, ["1,2,3"])
        self.assertEqual((summary["status"], summary["attempts"], summary["lost"], summary["failed"]), (0, 1, [], []))
        self.assertEqual(self.output.read_text(), "1 2 3 ")

    def test_lost_tasks_run_again_and_no_others(self):
        summary, arrays = self.run_job({"2": [71], "3": [-9, 74]})
        self.assertEqual(arrays, ["1,2,3", "2,3", "3"])
        self.assertEqual((summary["status"], summary["attempts"], summary["lost"]), (0, 3, []))
        self.assertEqual(self.output.read_text(), "1 2 3 ")

    def test_a_task_that_dies_whole_leaves_its_output(self):
        summary, arrays = self.run_job({"2": [-99]})
        self.assertEqual(arrays, ["1,2,3", "2"])
        self.assertEqual((summary["status"], summary["lost"], summary["failed"]), (0, [], []))

    def test_a_failure_is_no_loss(self):
        summary, arrays = self.run_job({"1": [2]})
        self.assertEqual(arrays, ["1,2,3"])
        self.assertEqual(summary["failed"], [1])

    def test_what_stays_lost_is_named(self):
        summary, arrays = self.run_job({"2": [-9] * 9}, retries=1)
        self.assertEqual(arrays, ["1,2,3", "2"])
        self.assertEqual((summary["status"], summary["attempts"], summary["lost"]), (5, 2, [2]))
        self.assertFalse(self.output.exists(), "shards are missing, and yet they were assembled")

    def test_a_task_without_a_status(self):
        summary, arrays = self.run_job({}, never="3")
        self.assertEqual(arrays, ["1,2,3", "3", "3"])
        self.assertEqual((summary["status"], summary["lost"]), (5, [3]))

    def test_tasks_share_neither_seeds_nor_folders(self):
        spec = importlib.util.spec_from_file_location("cluster", CLUSTER)
        cluster = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(cluster)
        fuzz = cluster.TASKS["fuzz"](["--count", "10", "--seed", "5", "--dut", "d"], 3, 4, "out")
        self.assertEqual(fuzz[1:], ["fuzz-dut", "--dut", "d", "--seed", "25", "--count", "10", "-o", "out"])
        with self.assertRaises(SystemExit):
            cluster.TASKS["fuzz"](["--dut", "d"], 1, 4, "out")
        stress = cluster.TASKS["stress"](["--minutes", "2"], 3, 4, "out")
        self.assertEqual(stress[1:], "stress --minutes 2 --seed 3 --out out".split())
        soak = cluster.TASKS["soak"](["--minutes", "2"], 3, 4, "out")
        self.assertEqual(soak[1:], "soak --minutes 2 --seed 3 --shard 3/4".split())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
