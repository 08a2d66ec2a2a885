#!/usr/bin/env python3
"""A right decoder that speaks the line protocol, but for one method of its server.

    broken_lines.py NAME

NAME is one of BROKEN, or `none`.
"""

import itertools
import os
import signal
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "examples"), str(ROOT / "tests" / "naive_decoder")]

import line_decoder  # noqa: E402
from stream_error import StreamError  # noqa: E402

opened = 0  # streams of this process


class Server(line_decoder.Server):
    def open(self, *words):
        global opened
        opened += 1
        return super().open(*words)


def write(text):
    sys.stdout.write(text)
    sys.stdout.flush()


def forever(text):
    while True:
        write(text)


def decodes_at_open(right, *words):
    """Refuses at open what fails in a view."""
    server, shape = right.__self__, right(*words)
    for place in itertools.product(*(range(int(side)) for side in shape.split()[:2])):
        server.view(*place)
    return shape


def another_later_error(right, *place):
    """The blocks that fail after the first have another error."""
    stream = right.__self__.decoder
    try:
        return right(*place)
    except StreamError as error:
        stream.failed = getattr(stream, "failed", place)
        if stream.failed == place:
            raise
        raise StreamError("tile_overrun" if error.name != "tile_overrun" else "bad_mode") from error


def first_sample_stays(right, row, col):
    """The first sample of each stream but a process's first is wrong."""
    samples = right(row, col)
    return samples if opened == 1 else ("0000" if samples[:4] != "0000" else "0001") + samples[4:]


# The method, and what is called in its place: with the right method, then the words of the request.
BROKEN = {
    "other_version": ("hello", lambda right, version: "2 view block"),
    "no_abilities": ("hello", lambda right, version: "1 samples"),
    "banner": ("hello", lambda right, version: write("A simulator\r\n  loading design\n") or right(version)),
    "endless_banner": ("hello", lambda right, version: forever("loading\n" * 1000)),
    "endless_line": ("view", lambda right, *place: forever("0" * 65536)),
    "ends_at_once": ("hello", lambda right, version: sys.exit(0)),
    "cannot_run": ("open", lambda right, *words: print("no board", file=sys.stderr) or sys.exit(77)),
    "crashes": ("block", lambda right, *place: os.kill(os.getpid(), signal.SIGSEGV)),
    "hangs": ("view", lambda right, *place: time.sleep(1000)),
    "ends_within_an_answer": ("view", lambda right, *place: write(right(*place)[:7]) or sys.exit(3)),
    "says_it_twice": ("close", lambda right: "\n9 ok"),
    "wrong_number": ("view", lambda right, *place: write("1") or right(*place)),
    "garbage": ("block", lambda right, *place: write("Segfault? \x07\n") or right(*place)),
    "too_few_samples": ("block", lambda right, *place: right(*place)[:-4]),
    "not_hexadecimal": ("block", lambda right, *place: "0x" + right(*place)[2:]),
    "sample_too_wide": ("view", lambda right, *place: "0100" + right(*place)[4:]),
    "other_shape": ("open", lambda right, *words: "1 " + right(*words)),
    "decodes_at_open": ("open", decodes_at_open),
    "crashes_once": ("open", lambda right, *words: os.abort() if opened == 1 else right(*words)),
    "something_stays": ("view", first_sample_stays),
    "another_later_error": ("block", another_later_error),
    "stop_level_ignored": ("block", lambda right, *place: right(*place[:5])),
    "errors_below_stop_level": ("block", lambda right, *place: right(*place[:5], 0) and right(*place)),
}


def main():
    server = Server()
    if sys.argv[1] != "none":
        method, broken = BROKEN[sys.argv[1]]
        right = getattr(server, method)
        setattr(server, method, lambda *words: broken(right, *words))
    line_decoder.serve(server)


if __name__ == "__main__":
    main()
