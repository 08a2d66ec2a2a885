"""A real Slurm of two nodes: encode, conform and fuzz in shards, with a task killed in the middle, give what
one machine gives. Arguments: the program hmlfc, the folder of the suite."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import slurm

PROGRAM, SUITE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
CLUSTER = Path(__file__).resolve().parents[2] / "tools/cluster/cluster.py"
SKIPPED = 77
# The decoder under test: the program itself.
DUT = f"{PROGRAM} decode {{input}} -o {{output}}"


def hmlfc(*arguments, cwd):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


class Cluster(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="hmlfc-slurm-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.slurm = slurm.Slurm(cls.folder / "slurm", 2)
        cls.addClassCleanup(cls.slurm.__exit__)
        cls.slurm.__enter__()
        os.environ.update(cls.slurm.environment, HMLFC=str(PROGRAM))

    def submit(self, name, kind, *arguments, tasks):
        command = [sys.executable, CLUSTER, "submit", self.folder / name, kind, "--tasks", str(tasks), *arguments]
        return subprocess.run(list(map(str, command)), check=True, stdout=subprocess.PIPE, text=True).stdout.strip()

    def summary(self, name):
        file = self.folder / name / "summary.json"
        self.slurm.wait(f"the summary of {name}", file.exists, 400)
        return json.loads(file.read_text())

    def kill_task(self, name, index):
        """Kills task `index` while it runs, with all that it started, as a lost node does."""
        pids = []

        def running():
            pids[:] = [int(p.name) for p in Path("/proc").glob("[0-9]*") if self.is_task(p, name, index)]
            return bool(pids)

        self.slurm.wait("the task", running)
        for pid in pids:
            os.kill(pid, signal.SIGKILL)

    def is_task(self, process, name, index):
        try:
            command = (process / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            environment = (process / "environ").read_bytes().split(b"\0")
        except OSError:
            return False
        return f"task {self.folder / name}" in command and f"SLURM_ARRAY_TASK_ID={index}".encode() in environment

    def test_encode_with_a_killed_task(self):
        views = self.folder / "views"
        hmlfc(*"synth --scene cards --grid 12x12 --size 96x72 -o views".split(), cwd=self.folder)
        options = "--preset fast --references 3x3".split()
        self.assertEqual(hmlfc("encode", views, "-o", "whole.hmlfc", *options, cwd=self.folder).returncode, 0)
        self.assertEqual(hmlfc("encode", views, "-o", "plan.json", "--plan", *options, cwd=self.folder).returncode, 0)
        self.submit("encode", "encode", self.folder / "plan.json", self.folder / "many.hmlfc", tasks=4)
        self.kill_task("encode", 3)
        summary = self.summary("encode")
        self.assertEqual((summary["status"], summary["attempts"], summary["lost"], summary["failed"]), (0, 2, [], []))
        self.assertEqual(summary["nodes"], ["n1", "n2"])
        self.assertEqual((self.folder / "many.hmlfc").read_bytes(), (self.folder / "whole.hmlfc").read_bytes())

    def test_a_task_that_stays_lost_is_named(self):
        self.submit("gone", "encode", self.folder / "nothing.json", self.folder / "none.hmlfc", "--retries", "0", tasks=2)
        self.assertEqual(self.summary("gone")["failed"], [1, 2])
        self.submit("lost", "fuzz", "--dut", "tail -f {input} {output}", "--count", "1", "--retries", "0", tasks=1)
        self.kill_task("lost", 1)
        summary = self.summary("lost")
        self.assertEqual((summary["lost"], summary["status"]), ([1], 5))

    def test_conform(self):
        options = ["--suite", str(SUITE), "--filter", "syntax/base-*", "--dut", DUT]
        hmlfc("conform", *options, "-o", "one", cwd=self.folder)
        self.submit("conform", "conform", *options, tasks=2)
        self.summary("conform")
        self.assertIn("pass", {status for _, status in self.results("one")})
        self.assertEqual(self.results("conform/report"), self.results("one"))

    def results(self, name):
        """The status of each vector."""
        report = json.loads((self.folder / name / "report.json").read_text())
        return [(found["id"], found["status"]) for found in report["runs"][0]["results"]]

    def test_fuzz(self):
        broken = f"{PROGRAM} decode {{input}} -o {{output}} --levels 1"
        options = ["--dut", broken]
        hmlfc("fuzz-dut", *options, "--seed", 5, "--count", 6, "-o", "found", cwd=self.folder)
        self.submit("fuzz", "fuzz", *options, "--seed", "5", "--count", "3", tasks=2)
        self.summary("fuzz")
        one = sorted(p.name for p in (self.folder / "found").iterdir())
        many = sorted(p.name for p in (self.folder / "fuzz/tasks").glob("*/*"))
        self.assertTrue(one)
        self.assertEqual(many, one)


if __name__ == "__main__":
    if slurm.missing():
        print(f"skipped: no {', '.join(slurm.missing())}; apt-get install slurm-wlm munge")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
