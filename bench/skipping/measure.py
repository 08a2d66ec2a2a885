"""What the skipping report measures: frames along paths, the cost of one request, and encoding."""

import json

import sparse
from process import BenchError, run
from ranges import bytes_of, merged, without

SCENES = ("cards", "knights", "glass", "flat", "noise")
PROFILES = {"main": ["--profile", "main"], "extended": ["--preset", "fast"]}
PATHS = ("orbit", "line", "dolly")
GAPS = (0, 1024, 16384)  # bytes between ranges that one request may span
GEOMETRY_COUNTS = ("looked_up", "needed", "decoded", "bytes")
FRAMES = {False: 16, True: 4}
GRID, SIZE = "9x9", (96, 64)
GRIDS = {False: ("9x9", "17x17", "33x33", "64x64"), True: ("9x9", "17x17")}
SIDES = {False: (32, 64, 128, 256), True: (32, 64)}
HOLES = {False: (0, 1 << 26, 1 << 32, 1 << 36), True: (0, 1 << 20, 1 << 32)}
CHECKED_HOLES = {False: 1 << 32, True: 1 << 20}  # up to here all checksums are checked
BLOCK_RUNS = 20
VIEW_SIDE = 32  # of the light fields of many views


class Measure:
    """Runs the programs in the folder `work`. programs: hmlfc, bench_skipping and
    bench_skipping_exhaustive."""

    def __init__(self, programs, work, quick):
        self.hmlfc, self.bench, self.exhaustive = programs
        self.work, self.quick = work, quick

    def synth(self, scene, grid, width, height):
        folder = self.work / f"{scene}-{grid}-{width}x{height}"
        if not folder.exists():
            size = f"{width}x{height}"
            run([self.hmlfc, "synth", "--scene", scene, "--grid", grid, "--size", size, "-o", folder])
        return folder

    def encode(self, folder, options, program=None):
        """(Path of the stream, what `hmlfc encode --json` says of it)."""
        program = program or self.hmlfc
        stream = self.work / f"{folder.name}.{program.name}.hmlfc"
        command = [program, "encode", folder, "-o", stream, "--threads", 1, "--json", *options]
        return stream, json.loads(run(command)[0])

    def frames(self, scene, profile, geometry="plane"):
        """For each path, cold and warm: what its frames need and what is skipped."""
        stream, facts = self.encode(self.synth(scene, GRID, *SIZE), PROFILES[profile])
        rows = []
        for path in PATHS:
            for client in ("cold", "warm"):
                found = self.drawn(stream, path, FRAMES[self.quick], min(SIZE), client, geometry)
                rows.append({
                    "scene": scene, "profile": profile, "path": path, "client": client,
                    "file_bytes": facts["bytes"], "blocks": self.blocks(stream, facts),
                    "frames": columns(list(traced(found, client))),
                })
        return rows

    def geometry(self, scene, profile):
        """The same frames with geometry."""
        rows = self.frames(scene, profile, "stream")
        for row in rows:
            row["frames"] = {key: row["frames"][key] for key in GEOMETRY_COUNTS}
        return rows

    def blocks(self, stream, facts):
        """All blocks of all views."""
        info = json.loads(run([self.hmlfc, "info", stream, "--json"])[0])
        side = info["block"]
        halved = 2 if info["chroma"] == "420" else 1
        luma = _blocks(facts["width"], facts["height"], side)
        chroma = _blocks(-(-facts["width"] // halved), -(-facts["height"] // halved), side)
        return facts["rows"] * facts["cols"] * (luma + 2 * chroma)

    def costs(self):
        """What one block and one view cost by the number of views, by pixels and by file size."""
        quick = self.quick
        for grid in GRIDS[quick]:
            folder = self.synth("cards", grid, VIEW_SIDE, VIEW_SIDE)
            stream, facts = self.encode(folder, PROFILES["main"])
            views = facts["rows"] * facts["cols"]
            yield {"by": "views", "at": views, **self.cost(stream, VIEW_SIDE)}
            if grid == GRIDS[quick][1]:
                for hole in HOLES[quick]:
                    large = self.work / "large.hmlfc"
                    sparse.write_with_hole(stream, large, hole)
                    if 0 < hole <= CHECKED_HOLES[quick]:
                        self.same_view(stream, large)
                    cost = self.cost(large, VIEW_SIDE)
                    if cost["block"]["last_byte"] < hole:
                        raise BenchError("the block does not lie beyond the hole")
                    yield {"by": "file size", "at": large.stat().st_size, **cost}
                    large.unlink()
        for side in SIDES[quick]:
            stream, _ = self.encode(self.synth("cards", GRID, side, side), PROFILES["main"])
            yield {"by": "pixels", "at": side * side, **self.cost(stream, side)}

    def cost(self, stream, side):
        with open(stream, "rb") as file:
            entries = sparse.sections(sparse.read_header(file))
        key_end = entries[0][2] + entries[0][3]
        block = json.loads(run([self.bench, "block", stream, BLOCK_RUNS])[0])
        views = self.drawn(stream, "view", 5, side, "cold")
        return {
            "file_bytes": stream.stat().st_size,
            "disk_bytes": stream.stat().st_blocks * 512,
            "block": {"open_cpu_seconds": block["open_cpu_seconds"], **_request([block], key_end),
                      "walks": block["walks"], "fields": block["fields"]},
            "view": {**_request(views, key_end), "decoded": views[0]["decoded"]},
        }

    def drawn(self, stream, path, frames, side, client, geometry="plane"):
        command = [self.bench, "frames", stream, path, frames, side, client, geometry]
        found = json.loads(run(command)[0])
        check(client, found)
        return found

    def same_view(self, stream, large):
        """`hmlfc decode`, which checks all checksums, gives the same view of both."""
        pictures = []
        for file in (stream, large):
            folder = self.work / "view"
            run([self.hmlfc, "decode", file, "--view", "8,8", "-o", folder])
            pictures.append((folder / "08_08.png").read_bytes())
        if pictures[0] != pictures[1]:
            raise BenchError("the stream with a hole is another light field")

    def effort(self):
        """CPU time of encoding a pixel, and whether the exhaustive search gives the same stream."""
        for scene in ("flat", "noise", "cards"):
            folder = self.synth(scene, "5x5" if self.quick else GRID, *SIZE)
            for window in (16,) if self.quick else (16, 64):
                options = ["--profile", "main", "--window", window]
                fast, facts = self.encode(folder, options)
                slow, other = self.encode(folder, options, self.exhaustive)
                if fast.read_bytes() != slow.read_bytes():
                    raise BenchError(f"{scene}: the exhaustive search gives another stream")
                pixels = facts["rows"] * facts["cols"] * facts["width"] * facts["height"]
                yield {"scene": scene, "window": window, "pixels": pixels, "bytes": facts["bytes"],
                       "cpu_seconds": facts["cpu_seconds"],
                       "exhaustive_cpu_seconds": other["cpu_seconds"]}


def check(client, frames):
    """A renderer that starts cold decodes what the frame needs and nothing else (NED-1)."""
    for number, frame in enumerate(frames):
        if frame["decoded"] + frame["reused"] != frame["needed"]:
            raise BenchError(f"frame {number}: decoded and reused blocks are not those needed")
        if client == "cold" and frame["decoded"] != frame["needed"]:
            raise BenchError(f"frame {number}: a cold renderer decoded {frame['decoded']} blocks, "
                             f"but {frame['needed']} are needed")


def traced(frames, client):
    """Frames with the requests and bytes of a client that fetches what is read. A warm client keeps
    what it has fetched."""
    held = []
    for frame in frames:
        ranges = merged(frame.pop("reads"))
        frame["bytes"] = bytes_of(ranges)
        missing = without(ranges, held) if client == "warm" else ranges
        asked = [merged(missing, gap) for gap in GAPS]
        frame["requests"] = [len(found) for found in asked]
        frame["fetched"] = [bytes_of(found) for found in asked]
        held = merged([*held, *ranges])
        yield frame


def columns(rows):
    """From a list of objects to an object of lists."""
    return {key: [row[key] for row in rows] for key in rows[0]}


def _request(runs, key_end):
    ranges = merged(runs[0]["reads"])
    keys = bytes_of(r for r in ranges if r[0] < key_end)
    return {
        "cpu_seconds": min(entry["cpu_seconds"] for entry in runs),
        "bytes": bytes_of(ranges) - keys, "key_bytes": keys, "requests": len(ranges),
        "last_byte": sum(ranges[-1]), "key_samples": runs[0]["key_samples"],
    }


def _blocks(width, height, side):
    return -(-width // side) * -(-height // side)
