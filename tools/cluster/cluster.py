#!/usr/bin/env python3
"""Work on a Slurm cluster: an array job, lost tasks again, one result and one summary.

  tools/cluster/cluster.py submit FOLDER KIND [--tasks N] [--retries R] [--sbatch=OPTION]... ARG...

FOLDER, on a file system that all nodes share, gets everything; summary.json there is written last.
Task I of N runs, with the program hmlfc that HMLFC names, or for the last three ./run of this checkout,
which has to be built before:

  encode PLAN OUT   hmlfc encode PLAN --shard I/N, then --assemble to OUT
  conform ARG...    hmlfc conform ARG... --shard I/N, then --merge to FOLDER/report
  fuzz ARG...       hmlfc fuzz-dut ARG... (with --count C), on seeds from S + (I - 1) * C on, S of --seed
  stress ARG...     ./run stress ARG... --seed I --out FOLDER/tasks/I
  soak ARG...       ./run soak ARG... --seed I --shard I/N

A task that ends without a status (killed, its node lost), or for want of memory or disk, is lost and runs
again, up to R times. Exit status of the merge and of the summary: the worst of the tasks.
"""

import argparse
import json
import os
import shlex
import shutil
import subprocess
import sys
import time
import uuid
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LOST = {71, 74}  # exit statuses of hmlfc: out of memory, disk full


def hmlfc():
    return os.environ.get("HMLFC", str(ROOT / "build/release/tools/hmlfc"))


def option(arguments, name, default):
    """The number that follows `name`, and the arguments without both."""
    if name not in arguments:
        return default, arguments
    at = arguments.index(name)
    return int(arguments[at + 1]), arguments[:at] + arguments[at + 2 :]


def fuzz(arguments, index, output):
    count, rest = option(arguments, "--count", 0)
    seed, rest = option(rest, "--seed", 1)
    if count == 0:
        raise SystemExit("fuzz: --count is needed, so that no two tasks try the same")
    first = seed + (index - 1) * count
    return [hmlfc(), "fuzz-dut", *rest, "--seed", str(first), "--count", str(count), "-o", output]


def seeded(command, arguments, index):
    return [str(ROOT / "run"), command, *arguments, "--seed", str(index)]


# The command of task `index` of `count`, which writes to `output`.
TASKS = {
    "encode": lambda a, i, n, o: [hmlfc(), "encode", a[0], "-o", o, "--shard", f"{i}/{n}", "--threads", "1"],
    "conform": lambda a, i, n, o: [hmlfc(), "conform", *a, "--shard", f"{i}/{n}", "-o", o],
    "fuzz": lambda a, i, n, o: fuzz(a, i, o),
    "stress": lambda a, i, n, o: [*seeded("stress", a, i), "--out", o],
    "soak": lambda a, i, n, o: [*seeded("soak", a, i), "--shard", f"{i}/{n}"],
}
# What makes one result of `outputs`; kinds without it are summed up by their statuses.
MERGES = {
    "encode": lambda a, folder, outputs: [hmlfc(), "encode", a[0], "-o", a[1], "--assemble", *outputs],
    "conform": lambda a, folder, outputs: [hmlfc(), "conform", *(x for o in outputs for x in ("--merge", o)), "-o", str(folder / "report")],
}


def write_whole(path, value):
    """`value` as JSON, complete or not at all."""
    partial = path.with_suffix(f".partial-{uuid.uuid4().hex}")
    partial.write_text(json.dumps(value, indent=2) + "\n")
    partial.replace(path)


class Job:
    def __init__(self, folder):
        self.folder = Path(folder).resolve()
        self.fields = json.loads((self.folder / "job.json").read_text())
        self.kind, self.arguments, self.tasks = (self.fields[name] for name in ("kind", "arguments", "tasks"))

    def output(self, index):
        return str(self.folder / "tasks" / f"{index}")

    def status_file(self, index):
        return self.folder / "status" / f"{index}.json"

    def status(self, index):
        """What task `index` left, None where it is lost."""
        file = self.status_file(index)
        found = json.loads(file.read_text()) if file.exists() else None
        return None if found is None or found["status"] in LOST or found["status"] < 0 else found

    def lost(self):
        return [index for index in range(1, self.tasks + 1) if self.status(index) is None]

    def submit(self, indices, attempt):
        """An array job of these tasks, then the merge."""
        this = f"{shlex.quote(sys.executable)} {shlex.quote(str(Path(__file__).resolve()))}"
        folder = shlex.quote(str(self.folder))
        common = ["sbatch", "--parsable", "--export=ALL", f"--chdir={self.folder}", *self.fields["sbatch"]]
        log = f"--output={self.folder}/log/%x-%a-{attempt}.txt"
        array = [*common, log, "--requeue", f"--array={','.join(map(str, indices))}", f"--job-name={self.kind}"]
        number = run_text([*array, f"--wrap={this} task {folder}"])
        merge = [*common, f"--output={self.folder}/log/merge-{attempt}.txt", f"--dependency=afterany:{number}"]
        run_text([*merge, f"--job-name={self.kind}-merge", f"--wrap={this} merge {folder} {attempt}"])
        return number


