#!/usr/bin/env python3
"""vectors_test.py PROGRAM MANIFEST: a C99 program decodes every vector to the manifest's checksum, and refuses damaged
ones by the manifest's names.

The same comparison with expectations that are wrong must fail.
"""

import copy
import hashlib
import json
import subprocess
import sys
from pathlib import Path

PLANES = {"Y": 0, "Co": 1, "Cg": 2}


class Decoder:
    """The program decode_requests."""

    def __init__(self, program):
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def ask(self, request):
        """(word, number) of the answer; (SHA-256 of the raw form, None) where it is views."""
        self.process.stdin.write(f"{request}\n".encode())
        self.process.stdin.flush()
        word, *number = self.process.stdout.readline().decode().split()
        if number and word == "ok":
            return hashlib.sha256(self.process.stdout.read(int(number[0]))).hexdigest(), None
        return word, int(number[0]) if number else None


def problems(decoder, folder, vector):
    """What is wrong with a vector, as texts."""
    file = folder / vector["input"]["file"]
    expect = vector["expect"]
    refusal = (expect.get("error"), expect.get("offset"))
    if expect["outcome"] == "reject" and expect["operation"] == "block":
        answers = [
            decoder.ask(
                f"block {block['view_row']} {block['view_col']} {PLANES[block['plane']]} "
                f"{block['block_x']} {block['block_y']} {file}"
            )
            for block in expect["blocks"]
        ]
        allowed = [refusal]
    else:
        answers = [decoder.ask(f"views {file}")]
        allowed = [refusal] if expect["outcome"] != "ok" else []
        if expect["outcome"] != "reject":
            allowed.append((vector["output"]["sha256"], None))
    return [f"{vector['id']}: {answer}, not {allowed}" for answer in answers if answer not in allowed]


def wrong(vector):
    """The vector with another expectation."""
    other = copy.deepcopy(vector)
    if vector["expect"]["outcome"] == "ok":
        other["output"]["sha256"] = "0" * 64
    else:
        other["expect"]["error"] = "bad_magic" if vector["expect"]["error"] != "bad_magic" else "truncated"
    return other


def main():
    program, manifest = sys.argv[1:]
    folder = Path(manifest).parent
    decoder = Decoder(program)
    vectors = json.loads(Path(manifest).read_text())["vectors"]
    found = [text for vector in vectors for text in problems(decoder, folder, vector)]
    assert not found, "\n".join(found[:20])
    kinds = {(vector["expect"]["outcome"], vector["expect"].get("operation")): vector for vector in vectors}
    assert {("ok", None), ("reject", "open"), ("reject", "block")} <= set(kinds), set(kinds)
    for vector in kinds.values():
        if vector["expect"]["outcome"] != "acceptable":
            assert problems(decoder, folder, wrong(vector)), f"{vector['id']}: a wrong expectation is not seen"


if __name__ == "__main__":
    main()
