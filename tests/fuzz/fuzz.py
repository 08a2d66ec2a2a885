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
from pathlib import Path

TARGETS = ["open", "block", "refetch", "tile_record", "motion_record", "disparity_record", "codestream", "view", "json"]
MAX_BYTES = 32768  # of an input; few vectors are larger
UNIT_SECONDS = 20  # for one input; more is a finding
MEMORY_MB = 2048


def last_number(pattern, log):
    numbers = re.findall(pattern, log)
    return int(numbers[-1]) if numbers else 0


def cpu_seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run_target(target, program, corpus, findings, seconds, seed):
    """Runs `program` of `target` for `seconds` of wall clock. Returns (its log, CPU seconds, whether it found something)."""
    findings.mkdir(parents=True, exist_ok=True)
    command = [
        *(str(program), str(corpus), f"-max_total_time={seconds}", f"-seed={seed}"),
        *(f"-max_len={MAX_BYTES}", f"-timeout={UNIT_SECONDS}", f"-rss_limit_mb={MEMORY_MB}"),
        *("-print_final_stats=1", f"-artifact_prefix={findings}/"),
    ]
    words = Path(__file__).with_name(f"{target}.dict")
    if words.exists():
        command.append(f"-dict={words}")
    before = cpu_seconds_of_children()
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    log = result.stdout.decode(errors="replace")
    return log, cpu_seconds_of_children() - before, result.returncode != 0


def write_seeds(build, target, suite, corpus):
    replay = build / f"tests/fuzz/replay_{target}"
    findings = Path(__file__).parent / "findings" / target
    paths = [str(suite)] + ([str(findings)] if findings.is_dir() else [])
    command = [str(replay), "--write", str(corpus), *paths]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def fuzz(arguments, root):
    """Runs the targets."""
    targets = TARGETS if arguments.target == "all" else [arguments.target]
    seconds = max(1, round(60 * arguments.minutes / len(targets)))
    corpora, folder = arguments.build / "corpus", root / "out/fuzz"
    failed = 0
    print(f"{'target':<18}{'executions':>12}{'CPU s':>9}{'edges':>8}  findings")
    for target in targets:
        write_seeds(arguments.build, target, root / "vectors", corpora / target)
        program = arguments.build / f"tests/fuzz/fuzz_{target}"
        log, cpu, found = run_target(target, program, corpora / target, folder / target, seconds, arguments.seed)
        failed += found
        executions = last_number(r"stat::number_of_executed_units: (\d+)", log) or last_number(r"#(\d+)\t", log)
        edges = last_number(r"cov: (\d+)", log)
        print(f"{target:<18}{executions:>12}{cpu:>9.1f}{edges:>8}  {folder / target if found else 'none'}", flush=True)
        if found:
            print(log[-4000:], file=sys.stderr)
    print(f"again: ./run fuzz {arguments.target} --minutes {arguments.minutes:g} --seed {arguments.seed}")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(prog="./run fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("target", choices=[*TARGETS, "all"])
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--minutes", type=float, default=10, help="for all targets together")
    parser.add_argument("--seed", type=int, default=1, help="of libFuzzer; 0: another each time")
    arguments = parser.parse_args()
    root = Path(__file__).resolve().parents[2]
    return fuzz(arguments, root)


if __name__ == "__main__":
    sys.exit(main())
