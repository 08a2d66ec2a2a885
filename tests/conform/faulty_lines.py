#!/usr/bin/env python3
"""A decoder with one planted fault, behind the line protocol or, with FILE, as a command line.

    faulty_lines.py FAULT [FILE -o FOLDER]

FAULT is a name of BLOCKS, planted in the naive decoder's answers for blocks, or of ANSWERS, a right
decoder that breaks the protocol. `none` is without a fault.
"""

import itertools
import os
import signal
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "examples"), str(ROOT / "tests" / "naive_decoder")]

import decode  # noqa: E402
import line_decoder  # noqa: E402
import motion  # noqa: E402
import tile_head  # noqa: E402
from block import BlockDecoder  # noqa: E402
from stream_error import StreamError, require  # noqa: E402

BLOCKS, ANSWERS = {}, {}
RIGHT = BlockDecoder.decode
RIGHT_HEAD = tile_head.TileHead.__init__
RIGHT_MOTION_TILE = motion.read_motion_tile


def blocks(fault):
    BLOCKS[fault.__name__] = fault
    return fault


def answers(fault):
    ANSWERS[fault.__name__] = fault
    return fault


def first_error(decoder, error):
    """The error of the decoder's first failing block."""
    decoder.failed = getattr(decoder, "failed", error)
    return decoder.failed


@blocks
def wrong_later_error(decoder, *place):
    """The blocks that fail after the first have another error."""
    try:
        return RIGHT(decoder, *place)
    except StreamError as error:
        if first_error(decoder, error) is error:
            decoder.place = place
        if decoder.place != place:
            raise StreamError("tile_overrun" if error.name != "tile_overrun" else "bad_mode") from error
        raise


@blocks
def error_spreads(decoder, *place):
    """A block that fails takes along the blocks that are asked for after it."""
    if hasattr(decoder, "failed"):
        raise decoder.failed
    try:
        return RIGHT(decoder, *place)
    except StreamError as error:
        raise first_error(decoder, error)


@blocks
def table_of_empty_tiles(decoder, *place):
    """An end table past TILE is an error of empty tiles too (IDX-6), in streams of one tile group."""
    if int.from_bytes(decoder.stream.group[8:14], "little") > len(decoder.stream.tile):
        raise StreamError("bad_group_record")
    return RIGHT(decoder, *place)


def read_head_with_vectors_cut(head, *arguments):
    """The end of the head is checked in records with a residual alone."""

    def require_with_residual(condition, which):
        require(condition or which == "tile_overrun" and not head.residual_mask, which)

    with mock.patch.object(tile_head, "require", require_with_residual):
        RIGHT_HEAD(head, *arguments)


@blocks
def end_of_vectors_unchecked(decoder, *place):
    """A record without a residual need not hold all its vectors (TIL-1)."""
    with mock.patch.object(tile_head.TileHead, "__init__", read_head_with_vectors_cut):
        return RIGHT(decoder, *place)


def read_motion_tile_with_choices(*place):
    """The choices of all palette entries that blocks of the tile use are checked."""
    tile = RIGHT_MOTION_TILE(*place)
    if tile is not None:
        _, _, indices, palette = tile
        require(all(palette[index].choice <= 11 for index in indices if index < len(palette)), "bad_mode")
    return tile


@blocks
def choices_of_others(decoder, *place):
    """A reserved choice is an error of all blocks of the motion tile (MOT-3)."""
    with mock.patch.object(motion, "read_motion_tile", read_motion_tile_with_choices):
        return RIGHT(decoder, *place)


@blocks
def later_errors_hidden(decoder, *place):
    """The blocks that fail after the first give zeros."""
    try:
        return RIGHT(decoder, *place)
    except StreamError as error:
        if first_error(decoder, error) is error:
            decoder.place = place
        if decoder.place == place:
            raise
        side = decoder.stream.geometry.block
        return [SimpleNamespace(sample=[[0] * side] * side)]


@blocks
def stop_level_ignored(decoder, *place):
    return RIGHT(decoder, *place[:5])


@blocks
def stop_level_beyond(decoder, *place):
    level = place[5] if len(place) == 6 else 0
    return RIGHT(decoder, *place[:5], min(level + 1, decoder.stream.geometry.top) if level else 0)


@blocks
def errors_below_stop_level(decoder, *place):
    """Levels below the stop level are decoded, too, and their errors reported."""
    RIGHT(decoder, *place[:5])
    return RIGHT(decoder, *place)


class Server(line_decoder.Server):
    opened = 0

    def open(self, *words):
        self.opened += 1
        return super().open(*words)


def write(text):
    sys.stdout.write(text)
    sys.stdout.flush()


@answers
class Other_version(Server):
    def hello(self, version):
        return "2 view block"


@answers
class No_abilities(Server):
    def hello(self, version):
        return "1 samples"


@answers
class Banner(Server):
    def hello(self, version):
        write("A simulator\r\n  loading design\n")
        return super().hello(version)


@answers
class Endless_banner(Server):
    def hello(self, version):
        while True:
            write("loading\n" * 1000)


@answers
class Endless_line(Server):
    def view(self, row, col):
        while True:
            write("0" * 65536)


@answers
class Ends_at_once(Server):
    def hello(self, version):
        sys.exit(0)


@answers
class Cannot_run(Server):
    def open(self, *words):
        print("no board", file=sys.stderr)
        sys.exit(77)


@answers
class Crashes(Server):
    def block(self, *place):
        os.kill(os.getpid(), signal.SIGSEGV)


@answers
class Hangs(Server):
    def view(self, row, col):
        time.sleep(1000)


@answers
class Ends_within_an_answer(Server):
    def view(self, row, col):
        write(super().view(row, col)[:7])
        sys.exit(3)


@answers
class Says_it_twice(Server):
    def close(self):
        return "\n9 ok"


@answers
class Wrong_number(Server):
    def view(self, row, col):
        write("1")
        return super().view(row, col)


@answers
class Garbage(Server):
    def block(self, *place):
        write("Segfault? \x07\n")
        return super().block(*place)


@answers
class Too_few_samples(Server):
    def block(self, *place):
        return super().block(*place)[:-4]


@answers
class Not_hexadecimal(Server):
    def block(self, *place):
        return "0x" + super().block(*place)[2:]


@answers
class Sample_too_wide(Server):
    def view(self, row, col):
        return "0100" + super().view(row, col)[4:]


@answers
class Other_shape(Server):
    def open(self, *words):
        return "1 " + super().open(*words)


@answers
class Decodes_at_open(Server):
    """Refuses at open what fails in a view."""

    def open(self, *words):
        shape = super().open(*words)
        rows, cols = map(int, shape.split()[:2])
        for place in itertools.product(range(rows), range(cols)):
            self.view(*place)
        return shape


@answers
class Crashes_once(Server):
    """In the second stream of a process."""

    def open(self, *words):
        if self.opened == 1:
            os.abort()
        return super().open(*words)


@answers
class Something_stays(Server):
    """The first sample of each stream but a process's first is wrong."""

    def view(self, row, col):
        right = super().view(row, col)
        return right if self.opened == 1 else ("0000" if right[:4] != "0000" else "0001") + right[4:]


def main():
    name, *command_line = sys.argv[1:]
    if name in BLOCKS:
        BlockDecoder.decode = BLOCKS[name]
    if command_line:
        return decode.main(command_line)
    line_decoder.serve(ANSWERS.get(name, Server)())
    return 0


if __name__ == "__main__":
    sys.exit(main())
