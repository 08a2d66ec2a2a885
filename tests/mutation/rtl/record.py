"""recorded.json, what became of the mutants of each group, and survivors.json, why some survive."""

import collections
import hashlib
import json
import pathlib

import prove

HERE = pathlib.Path(__file__).resolve().parent
RECORDED = HERE / "recorded.json"
# Of a group: the checksum of its mutants.json, which gives the numbers their meaning; module to its numbers; check to numbers of
# those that it found; numbers of those that are proved equivalent, that take other clocks, that survive for a reason, and without one.
ENDS = ("equivalent", "other_clocks", "explained", "unexplained")
EMPTY = {"mutants_sha256": "", "made": {}, "found": {}} | {end: [] for end in ENDS}


def read() -> dict[str, dict]:
    return json.loads(RECORDED.read_text(encoding="utf-8"))


def of_group(group: str, listed: bytes) -> dict:
    """What is recorded of a group, if that is of the very mutants of `listed`."""
    digest = hashlib.sha256(listed).hexdigest()
    kept = EMPTY | read().get(group, {})
    if kept["mutants_sha256"] == digest:
        return kept
    made = collections.defaultdict(list)
    for mutant in json.loads(listed)["mutants"]:
        made[mutant["module"]].append(mutant["number"])
    return EMPTY | {"mutants_sha256": digest, "made": made}


def found_by(kept: dict) -> dict[int, str]:
    """Which check found a mutant."""
    return {number: check for check, found in kept["found"].items() for number in found}


def numbers(kept: dict) -> set[int]:
    """Mutants with a result."""
    return {*found_by(kept), *(number for end in ENDS for number in kept[end])}


def end_of(result: dict) -> str:
    """Of what no check finds."""
    if result["proof"] == prove.EQUIVALENT:
        return "equivalent"
    return "other_clocks" if "speed" in result else "explained" if "reason" in result else "unexplained"


def write(group: str, kept: dict, results: dict[int, dict]) -> None:
    """Puts `results` in the place of what is recorded of their mutants; those without an end yet are left out."""
    found = {number: check for number, check in found_by(kept).items() if number not in results}
    others = {end: set(kept[end]) - set(results) for end in ENDS}
    for number, result in results.items():
        if "vector" in result:
            found[number] = result["vector"]
        elif "proof" in result:
            others[end_of(result)].add(number)
    by_check = collections.defaultdict(list)
    for number, check in sorted(found.items()):
        by_check[check].append(number)
    all_groups = read()
    all_groups[group] = kept | {"found": dict(sorted(by_check.items()))} | {end: sorted(value) for end, value in others.items()}
    fresh = RECORDED.with_suffix(".new")  # campaigns of other groups read it meanwhile
    fresh.write_text(text(all_groups), encoding="utf-8")
    fresh.replace(RECORDED)


def text(groups: dict[str, dict]) -> str:
    """As JSON with a line for each list of numbers."""
    def written(value, depth: int) -> str:
        if not isinstance(value, dict) or not value:
            return json.dumps(value)
        rows = ",\n".join(f"{' ' * depth}{json.dumps(key)}: {written(inner, depth + 1)}" for key, inner in value.items())
        return "{\n" + rows + "}"
    return written(groups, 1) + "\n"


def identity(mutant: dict) -> tuple[str, str, str]:
    return mutant["module"], json.dumps(mutant["parameters"]), mutant["command"]


def reasons() -> dict[tuple[str, str, str], str]:
    listed = json.loads((HERE / "survivors.json").read_text(encoding="utf-8"))
    return {identity(entry): entry["reason"] for entry in listed}
