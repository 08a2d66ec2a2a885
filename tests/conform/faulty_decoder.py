#!/usr/bin/env python3
"""A decoder with one planted fault, which `hmlfc conform` must catch (faults_test.py).

    faulty_decoder.py FAULT FILE -o FOLDER

FAULT is a name of ARITHMETIC, CHECKS or CODESTREAM, planted in the naive decoder (tests/naive_decoder), or of
PROCESS, a right decoder that behaves wrongly as a program. `none` is without a fault.
"""

import os
import pathlib
import signal
import subprocess
import struct
import sys
import time
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "naive_decoder"))

import bise  # noqa: E402
import block  # noqa: E402
import colour  # noqa: E402
import decode  # noqa: E402
import light_field  # noqa: E402
import references  # noqa: E402
import residual  # noqa: E402
import faulty_index  # noqa: E402, F401  (adds to CHECKS)
import faulty_opening  # noqa: E402, F401  (likewise)
from faulty_checks import CHECKS  # noqa: E402
from faulty_jpeg2000 import CODESTREAM  # noqa: E402

ARITHMETIC, PROCESS = {}, {}


def arithmetic(fault):
    ARITHMETIC[fault.__name__] = fault
    return fault


def process(fault):
    PROCESS[fault.__name__] = fault
    return fault


@arithmetic
def wrong_rounding():
    """MOT-9 with halves rounded downwards."""

    def predict(interpolated):
        if len(interpolated) == 1:
            return (interpolated[0] + 31) >> 6
        return (interpolated[0] + interpolated[1] + 63) >> 7

    block.predict = predict


@arithmetic
def disparity_rounded_down():
    """MOT-8 without the half."""
    references.rshift = lambda x, k: x >> k


@arithmetic
def neighbours_exchanged():
    """MOT-7 with K1 and K2 in the order of the grid, whichever is nearer."""
    right = references.candidates
    references.candidates = lambda geometry, image: (lambda k: [k[0], *sorted(k[1:3]), k[3]])(right(geometry, image))


@arithmetic
def trit_digits_swapped():
    """BISE-8 with the last two trits of a group exchanged."""
    right = bise.trits
    bise.trits = lambda T: (lambda t: [*t[:3], t[4], t[3]])(right(T))


@arithmetic
def lowest_trit_code():
    """BISE-10 with a table of canonical codes alone: others give zeros."""
    right = bise.trits
    greatest = {tuple(right(T)): T for T in range(256)}
    bise.trits = lambda T: right(T) if greatest[tuple(right(T))] == T else [0] * 5


@arithmetic
def quint_digits_swapped():
    """BISE-9 with the last two quints of a group exchanged."""
    right = bise.quints
    bise.quints = lambda Q: (lambda q: [q[0], q[2], q[1]])(right(Q))


@arithmetic
def border_off_by_one():
    """DEC-4 that clamps one column too early."""
    right = block.BlockDecoder._ref

    def ref(self, image, plane, x, y):
        width = self.stream.geometry.plane_size(plane)[0]
        return right(self, image, plane, min(x, max(width - 2, 0)), y)

    block.BlockDecoder._ref = ref


@arithmetic
def sign_ignored():
    """DEC-3 without the sign of the motion."""
    right = block.BlockDecoder._entry

    def entry(self, image, plane, block_x, block_y):
        found = right(self, image, plane, block_x, block_y)
        found.sign = 1
        return found

    block.BlockDecoder._entry = entry


@arithmetic
def stale_cache():
    """A cache of tile records whose tag is the lane (IDX-3) without the group."""
    right = block.find_record
    kept = {}
    block.find_record = lambda stream, tile: kept.setdefault(tile % 64, right(stream, tile))


@arithmetic
def bias_ignored():
    """TIL-10 without the bias: the middle of the levels is always 0."""
    right = residual.Cursor.take_signed
    residual.Cursor.take_signed = lambda self, bits: right(self, bits) * 0


