"""What the skipping report measures: frames along paths, the cost of one request, and encoding."""

from light_field import scene
from process import BenchError, bench_json, hmlfc_json
from ranges import bytes_of, merged, without
from sparse import sections, write_with_hole

PROFILES = {"main": ["--profile", "main"], "extended": ["--preset", "fast"]}
PATHS = ("orbit", "line", "dolly")
GAPS = (0, 1024, 16384)  # bytes between ranges that one request may span
GRID, SIZE = "9x9", (96, 64)
SCENES = {False: ("cards", "knights", "glass", "flat", "noise"), True: ("cards", "flat")}  # --quick
FRAMES = {False: 16, True: 4}
GRIDS = {False: ("9x9", "17x17", "33x33", "64x64"), True: ("9x9", "17x17")}
SIDES = {False: (32, 64, 128, 256), True: (32, 64)}
HOLES = {False: (0, 1 << 26, 1 << 32, 1 << 36), True: (0, 1 << 32)}
BLOCK_RUNS = 20
VIEW_SIDE = 32  # of the light fields of many views


def encode(work, folder, options):
    """(Path of the stream, what `hmlfc encode --json` says of it)."""
    stream = work / f"{folder.name}.hmlfc"
    return stream, hmlfc_json("encode", folder, "-o", stream, "--threads", 1, *options)


def paths(work, name, profile, quick):
    """A row for each path, cold and warm: what its frames need and what is skipped, lists of a number a frame."""
    stream, facts = encode(work, scene(work, name, GRID, "{}x{}".format(*SIZE)), PROFILES[profile])
    for path in PATHS:
        for client in ("cold", "warm"):
            frames = traced(drawn(stream, path, FRAMES[quick], min(SIZE), client), client)
            with_geometry = traced(drawn(stream, path, FRAMES[quick], min(SIZE), client, "stream"), client)
            row = {"scene": name, "profile": profile, "path": path, "client": client,
                   "file_bytes": facts["bytes"], "blocks": all_blocks(stream, facts)}
            row |= {key: [frame[key] for frame in frames] for key in frames[0]}
            yield row | {f"geometry_{key}": [frame[key] for frame in with_geometry]
                         for key in ("looked_up", "needed", "decoded", "bytes")}


def all_blocks(stream, facts):
    """Blocks of all planes of all views."""
    info = hmlfc_json("info", stream)
    side, halved = info["block"], 2 if info["chroma"] == "420" else 1
    luma = -(-facts["width"] // side) * -(-facts["height"] // side)
    chroma = -(-facts["width"] // halved // side) * -(-facts["height"] // halved // side)
    return facts["rows"] * facts["cols"] * (luma + 2 * chroma)


def drawn(stream, path, frames, side, client, geometry="plane"):
    """What hmlfc_measure tells of frames. A cold renderer decodes what the frame needs and nothing else (NED-1)."""
    found = bench_json("path", stream, path, frames, side, client, geometry)
    for number, frame in enumerate(found):
        if frame["decoded"] + frame["reused"] != frame["needed"] or client == "cold" and frame["reused"]:
            raise BenchError(f"frame {number}, {client}: {frame['decoded']} blocks decoded, {frame['reused']} reused, "
                             f"{frame['needed']} needed")
    return found


def traced(frames, client):
    """The frames with the requests and bytes of a client that fetches what is read. A warm client keeps
    what it has fetched."""
    held = []
    for frame in frames:
        ranges = merged(frame.pop("reads"))
        frame["bytes"] = bytes_of(ranges)
        asked = [merged(without(ranges, held) if client == "warm" else ranges, gap) for gap in GAPS]
        frame["requests"] = [len(found) for found in asked]
        frame["fetched"] = [bytes_of(found) for found in asked]
        held = merged([*held, *ranges])
    return frames


def costs(work, quick):
    """What one block and one view cost by the number of views, by file size and by pixels."""
    for grid in GRIDS[quick]:
        folder = scene(work, "cards", grid, f"{VIEW_SIDE}x{VIEW_SIDE}")
        stream, facts = encode(work, folder, PROFILES["main"])
        yield {"by": "views", "at": facts["rows"] * facts["cols"], **cost(stream, VIEW_SIDE)}
        for hole in HOLES[quick] if grid == GRIDS[quick][1] else ():
            large = work / "large.hmlfc"
            write_with_hole(stream, large, hole)
            yield {"by": "file size", "at": large.stat().st_size, **cost(large, VIEW_SIDE, hole)}
            large.unlink()
    for side in SIDES[quick]:
        stream, _ = encode(work, scene(work, "cards", GRID, f"{side}x{side}"), PROFILES["main"])
        yield {"by": "pixels", "at": side * side, **cost(stream, side)}


def cost(stream, side, beyond=0):
    """One cold block and one cold view of `side` x `side` pixels. beyond: where the block lies at the least."""
    with open(stream, "rb") as file:
        key_end = sum(sections(file.read(1 << 12))[0][2:])
    block = bench_json("block", stream, BLOCK_RUNS)
    views = drawn(stream, "view", 5, side, "cold")
    row = {"file_bytes": stream.stat().st_size, "disk_bytes": stream.stat().st_blocks * 512}
    for name, request in (("block", block), ("view", views[0])):
        ranges = merged(request["reads"])
        keys = bytes_of(r for r in ranges if r[0] < key_end)
        if sum(ranges[-1]) < beyond:
            raise BenchError(f"the {name} does not lie beyond the hole")
        row |= {f"{name}_bytes": bytes_of(ranges) - keys, f"{name}_key_bytes": keys, f"{name}_requests": len(ranges)}
    return row | {
        "block_walks": block["walks"], "block_fields": block["fields"], "view_blocks": views[0]["decoded"],
        "block_cpu_seconds": block["cpu_seconds"], "open_cpu_seconds": block["open_cpu_seconds"],
        "view_cpu_seconds": min(view["cpu_seconds"] for view in views),
    }


def effort(work, quick):
    """CPU time of encoding by what there is to find."""
    for name in ("flat", "noise", "cards"):
        folder = scene(work, name, "5x5" if quick else GRID, "{}x{}".format(*SIZE))
        for window in (16,) if quick else (16, 64):
            _, facts = encode(work, folder, ["--profile", "main", "--window", window])
            pixels = facts["rows"] * facts["cols"] * facts["width"] * facts["height"]
            yield {"scene": name, "window": window, "pixels": pixels, "bytes": facts["bytes"],
                   "cpu_seconds": facts["cpu_seconds"]}
