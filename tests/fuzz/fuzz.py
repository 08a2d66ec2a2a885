#!/usr/bin/env python3
"""Runs the libFuzzer targets, one after another, on seeds made of the vectors.

Inputs with new coverage go to build/fuzz/corpus/TARGET, findings to out/fuzz/TARGET. The vectors are
the checked-in corpus; a finding becomes tests/fuzz/findings/TARGET/NAME.input, which the tests replay,
or a vector.
"""

import argparse
import re
import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

TARGETS = [
    *("open", "block", "header", "index"),
    *("tile_record", "motion_record", "disparity_record", "codestream", "bise"),
]
MAX_BYTES = 32768  # of an input; few vectors are larger
UNIT_SECONDS = 20  # for one input; more is a finding
MEMORY_MB = 2048
FAULT_SECONDS = 300


@dataclass
class Outcome:
    """The result of one run of a target."""

    executions: int
    cpu_seconds: float
    edges: int
    found: bool


def parse(log, status, cpu_seconds):
    """The Outcome, from the log and exit status of libFuzzer."""

    def last(pattern):
        numbers = re.findall(pattern, log)
        return int(numbers[-1]) if numbers else 0

    executions = last(r"stat::number_of_executed_units: (\d+)") or last(r"#(\d+)\t")
    return Outcome(executions, cpu_seconds, last(r"cov: (\d+)"), status != 0)


def cpu_seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run_target(program, corpus, findings, seconds, seed, show=False):
    """Runs `program` for `seconds` of wall clock and returns its Outcome."""
    findings.mkdir(parents=True, exist_ok=True)
    command = [
        *(str(program), str(corpus), f"-max_total_time={seconds}", f"-seed={seed}"),
        *(f"-max_len={MAX_BYTES}", f"-timeout={UNIT_SECONDS}", f"-rss_limit_mb={MEMORY_MB}"),
        *("-print_final_stats=1", f"-artifact_prefix={findings}/"),
    ]
    before = cpu_seconds_of_children()
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    log = result.stdout.decode(errors="replace")
    if show and result.returncode != 0:
        print(log[-4000:], file=sys.stderr)
    return parse(log, result.returncode, cpu_seconds_of_children() - before)


def write_seeds(build, target, suite, corpus):
    replay = build / f"tests/fuzz/replay_{target}"
    findings = Path(__file__).parent / "findings" / target
    paths = [str(suite)] + ([str(findings)] if findings.is_dir() else [])
    command = [str(replay), "--write", str(corpus), *paths]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def fuzz(arguments, root):
    targets = TARGETS if arguments.target == "all" else [arguments.target]
    seconds = max(1, round(60 * arguments.minutes / len(targets)))
    failed = 0
    print(f"{'target':<18}{'executions':>12}{'CPU s':>9}{'edges':>8}  findings")
    for target in targets:
        corpus = arguments.build / "corpus" / target
        write_seeds(arguments.build, target, root / "vectors", corpus)
        findings = root / "out/fuzz" / target
        program = arguments.build / f"tests/fuzz/fuzz_{target}"
        outcome = run_target(program, corpus, findings, seconds, arguments.seed, show=True)
        failed += outcome.found
        where = str(findings.relative_to(root)) if outcome.found else "none"
        row = f"{target:<18}{outcome.executions:>12}{outcome.cpu_seconds:>9.1f}{outcome.edges:>8}"
        print(f"{row}  {where}", flush=True)
    again = f"{arguments.target} --minutes {arguments.minutes:g} --seed {arguments.seed}"
    print(f"again: ./run fuzz {again}")
    return 1 if failed else 0


def self_test(arguments, root):
    """Each target must find its planted fault."""
    missed = 0
    for target in TARGETS if arguments.target == "all" else [arguments.target]:
        corpus = arguments.build / "corpus-faults" / target
        write_seeds(arguments.build, target, root / "vectors", corpus)
        program = arguments.build / f"tests/fuzz/fault_{target}"
        findings = arguments.build / "found-faults" / target
        outcome = run_target(program, corpus, findings, FAULT_SECONDS, arguments.seed)
        missed += not outcome.found
        word = "found" if outcome.found else "MISSED"
        print(f"{target:<18}{outcome.executions:>12} executions  {word}", flush=True)
    return 1 if missed else 0


def main():
    parser = argparse.ArgumentParser(prog="./run fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("target", choices=[*TARGETS, "all"])
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--minutes", type=float, default=10, help="for all targets together")
    parser.add_argument("--seed", type=int, default=1, help="of libFuzzer; 0: another each time")
    parser.add_argument("--self-test", action="store_true", help="find the planted faults instead")
    arguments = parser.parse_args()
    root = Path(__file__).resolve().parents[2]
    return (self_test if arguments.self_test else fuzz)(arguments, root)


if __name__ == "__main__":
    sys.exit(main())