@arithmetic
def step_doubled():
    """STP-2 with steps of powers of two alone."""
    right = residual.step_of
    residual.step_of = lambda code: right(code) if code % 2 or code == 0 else 2 ** (code // 2)


@arithmetic
def chroma_shifted():
    """COL-3 with chroma taken from the sample to the right."""
    right = light_field.decode_plane

    def decode_plane(decoder, row, col, plane, level=0):
        rows = right(decoder, row, col, plane, level)
        return rows if plane == 0 else [[*samples[1:], samples[-1]] for samples in rows]

    light_field.decode_plane = decode_plane


@arithmetic
def colour_without_clamp():
    """COL-2 whose samples wrap around instead of being clamped."""
    light_field.to_rgb = lambda y, co, cg, depth: tuple(
        sample % 2**depth for sample in colour.to_rgb(y, co, cg, depth + 8)
    )


@arithmetic
def eight_bit_samples():
    """Samples cut to 8 bits in streams of more."""
    right = colour.to_rgb
    light_field.to_rgb = lambda y, co, cg, depth: tuple(s % 256 for s in right(y, co, cg, depth))


def golden(file, folder):
    """Decodes by the program that the environment names; its exit status."""
    command = [os.environ["HMLFC"], "decode", file, "-o", folder]
    return subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode


def naive(file, folder):
    """The same by the naive decoder, as views.raw."""
    return decode.main([file, "-o", folder])


def last_view(folder):
    return sorted(pathlib.Path(folder).iterdir())[-1]


@process
def missing_output(file, folder):
    status = golden(file, folder)
    last_view(folder).unlink()
    return status


@process
def no_output(file, folder):
    return 0


@process
def truncated_picture(file, folder):
    status = golden(file, folder)
    view = last_view(folder)
    view.write_bytes(view.read_bytes()[:-40])
    return status


@process
def short_raw(file, folder):
    (pathlib.Path(folder) / "views.raw").write_bytes(b"\0" * 17)
    return 0


@process
def big_endian_raw(file, folder):
    """Samples of more than 8 bits with the high byte first."""
    status = naive(file, folder)
    raw = pathlib.Path(folder) / "views.raw"
    data = raw.read_bytes()
    raw.write_bytes(struct.pack(f">{len(data) // 2}H", *struct.unpack(f"<{len(data) // 2}H", data)))
    return status


def rewrite_png(file, folder, value, significant):
    """The views of a decoder as PNG files with value(sample, depth), and sBIT where `significant`."""
    status = naive(file, folder)
    raw = pathlib.Path(folder) / "views.raw"
    fields, data = decode.Stream(pathlib.Path(file).read_bytes()).header, raw.read_bytes()
    raw.unlink()
    samples = struct.unpack(f"<{len(data) // 2}H", data)
    row, view = 3 * fields.width, 3 * fields.width * fields.height
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", fields.width, fields.height, 16, 2, 0, 0, 0))]
    chunks += [(b"sBIT", bytes([fields.depth] * 3))] if significant else []
    for number in range(len(samples) // view):
        words = [value(sample, fields.depth) for sample in samples[number * view : (number + 1) * view]]
        lines = b"".join(b"\0" + struct.pack(f">{row}H", *words[at : at + row]) for at in range(0, view, row))
        png = b"\x89PNG\r\n\x1a\n"
        for name, body in [*chunks, (b"IDAT", zlib.compress(lines)), (b"IEND", b"")]:
            png += struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        (pathlib.Path(folder) / f"{number // fields.cols:02}_{number % fields.cols:02}.png").write_bytes(png)
    return status


@process
def low_bits_of_png(file, folder):
    """Samples of more than 8 bits in the low bits of 16, not the high ones."""
    return rewrite_png(file, folder, lambda sample, depth: sample, True)


@process
def png_without_depth(file, folder):
    """PNG files of 16 bits without sBIT."""
    return rewrite_png(file, folder, lambda sample, depth: sample << (16 - depth), False)


@process
def high_bits_of_png(file, folder):
    """No fault: PNG files as they may be, with zeros in the low bits."""
    return rewrite_png(file, folder, lambda sample, depth: sample << (16 - depth), True)


@process
def wrong_exit_code(file, folder):
    golden(file, folder)
    return 1


@process
def crash(file, folder):
    golden(file, folder)
    os.kill(os.getpid(), signal.SIGSEGV)


@process
def hang(file, folder):
    golden(file, folder)
    time.sleep(1000)


@process
def hanging_child(file, folder):
    """Ends, but leaves behind a child that holds its output open."""
    subprocess.Popen(["sleep", "1000"])
    return golden(file, folder)


@process
def endless_messages(file, folder):
    while True:
        sys.stderr.write("still decoding\n" * 1000)


@process
def memory_hog(file, folder):
    hoard = bytearray(1 << 40)
    return len(hoard) * 0


@process
def accepts_everything(file, folder):
    golden(file, folder)
    return 0


def main():
    name, file, _, folder = sys.argv[1:]
    if name in PROCESS:
        return PROCESS[name](file, folder)
    if name != "none":
        (ARITHMETIC | CHECKS | CODESTREAM)[name]()
    return naive(file, folder)


if __name__ == "__main__":
    sys.exit(main())
