"""Runs encoders as child processes and takes their CPU time."""

import resource
import subprocess

from light_field import BenchError


def run(command):
    """Runs a command to its end. Returns (its stdout, CPU seconds it took on all threads)."""
    before = _cpu_seconds()
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise BenchError(f"{command[0]} does not start: {error.strerror}") from error
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
        raise BenchError(f"{' '.join(map(str, command))}: {lines[-1]}")
    return done.stdout, _cpu_seconds() - before


def _cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
