"""In which checks mutants show at a pin of their module: no other check can find them (observe.py)."""

import concurrent.futures
import json
import pathlib
import subprocess

Observed = dict[str, list[int]]  # check to mutants


def build(folder: pathlib.Path, numbers: set[int]) -> pathlib.Path:
    """The program that observes these mutants of a group, or these and more. `folder` is that of plant.py."""
    listed = folder / "observed.txt"
    before = set(map(int, listed.read_text(encoding="utf-8").split())) if listed.exists() else set()
    if not numbers <= before:
        listed.write_text("\n".join(map(str, sorted(numbers))) + "\n", encoding="utf-8")
    program = folder.parent / f"rtl_observed_{folder.name}"
    tree = next(parent for parent in folder.parents if (parent / "CMakeCache.txt").exists())
    done = subprocess.run(["cmake", "--build", tree, "--target", program.name], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{program.name} cannot be built: {done.stdout[-2000:]}")
    return program


def run(program: pathlib.Path, suite: str, jobs: int) -> Observed:
    """All checks, on the unit without a mutant. Raises RuntimeError where it fails one."""
    def part(number: int) -> str:
        done = subprocess.run([program, suite, "--part", str(number), str(jobs)], stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{program.name} has failed")
        return done.stdout

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        lines = [json.loads(line) for text in pool.map(part, range(jobs)) for line in text.splitlines() if line.startswith("{")]
    return {line["check"]: line["mutants"] for line in lines}


def prove_sound(observed: Observed, found: dict[int, str]) -> None:
    """Raises RuntimeError where a mutant does not differ in a check that has found it."""
    for number, check in found.items():
        if number not in observed.get(check, [number]):
            raise RuntimeError(f"differing.py: mutant {number} is found by {check}, but its shadow does not differ there")


def observe(folder: pathlib.Path, suite: str, numbers: set[int], found: dict[int, str], jobs: int) -> Observed:
    """Of `numbers` and of the mutants of `found`, which must differ in the check that found them. What was observed is kept in `folder`."""
    program, out = build(folder, numbers | found.keys()), folder / "observed.json"
    if not out.exists() or out.stat().st_mtime < program.stat().st_mtime:
        fresh = out.with_suffix(".new")
        fresh.write_text(json.dumps(run(program, suite, jobs)), encoding="utf-8")
        fresh.replace(out)
    observed = json.loads(out.read_text(encoding="utf-8"))
    prove_sound(observed, found)
    return observed
