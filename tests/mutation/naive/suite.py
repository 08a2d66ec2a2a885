"""The vectors, and what the naive decoder as it is does on each: which statements it executes, for how long."""

import json
import sys
import time
from dataclasses import dataclass, field

from decoder import FOLDER, ROOT, Decoder, Modules, counted, decoder_files

SUITE = ROOT / "vectors"


@dataclass
class Vector:
    """A vector of the manifest, and what the decoder does on it."""

    entry: dict
    data: bytes
    errors: set = field(default_factory=set)  # of its views: a decoder may report any of them (DEC-7)
    sites: frozenset = frozenset()  # (file, first line) of the statements executed
    seconds: float = 0  # of CPU time

    @property
    def name(self):
        return self.entry["id"]

    @property
    def by_block(self):
        """Whether single blocks fail."""
        return self.entry["expect"].get("operation") == "block"

    def fits(self, outcome):
        """Whether whole views are as `hmlfc conform` demands of a command line that names errors."""
        expect = self.entry["expect"]
        if expect["outcome"] == "ok":
            return outcome == bytes.fromhex(self.entry["output"]["sha256"])
        if self.by_block and outcome in self.errors:
            return True
        if expect["outcome"] == "acceptable" and outcome == bytes.fromhex(self.entry["output"]["sha256"]):
            return True
        return outcome == expect["error"]

    def blocks_fit(self, decoder):
        """Whether single blocks are as the manifest says: those that it names fail with their error, those with a
        checksum in the blocks file decode to it, the others fail."""
        blocks, expect = decoder.open(self.data), self.entry["expect"]
        if isinstance(blocks, str):
            return False
        errors = decoder.failing_blocks(blocks, expect["blocks"])
        if any(error != expect["error"] for error in errors):
            return False
        return decoder.block_sums(blocks) == (SUITE / self.entry["blocks"]["file"]).read_text()


class Suite:
    """The vectors, the smallest first, or those with the ids `only`. They are tried out as they are asked for."""

    def __init__(self, only=None):
        entries = json.loads((SUITE / "manifest.json").read_text())["vectors"]
        entries = [entry for entry in entries if only is None or entry["id"] in only]
        self.waiting = sorted(entries, key=lambda entry: -entry["input"]["bytes"])
        self.tried, self.known, self.hits = [], {}, set()
        codes = {file: counted(file, (FOLDER / file).read_text()) for file in decoder_files()}
        self.modules = Modules(codes, HITS=self.hits).load()

    def batch(self, number):
        """The vectors 2^number * 40 - 40 and those that follow, each time twice as many; [] after the last."""
        begin, end = ((40 << exponent) - 40 for exponent in (number, number + 1))
        while self.waiting and len(self.tried) < end:
            self.tried.append(self.try_out(self.waiting.pop()))
        return self.tried[begin:end]

    def try_out(self, entry):
        """Runs the decoder as it is. ValueError if it fails the vector."""
        vector = Vector(entry, (SUITE / entry["input"]["file"]).read_bytes())
        for module in self.modules.values():
            for value in vars(module).values():
                if hasattr(value, "cache_clear"):
                    value.cache_clear()
        self.hits.clear()
        begin = time.process_time()
        decoder = Decoder(self.modules, self.known, None)
        outcome = decoder.whole_views(vector.data)
        if vector.by_block:
            vector.errors = decoder.view_errors(vector.data)
            if not vector.blocks_fit(decoder):
                raise ValueError(f"{vector.name}: the naive decoder as it is fails its blocks")
        if not vector.fits(outcome):
            raise ValueError(f"{vector.name}: the naive decoder as it is gives {outcome}")
        vector.seconds = time.process_time() - begin
        vector.sites = frozenset(sys.intern(f"{file}:{line}") for file, line in self.hits)
        return vector