def run_text(command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def submit(options):
    folder = Path(options.folder).resolve()
    if folder.exists() and any(folder.iterdir()):
        raise SystemExit(f"{folder}: not empty; give another folder")
    for name in ("tasks", "status", "log"):
        (folder / name).mkdir(parents=True)
    paths = [str(Path(a).resolve()) for a in options.arguments] if options.kind == "encode" else options.arguments
    fields = {"kind": options.kind, "arguments": paths, "tasks": options.tasks, "retries": options.retries, "sbatch": options.sbatch}
    write_whole(folder / "job.json", fields)
    job = Job(folder)
    TASKS[job.kind](job.arguments, 1, job.tasks, "")  # refuses arguments before the cluster does
    print(job.submit(range(1, job.tasks + 1), 0))


def task(options):
    job = Job(options.folder)
    index = int(os.environ["SLURM_ARRAY_TASK_ID"])
    partial = job.output(index) + ".partial"
    for left in (partial, job.output(index)):
        shutil.rmtree(left, ignore_errors=True)
        Path(left).unlink(missing_ok=True)
    began = time.monotonic()
    ran = subprocess.run(TASKS[job.kind](job.arguments, index, job.tasks, partial), check=False, cwd=ROOT)
    if Path(partial).exists():
        os.replace(partial, job.output(index))
    node = os.environ.get("SLURMD_NODENAME", "")
    write_whole(job.status_file(index), {"status": ran.returncode, "seconds": round(time.monotonic() - began, 3), "node": node})
    sys.exit(ran.returncode if ran.returncode >= 0 else 128 - ran.returncode)


def merge(options):
    job = Job(options.folder)
    lost = job.lost()
    if lost and options.attempt < job.fields["retries"]:
        print(f"lost: {lost}; again as job {job.submit(lost, options.attempt + 1)}")
        return
    done = {index: job.status(index) for index in range(1, job.tasks + 1) if index not in lost}
    summary = {"kind": job.kind, "tasks": job.tasks, "lost": lost, "attempts": options.attempt + 1}
    statuses = [found["status"] for found in done.values()]
    if job.kind in MERGES and not lost:
        outputs = [job.output(index) for index in done]
        statuses = [subprocess.run(MERGES[job.kind](job.arguments, job.folder, outputs), check=False, cwd=ROOT).returncode]
    summary["status"] = max([*statuses, 5 if lost else 0])
    summary["failed"] = [index for index, found in done.items() if found["status"] != 0]
    summary["task_seconds"] = round(sum(found["seconds"] for found in done.values()), 3)
    summary["nodes"] = sorted({found["node"] for found in done.values()})
    write_whole(job.folder / "summary.json", summary)
    sys.exit(summary["status"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    one = commands.add_parser("submit")
    one.add_argument("folder")
    one.add_argument("kind", choices=TASKS)
    one.add_argument("--tasks", type=int, default=16)
    one.add_argument("--retries", type=int, default=2)
    one.add_argument("--sbatch", action="append", default=[], help="an option of sbatch")
    one.set_defaults(run=submit)
    two = commands.add_parser("task")
    two.add_argument("folder")
    two.set_defaults(run=task)
    three = commands.add_parser("merge")
    three.add_argument("folder")
    three.add_argument("attempt", type=int)
    three.set_defaults(run=merge)
    options, rest = parser.parse_known_args()
    if rest and options.run is not submit:
        parser.error(f"unknown: {rest}")
    options.arguments = rest
    options.run(options)


if __name__ == "__main__":
    main()
