"""The programs that benchmarks in Python run as child processes, and what they cost."""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("HMLFC_BUILD") or ROOT / "build" / "release")
HMLFC = BUILD / "tools" / "hmlfc"
BENCH = BUILD / "bench" / "hmlfc_measure"
LAUNCHER = Path(__file__).with_name("launch.py")


class BenchError(Exception):
    """Something the caller can put right; the text says what."""


@dataclass
class Cost:
    """cpu_seconds: user and system time of all threads; peak_bytes: largest resident memory."""

    cpu_seconds: float
    peak_bytes: int


def say(text):
    """A message on stderr: progress, or what went wrong."""
    print(text, file=sys.stderr, flush=True)


def run_main(name, main):
    """Ends the process with the exit status of main(), or with a message and 2 where it raises BenchError."""
    try:
        sys.exit(main())
    except BenchError as error:
        say(f"{name}: {error}")
        sys.exit(2)


def run_measured(command, given=None):
    """Runs a command to its end. given: text for its stdin. Returns (its stdout, its Cost)."""
    command = [str(part) for part in command]
    if not Path(command[0]).is_file() and "/" in command[0]:
        raise BenchError(f"no program {command[0]}: ./run bench builds it")
    reading, writing = os.pipe()
    with open(reading, encoding="utf-8") as report:
        launcher = [sys.executable, "-S", "-E", str(LAUNCHER), str(writing)]
        done = subprocess.run(
            [*launcher, *command], input=given, capture_output=True, text=True, check=False, pass_fds=[writing]
        )
        os.close(writing)
        cost = report.read()
    if done.returncode != 0 or not cost:
        lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
        raise BenchError(f"{' '.join(command)}: {lines[-1]}")
    return done.stdout, Cost(**json.loads(cost))


def hmlfc(*arguments):
    """What `hmlfc` says, as a text."""
    return run_measured([HMLFC, *arguments])[0]


def hmlfc_json(*arguments):
    """What `hmlfc ... --json` says."""
    return json.loads(hmlfc(*arguments, "--json"))


def bench_json(*arguments, given=None):
    """What a subcommand of hmlfc_measure measures. given: text for its stdin."""
    return json.loads(run_measured([BENCH, *arguments], given)[0])


def machine():
    """The processor and the number of its cores that this process may use."""
    model = "unknown processor"
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
    return f"{model}, {len(os.sched_getaffinity(0))} cores"
