"""The tables of docs/skipping.md and docs/scale.md."""

from measure import GAPS

DOCUMENTS = {
    "skipping.md": ("run", "frames", "cost", "effort"),
    "scale.md": ("requests", "latency"),
}
GIB = 1 << 30
ROUNDS = {"cold": 8, "warm": 4}  # dependent reads of a frame in profile main (docs/scale.md)
LINKS = ((1, 1000), (20, 100), (80, 20))  # round trip in ms, megabits a second
GAP = 1  # index into GAPS of the table of latencies


def make(name, results):
    """Lines of one table."""
    return TABLES[name](results)


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(map(str, line)) + " |" if line[0] != "---" else "|" + "---|" * len(line)
            for line in lines]


def mean(path, key):
    """Mean over the frames of a path."""
    return sum(frame[key] for frame in path["frames"]) / len(path["frames"])


def _run(results):
    paths = results["paths"]
    shape = "cold = needed in every frame"
    return table(
        ("scenes", "profiles", "paths", "frames", "cold frames", "processor"),
        [(", ".join(dict.fromkeys(p["scene"] for p in paths)),
          ", ".join(dict.fromkeys(p["profile"] for p in paths)),
          ", ".join(dict.fromkeys(p["path"] for p in paths)),
          sum(len(p["frames"]) for p in paths), shape, results["machine"])],
    )


def _frames(results):
    rows = []
    for path in results["paths"]:
        needed = mean(path, "needed")
        rows.append((
            *(path[key] for key in ("scene", "profile", "path", "client")),
            path["blocks"], f"{path['blocks'] - needed:.0f}", f"{needed:.0f}",
            *(f"{mean(path, key):.0f}" for key in ("decoded", "reused", "zero", "bytes")),
            f"{100 * mean(path, 'bytes') / path['file_bytes']:.1f}",
            f"{1e3 * mean(path, 'cpu_seconds'):.2f}",
        ))
    head = ("scene", "profile", "path", "renderer", "blocks of all views", "not visible", "needed")
    return table((*head, "decoded", "reused", "zero", "bytes touched", "% of file", "CPU ms"), rows)


def _cost(results):
    rows = []
    for cost in results["costs"]:
        block, view = cost["block"], cost["view"]
        rows.append((
            cost["by"], cost["at"], cost["file_bytes"],
            block["bytes"], block["key_bytes"], block["walks"], block["fields"],
            f"{1e6 * block['cpu_seconds']:.0f}", f"{1e6 * block['open_cpu_seconds']:.1f}",
            view["bytes"], view["key_bytes"], view["decoded"], f"{1e6 * view['cpu_seconds']:.0f}",
        ))
    block = ("bytes", "key bytes", "walks", "fields", "CPU us", "open us")
    view = ("bytes", "key bytes", "blocks", "CPU us")
    head = ("by", "at", "file bytes", *(f"block: {n}" for n in block), *(f"view: {n}" for n in view))
    return table(head, rows)


def _effort(results):
    rows = []
    for row in results["effort"]:
        noise = _of(results, "noise", row["window"])
        own, other = (1e9 * r["cpu_seconds"] / r["pixels"] for r in (row, noise))
        exhaustive = 1e9 * row["exhaustive_cpu_seconds"] / row["pixels"]
        rows.append((row["scene"], row["window"], row["bytes"], f"{own:.1f}", f"{exhaustive:.1f}",
                     "yes", f"{other / own:.1f}"))
    head = ("scene", "window", "bytes", "CPU ns a pixel", "with the exhaustive search")
    return table((*head, "same stream", "times faster than noise"), rows)


def _of(results, scene, window):
    return next(r for r in results["effort"] if (r["scene"], r["window"]) == (scene, window))


def _requests(results):
    rows = []
    for path in results["paths"]:
        cells = []
        for k in range(len(GAPS)):
            requests, fetched = (sum(f[key][k] for f in path["frames"]) / len(path["frames"])
                                 for key in ("requests", "fetched"))
            cells.append(f"{requests:.1f}, {fetched:.0f}")
        row = (*(path[key] for key in ("scene", "profile", "path", "client")), path["file_bytes"])
        rows.append((*row, *cells))
    head = ("scene", "profile", "path", "client", "file bytes")
    return table((*head, *(f"requests, bytes; gap {gap}" for gap in GAPS)), rows)


def _latency(results):
    rows = []
    for path in results["paths"]:
        if path["profile"] != "main" or path["path"] != "orbit":
            continue
        fetched = sum(f["fetched"][GAP] for f in path["frames"]) / len(path["frames"])
        rounds = ROUNDS[path["client"]]
        times = [rounds * rtt + fetched * 8 / (1e3 * rate) for rtt, rate in LINKS]
        rows.append((path["scene"], path["client"], rounds, f"{fetched:.0f}",
                     *(f"{ms:.1f}" for ms in times)))
    links = (f"{rtt} ms, {rate} Mbit/s: ms" for rtt, rate in LINKS)
    return table(("scene", "client", "rounds", "bytes", *links), rows)


TABLES = {"run": _run, "frames": _frames, "cost": _cost, "effort": _effort,
          "requests": _requests, "latency": _latency}
