"""The tables of docs/results/skipping.md."""

from measure import GAPS
from result_file import table

ROUNDS = {"cold": 8, "warm": 4}  # dependent reads of a frame in profile main (docs/scale.md)
LINKS = ((1, 1000), (20, 100), (80, 20))  # round trip in ms, megabits a second
GAP = 1  # index into GAPS of the table of latencies
PATH = ("scene", "profile", "path", "client")


def tables(results):
    """Pairs (what a table shows, its lines)."""
    return [(title, make(results)) for title, make in TITLES.items()]


def mean(path, key):
    """Mean over the frames of a path."""
    return sum(path["frames"][key]) / len(path["frames"][key])


def mean_of(path, key, gap):
    """The same of what is listed by gap."""
    return sum(counts[gap] for counts in path["frames"][key]) / len(path["frames"][key])


def _run(results):
    paths = results["paths"]
    listed = [", ".join(dict.fromkeys(p[key] for p in paths)) for key in ("scene", "profile", "path")]
    frames = sum(len(path["frames"]["needed"]) for path in paths)
    return table(("scenes", "profiles", "paths", "frames", "processor"),
                 [(*listed, frames, results["machine"])])


def _frames(results):
    rows = []
    for path in results["paths"]:
        needed = mean(path, "needed")
        rows.append((
            *(path[key] for key in PATH),
            path["blocks"], f"{path['blocks'] - needed:.0f}", f"{needed:.0f}",
            *(f"{mean(path, key):.0f}" for key in ("decoded", "reused", "zero", "bytes")),
            f"{100 * mean(path, 'bytes') / path['file_bytes']:.1f}",
            f"{1e3 * mean(path, 'cpu_seconds'):.2f}",
        ))
    head = ("scene", "profile", "path", "renderer", "blocks of all views", "not visible", "needed")
    return table((*head, "decoded", "reused", "zero", "bytes touched", "% of file", "CPU ms"), rows)


def _geometry(results):
    rows = []
    for plane, path in zip(results["paths"], results["geometry"]):
        pairs = [f"{mean(of, key):.0f}" for key in ("needed", "bytes") for of in (plane, path)]
        rows.append((*(path[key] for key in PATH), f"{mean(path, 'looked_up'):.0f}", *pairs))
    head = [f"{what}, {of}" for what in ("needed", "bytes touched") for of in ("plane", "geometry")]
    return table((*PATH[:-1], "renderer", "disparities looked up", *head), rows)


def _cost(results):
    rows = []
    for cost in results["costs"]:
        block, view = cost["block"], cost["view"]
        rows.append((
            cost["by"], cost["at"], cost["file_bytes"],
            *(block[key] for key in ("bytes", "key_bytes", "walks", "fields")),
            f"{1e6 * block['cpu_seconds']:.0f}", f"{1e6 * block['open_cpu_seconds']:.1f}",
            *(view[key] for key in ("bytes", "key_bytes", "decoded")),
            f"{1e6 * view['cpu_seconds']:.0f}",
        ))
    block = [f"block: {name}" for name in ("bytes", "key bytes", "walks", "fields", "CPU us", "open us")]
    view = [f"view: {name}" for name in ("bytes", "key bytes", "blocks", "CPU us")]
    return table(("by", "at", "file bytes", *block, *view), rows)


def _effort(results):
    noise = {row["window"]: row for row in results["effort"] if row["scene"] == "noise"}
    rows = []
    for row in results["effort"]:
        other = noise[row["window"]]
        own, slow, of_noise = (
            1e9 * seconds / pixels
            for seconds, pixels in ((row["cpu_seconds"], row["pixels"]),
                                    (row["exhaustive_cpu_seconds"], row["pixels"]),
                                    (other["cpu_seconds"], other["pixels"]))
        )
        rows.append((row["scene"], row["window"], row["bytes"], f"{own:.1f}", f"{slow:.1f}",
                     f"{of_noise / own:.1f}"))
    head = ("scene", "window", "bytes", "CPU ns a pixel", "with the exhaustive search")
    return table((*head, "times faster than noise"), rows)


def _requests(results):
    rows = []
    for path in results["paths"]:
        cells = [f"{mean_of(path, 'requests', gap):.1f}, {mean_of(path, 'fetched', gap):.0f}"
                 for gap in range(len(GAPS))]
        rows.append((*(path[key] for key in PATH), path["file_bytes"], *cells))
    return table((*PATH, "file bytes", *(f"requests, bytes; gap {gap}" for gap in GAPS)), rows)


def _latency(results):
    rows = []
    for path in results["paths"]:
        if (path["profile"], path["path"]) == ("main", "orbit"):
            fetched, rounds = mean_of(path, "fetched", GAP), ROUNDS[path["client"]]
            times = [rounds * rtt + fetched * 8 / (1e3 * rate) for rtt, rate in LINKS]
            rows.append((path["scene"], path["client"], rounds, f"{fetched:.0f}",
                         *(f"{ms:.1f}" for ms in times)))
    links = (f"{rtt} ms, {rate} Mbit/s: ms" for rtt, rate in LINKS)
    return table(("scene", "client", "rounds", "bytes", *links), rows)


TITLES = {
    "The recorded run": _run,
    "Frames, mean of a path": _frames,
    "The same frames with geometry, mean of a path": _geometry,
    "Cost of one request": _cost,
    "The encoder's search": _effort,
    "Range requests of a frame, mean of a path": _requests,
    f"Latency of a frame, profile main, path orbit, gap {GAPS[GAP]}": _latency,
}
