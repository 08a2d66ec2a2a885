"""Checks the naive decoder against one vector of the conformance suite."""

import hashlib
import json

import paths

from block import BlockDecoder
from comparison import attempt, cropped
from crc32c import crc32c
from light_field import decode_view
from opening import Stream
from picture_files import raw_bytes
from trace import PLANE_NAMES, trace_block


FOLDER = paths.DECODER.parents[1] / "vectors"


def load_vectors():
    """The vectors of the manifest, the largest first."""
    vectors = json.loads((FOLDER / "manifest.json").read_text())["vectors"]
    return sorted(vectors, key=lambda vector: -vector["input"]["bytes"])


def sha256(data):
    """In hexadecimal."""
    return hashlib.sha256(data).hexdigest()


def check_vector(folder, vector):
    """What is wrong with one vector of the manifest, one line each; an empty list if nothing."""
    data = (folder / vector["input"]["file"]).read_bytes()
    if (len(data), sha256(data)) != (vector["input"]["bytes"], vector["input"]["sha256"]):
        return ["the input file is not that of the manifest"]
    expect = vector["expect"]
    stream = attempt(Stream, data)
    if isinstance(stream, str):
        opening = expect["outcome"] != "ok" and expect["operation"] == "open"
        named = opening and expect["error"] in (stream, "limit_exceeded")  # FIL-7: this decoder has no limits
        return [] if named else [f"opening gives {stream}"]
    if expect["outcome"] == "reject" and expect["operation"] == "open":
        return ["it opens"]
    decoder = BlockDecoder(stream)
    wrong = check_failing_blocks(decoder, expect)
    if "output" in vector:
        wrong += check_output(decoder, folder, vector)
    if "trace" in vector:
        wrong += check_trace(decoder, folder / vector["trace"]["file"])
    return wrong


def check_failing_blocks(decoder, expect):
    """The blocks named must fail with the error named."""
    wrong = []
    for block in expect.get("blocks", []):
        plane = PLANE_NAMES.index(block["plane"])
        place = block["view_row"], block["view_col"], plane, block["block_x"], block["block_y"]
        outcome = attempt(decoder.decode, *place)
        if outcome != expect["error"]:
            wrong.append(f"block {place} gives {outcome if isinstance(outcome, str) else 'samples'}")
    return wrong


def check_output(decoder, folder, vector):
    """Samples of all views; with failing blocks, of the views that decode."""
    header = decoder.stream.header
    places = [(row, col) for row in range(header.rows) for col in range(header.cols)]
    views = {place: attempt(decode_view, decoder, *place) for place in places}
    failing = [place for place in places if isinstance(views[place], str)]
    named = {(block["view_row"], block["view_col"]) for block in vector["expect"].get("blocks", [])}
    wrong = [f"view {place} gives {views[place]}" for place in failing if place not in named]
    raw = b"".join(raw_bytes(views[place], header.depth) for place in places if place not in failing)
    if sha256(raw) != vector["output"]["sha256"]:
        wrong.append("the samples differ")
    if "blocks" in vector and not failing:
        text = "".join(block_lines(decoder.stream, place, view) for place, view in views.items())
        if text != (folder / vector["blocks"]["file"]).read_text():
            wrong.append("the checksums of blocks differ")
    return wrong


def block_lines(stream, place, view):
    """The two lines of a view in a blocks file: its place; a CRC-32C of each B x B pixels."""
    side, header = stream.geometry.block, stream.header
    checksums = []
    for y in range(0, header.height, side):
        for x in range(0, header.width, side):
            pixels = [row[x : x + side] for row in view[y : y + side]]
            checksums.append(f"{crc32c(raw_bytes(pixels, header.depth)):08x}")
    return f"{place[0]} {place[1]}\n{' '.join(checksums)}\n"


def check_trace(decoder, file):
    """The stages of the traced blocks."""
    records = [json.loads(line) for line in file.read_text().splitlines()]
    wrong, expected = [], []
    for record in records + [{"record": "block"}]:
        if record["record"] == "block" and expected:
            place = (*expected[0]["view"], PLANE_NAMES.index(expected[0]["plane"]), *expected[0]["block"])
            actual = cropped(attempt(trace_block, decoder, *place), decoder.stream.geometry)
            if actual != cropped(expected, decoder.stream.geometry):
                wrong.append(f"stages of block {place} differ")
            expected = []
        if record["record"] in ("block", "stage"):
            expected.append(record)
    return wrong
