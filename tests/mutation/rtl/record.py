"""recorded.json, what became of the mutants of each group, and survivors.json, why some survive."""

import collections
import hashlib
import json
import pathlib
import re

import prove

HERE = pathlib.Path(__file__).resolve().parent
RECORDED = HERE / "recorded.json"
# Of a group: module to the checksum of its netlists and mutants, and to its numbers in mutants.json; check to numbers of those that it
# found; numbers of those that are proved equivalent, that take other clocks, that survive for a reason, and without a reason.
ENDS = ("equivalent", "other_clocks", "explained", "unexplained")
EMPTY = {"sha256": {}, "made": {}, "found": {}} | {end: [] for end in ENDS}
POSITION = re.compile(r"hmlfc_\w+\.svh?:[\d.-]+")  # of a source, which a comment above it changes


def read() -> dict[str, dict]:
    return {group: EMPTY | kept for group, kept in json.loads(RECORDED.read_text(encoding="utf-8")).items()}


def digests(folder: pathlib.Path, mutants: list[dict]) -> dict[str, str]:
    """Of each module the checksum of its netlists, in the folder of plant.py, and its mutants; no position in a source counts."""
    texts = collections.defaultdict(list)
    for mutant in mutants:
        texts[mutant["module"]].append(POSITION.sub("", mutant["command"]))
    for module, variant in dict.fromkeys((mutant["module"], mutant["variant"]) for mutant in mutants):
        netlist = (folder / f"{variant}.il").read_text(encoding="utf-8").splitlines()
        texts[module] += [POSITION.sub("", line) for line in netlist if not line.lstrip().startswith("attribute \\src")]
    return {module: hashlib.sha256("\n".join(text).encode()).hexdigest() for module, text in texts.items()}


def of_group(group: str, folder: pathlib.Path, mutants: list[dict]) -> dict:
    """What is recorded of modules of a group that are still the same, of their mutants with the numbers that they have now."""
    kept = EMPTY | read().get(group, {})
    made = collections.defaultdict(list)
    for mutant in mutants:
        made[mutant["module"]].append(mutant["number"])
    now = digests(folder, mutants)
    number = {}  # from what is recorded
    for module in made:
        if kept["sha256"].get(module) == now[module]:
            number |= zip(kept["made"][module], made[module])
    still = {key: [number[one] for one in kept[key] if one in number] for key in ENDS}
    found = {check: [number[one] for one in ones if one in number] for check, ones in kept["found"].items()}
    return {"sha256": now, "made": made, "found": {check: ones for check, ones in found.items() if ones}} | still


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
    return next((end for end, key in (("other_clocks", "speed"), ("explained", "reason")) if key in result), "unexplained")


def write(group: str, kept: dict, results: dict[int, dict]) -> None:
    """Puts `results` in the place of what is recorded of their mutants; those without an end yet change nothing."""
    ended = {number: result for number, result in results.items() if "vector" in result or "proof" in result}
    found = {number: check for number, check in found_by(kept).items() if number not in ended}
    others = {end: set(kept[end]) - set(ended) for end in ENDS}
    for number, result in ended.items():
        if "vector" in result:
            found[number] = result["vector"]
        else:
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
    return mutant["module"], json.dumps(mutant["parameters"]), POSITION.sub("", mutant["command"])


def reasons() -> dict[tuple[str, str, str], str]:
    listed = json.loads((HERE / "survivors.json").read_text(encoding="utf-8"))
    return {identity(entry): entry["reason"] for entry in listed}
