"""The programs that benchmarks in Python run as child processes, and what they cost."""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from sources import ROOT

LAUNCHER = Path(__file__).with_name("launch.py")
BUILT = ROOT / "build" / "release"
HMLFC = BUILT / "tools" / "hmlfc"


class BenchError(Exception):
    """Something the caller can put right; the text says what."""


def built(name):
    """The path of a program of bench/ in the build of ./run."""
    return BUILT / "bench" / name


def require(bench, *programs):
    """Raises BenchError where one of the programs is not there."""
    for program in programs:
        if not program.is_file():
            raise BenchError(f"no program {program}: ./run bench {bench} builds it")


def say(text):
    """A message, in place of the progress on a terminal."""
    clear = "\r\033[K" if sys.stderr.isatty() else ""
    print(f"{clear}{text}", file=sys.stderr, flush=True)


def run_main(bench, main):
    """Ends the process with the exit status of main(), or with a message and 2 where it raises BenchError."""
    try:
        sys.exit(main())
    except BenchError as error:
        say(f"{bench}: {error}")
        sys.exit(2)


@dataclass
class Cost:
    """cpu_seconds: user and system time of all threads; peak_bytes: largest resident memory."""

    cpu_seconds: float
    peak_bytes: int


def run(command):
    """Runs a command to its end. Returns (its stdout, CPU seconds it took on all threads)."""
    said, cost = run_measured(command)
    return said, cost.cpu_seconds


def run_measured(command):
    """Runs a command to its end. Returns (its stdout, its Cost)."""
    command = [str(part) for part in command]
    reading, writing = os.pipe()
    with open(reading, encoding="utf-8") as report:
        launcher = [sys.executable, "-S", "-E", str(LAUNCHER), str(writing)]
        done = subprocess.run(
            [*launcher, *command], capture_output=True, text=True, check=False, pass_fds=[writing]
        )
        os.close(writing)
        cost = report.read()
    if done.returncode != 0 or not cost:
        lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
        raise BenchError(f"{' '.join(command)}: {lines[-1]}")
    return done.stdout, Cost(**json.loads(cost))


def machine():
    """The processor and the number of its cores that this process may use."""
    model = "unknown processor"
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
    return f"{model}, {len(os.sched_getaffinity(0))} cores"
