#!/usr/bin/env python3
"""Numerical stress: runs the decode path, built with checked integers, until the time is up.

Runs every vector of the suite and small synthetic scenes; then in turn random valid streams, and random
and extreme cameras. Prints what each quantity of the width tables (specification, docs/rendering.md) reached,
next to its proved interval.
Findings are kept in out/stress with their stream.
Exit status: 0 no findings, 1 a finding.
"""

import argparse
import json
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

from reached import Reached

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
VECTORS = ROOT / "vectors"
SCENES = ["cards", "flat", "glass", "knights", "noise"]
ENCODINGS = [
    ["--profile", "main", "--chroma", "444", "--quality", "70"],
    ["--profile", "extended", "--quality", "50", "--preset", "fast"],
    ["--profile", "extended", "--lossless", "--chroma", "444", "--preset", "fast"],
]
TURN_SECONDS = 60  # shorter if the whole run is short


class Run:
    """The programs of one run and their results."""

    def __init__(self, build, folder):
        self.programs = build / "tests/stress"
        self.folder = folder
        self.reached = Reached()
        self.findings = []
        self.counts = {"streams": 0, "blocks": 0, "cameras": 0, "frames": 0}
        folder.mkdir(parents=True, exist_ok=True)

    def streams(self, name, *arguments):
        report = self.add(self.call(name, "stress_streams", "--folder", self.folder, *arguments))
        for finding in report["findings"]:
            self.keep(finding["stream"], finding["what"], Path(finding["stored"]))

    def camera_turn(self, seed, seconds):
        arguments = ["--seed", seed, "--seconds", seconds, "--count", 10**9]
        report = self.add(self.call("cameras", "stress_cameras", *arguments))
        for finding in report["findings"]:
            self.findings.append({"stream": json.dumps(finding["camera"]), "what": finding["what"]})

    def add(self, report):
        """Adds what a report reached and counted; returns it."""
        self.reached.add(report["rows"])
        for name in self.counts:
            self.counts[name] += report.get(name, 0)
        return report

    def call(self, name, program, *arguments):
        """The program's report; an empty one, and a finding, if it ended without one."""
        if sys.stderr.isatty():
            print(f"{self.counts['streams']} streams, {len(self.findings)} findings; {name}", file=sys.stderr)
        command = [str(part) for part in (self.programs / program, *arguments)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode in (0, 1) and done.stdout:
            return json.loads(done.stdout)
        if done.returncode == 2:
            raise SystemExit(done.stderr)
        current = self.folder / "current.txt"
        stream = current.read_text().strip() if current.exists() else name
        errors = [line for line in done.stderr.splitlines() if "runtime error" in line]
        what = errors[0].strip() if errors else f"exit status {done.returncode}"
        self.keep(stream, what, self.folder / "current.hmlfc")
        return {"rows": [], "findings": []}

    def keep(self, stream, what, stored):
        """Records a finding, with its stream, if any, under a name of its own."""
        finding = {"stream": stream, "what": what}
        if stored.is_file():
            kept = self.folder / f"finding-{len(self.findings):03}.hmlfc"
            if stored != kept:
                shutil.copy(stored, kept)
            finding["stored"] = str(kept)
        self.findings.append(finding)


def scene_streams(hmlfc, folder):
    """A small light field of every scene, encoded in both profiles and losslessly."""
    folder.mkdir(parents=True, exist_ok=True)
    for scene in SCENES:
        views = folder / scene
        size = ["--grid", "3x5", "--size", "37x29"]
        subprocess.run(
            [hmlfc, "synth", "--scene", scene, *size, "-o", views], check=True, capture_output=True
        )
        for number, options in enumerate(ENCODINGS):
            stream = folder / f"{scene}-{number}.hmlfc"
            subprocess.run(
                [hmlfc, "encode", views, "-o", stream, *options], check=True, capture_output=True
            )
    return folder


def run_all(run, arguments):
    begin = time.monotonic()

    def left():
        return arguments.minutes * 60 - (time.monotonic() - begin)

    run.streams("vectors", "files", VECTORS)
    run.streams("largest tree", "geometry")
    if arguments.hmlfc:
        run.streams("scenes", "files", scene_streams(arguments.hmlfc, run.folder / "scenes"))
    turn = 0
    turn_seconds = min(TURN_SECONDS, max(1, left() / 2))
    while left() > 1:
        seed = arguments.seed + turn
        limit = ["--seconds", min(turn_seconds, left())]
        if turn % 2 == 0:
            run.streams("random streams", "random", "--seed", seed * 1_000_000, *limit)
        else:
            run.camera_turn(seed, limit[1])
        turn += 1
    return time.monotonic() - begin


def cpu_seconds():
    """Returns the CPU time of all programs run so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def print_report(run, seconds):
    for line in run.reached.table():
        print(line)
    gaps = run.reached.gaps()
    print("\n" + ", ".join(f"{count} {name}" for name, count in run.counts.items()))
    print(f"{seconds:.0f} s, {cpu_seconds():.0f} CPU s")
    print(f"{len(gaps)} intervals not reached at both ends")
    print(f"{len(run.findings)} findings")
    for finding in run.findings:
        print(f"  {finding['what']}\n    {finding['stream']}\n    {finding.get('stored', '')}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help="the build of preset stress")
    parser.add_argument("--minutes", type=float, required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--hmlfc", type=Path, help="the program that makes and encodes scenes")
    parser.add_argument("--out", type=Path, default=ROOT / "out/stress")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    run = Run(arguments.build, arguments.out)
    seconds = run_all(run, arguments)
    if arguments.json:
        rows = list(run.reached.rows.values())
        made = {"minutes": arguments.minutes, "seed": arguments.seed}
        times = {"seconds": round(seconds, 1), "cpu_seconds": round(cpu_seconds(), 1)}
        print(json.dumps({**made, **times, **run.counts, "findings": run.findings, "rows": rows}, indent=1))
    else:
        print_report(run, seconds)
    return 1 if run.findings else 0


if __name__ == "__main__":
    sys.exit(main())
