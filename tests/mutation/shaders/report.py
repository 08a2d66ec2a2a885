"""What became of the mutants of a run, as text and as JSON."""

import json

from mutants import KINDS


def counts_of(results):
    """How many of (mutant, verdict) came to each end."""
    ends = ("killed", "crash", "timeout", "equivalent", "survived", "not_compiled")
    return {end: sum(verdict.result == end for _, verdict in results) for end in ends}


def killed(counts):
    """The mutants that the suite told from the shader, in one way or another."""
    return counts["killed"] + counts["crash"] + counts["timeout"]


def exit_status(results):
    """What a run ends with: a survivor is a failure, and so is a run of no mutants."""
    counts = counts_of(results)
    return 1 if counts["survived"] or len(results) == counts["not_compiled"] else 0


def report_lines(results, seed):
    """The counts, a table of kinds, and each mutant that was not killed by wrong output."""
    counts = counts_of(results)
    yield (
        f"seed {seed}: {len(results) - counts['not_compiled']} mutants, {killed(counts)} killed "
        f"({counts['killed']} by wrong output, {counts['crash']} by a crash, "
        f"{counts['timeout']} by time), {counts['equivalent']} equivalent, "
        f"{counts['survived']} survived; {counts['not_compiled']} more did not compile\n"
    )
    yield f"{'kind':12} {'mutants':>8} {'killed':>8} {'equivalent':>11} {'survived':>9}"
    for kind in KINDS:
        own = counts_of([result for result in results if result[0].kind == kind])
        all_of_kind = killed(own) + own["equivalent"] + own["survived"]
        yield (
            f"{kind:12} {all_of_kind:8} {killed(own):8} {own['equivalent']:11} {own['survived']:9}"
        )
    for end in ("timeout", "crash", "equivalent", "survived"):
        listed = [(mutant, verdict) for mutant, verdict in results if verdict.result == end]
        if listed:
            yield f"\n{end}:"
        for mutant, verdict in listed:
            yield f"  {mutant.name()}" + (f" ({verdict.detail})" if verdict.detail else "")


def report_text(results, seed):
    """All of it for a terminal."""
    return "\n".join(report_lines(results, seed))


def report_json(results, seed):
    """The same with every mutant, for programs."""
    mutants = [
        {**mutant.__dict__, "result": verdict.result, "detail": verdict.detail}
        for mutant, verdict in results
    ]
    return json.dumps({"seed": seed, **counts_of(results), "mutants": mutants}, indent=1)
