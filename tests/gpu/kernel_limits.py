#!/usr/bin/env python3
"""Registers and instructions of every kernel in every variant, as Mesa's compiler for a GPU of AMD makes them.

PROGRAM is kernel_statistics. It runs on the null device of Mesa's driver RADV, which compiles for the GPU that RADV_FORCE_FAMILY names
and needs none. Checked are: no spilled register, no scratch memory, and at most MOST_VGPRS vector registers in a kernel; RATCHET has the
kernels that take more today, with what they take, so that none gets worse, and the entry goes as soon as it is not needed.
The table in docs/results/gpu_kernels.md must be that of the kernels, where the driver is the one that it names.

With --update the table is written.

Exit: 0 good, 1 not (each reason is printed), 77 no such driver.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
FAMILY = "gfx1100"
DEVICE = "GFX1100"
DOCUMENT = Path(__file__).parents[2] / "docs/results/gpu_kernels.md"
BEGIN, END = "<!-- kernels begin -->\n", "<!-- kernels end -->\n"

MOST_VGPRS = 64
RATCHET = {"walk": 72, "samples": 72}
NONE_OF = ("Spilled SGPRs", "Spilled VGPRs", "Scratch size")
LEAST_ROWS = 30  # kernels and variants


def measure(program: Path) -> list[dict] | str:
    """The lines of the program, or what is missing."""
    done = subprocess.run([program, DEVICE], env=os.environ | {"RADV_FORCE_FAMILY": FAMILY}, capture_output=True, text=True)
    if done.returncode == SKIPPED:
        return done.stdout.strip()
    done.check_returncode()
    return [json.loads(line) for line in done.stdout.splitlines()]


def name_of(row: dict) -> str:
    return f"{row['kernel']} ({row['use']}{', chunks' if row['chunked'] else ''})"


def problems(rows: list[dict], most: int, ratchet: dict[str, int]) -> list[str]:
    """What is wrong, one line each."""
    found = [] if len(rows) >= LEAST_ROWS else [f"only {len(rows)} kernels and variants were compiled"]
    for row in rows:
        statistics = row["statistics"]
        found += [f"{name_of(row)}: {statistics[what]} of {what}" for what in NONE_OF if statistics[what] != 0]
        limit = ratchet.get(row["kernel"], most)
        if statistics["VGPRs"] > limit:
            found.append(f"{name_of(row)}: {statistics['VGPRs']} VGPRs, more than {limit}")
    for kernel, limit in ratchet.items():
        used = max((row["statistics"]["VGPRs"] for row in rows if row["kernel"] == kernel), default=0)
        if used < limit:
            found.append(f"{kernel} takes {used} VGPRs: lower its entry in RATCHET from {limit}, or delete it at {most} or less")
    return found


def table(rows: list[dict]) -> str:
    text = f"{FAMILY}, {rows[0]['driver']}:\n\n"
    text += "| kernel | for | instructions | in chunks | VGPRs | LDS bytes |\n|---|---|---|---|---|---|\n"
    for plain in (row for row in rows if not row["chunked"]):
        pair = [row["statistics"] for row in rows if (row["kernel"], row["use"]) == (plain["kernel"], plain["use"])]
        instructions = " | ".join(str(statistics["Instructions"]) for statistics in pair)
        vgprs, shared = (max(statistics[what] for statistics in pair) for what in ("VGPRs", "LDS size"))
        text += f"| {plain['kernel']} | {plain['use']} | {instructions} | {vgprs} | {shared} |\n"
    return text


def document_problem(rows: list[dict]) -> list[str]:
    text = DOCUMENT.read_text()
    if rows[0]["driver"] not in text or table(rows) in text:
        return []
    return [f"{DOCUMENT.name} has another table: run this with --update"]


def update(rows: list[dict]) -> None:
    text = DOCUMENT.read_text()
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    DOCUMENT.write_text(text[:begin] + table(rows) + text[end:])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    rows = measure(options.program)
    if isinstance(rows, str):
        print(rows)
        return SKIPPED
    if options.update:
        update(rows)
    found = problems(rows, MOST_VGPRS, RATCHET) + document_problem(rows)
    for problem in found:
        print(problem)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
