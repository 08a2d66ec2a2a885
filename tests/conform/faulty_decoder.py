#!/usr/bin/env python3
"""A decoder with one fault, which `hmlfc conform` must report (faults_test.py).

    faulty_decoder.py FAULT FILE -o FOLDER

FAULT is a name of FAULTS.
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

import decode  # noqa: E402
import light_field  # noqa: E402
import opening  # noqa: E402
import stream_error  # noqa: E402

FAULTS = {}


def fault(decoder):
    """Names a decoder: a function of a file and a folder that returns an exit status."""
    FAULTS[decoder.__name__] = decoder
    return decoder


def golden(file, folder):
    """Decodes by the program that the environment names; its exit status."""
    command = [os.environ["HMLFC"], "decode", file, "-o", folder]
    return subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode


def naive(file, folder):
    """The same by the naive decoder, as views.raw."""
    return decode.main([file, "-o", folder])


def last_view(folder):
    return sorted(pathlib.Path(folder).iterdir())[-1]


@fault
def chroma_shifted(file, folder):
    """COL-3 with chroma taken from the sample to the right."""
    right = light_field.decode_plane

    def decode_plane(decoder, row, col, plane, level=0):
        rows = right(decoder, row, col, plane, level)
        return rows if plane == 0 else [[*samples[1:], samples[-1]] for samples in rows]

    light_field.decode_plane = decode_plane
    return naive(file, folder)


@fault
def sections_unchecked(file, folder):
    """FIL-6: the crc of sections is ignored."""

    def require_others(condition, error):
        if error != "bad_section_crc":
            stream_error.require(condition, error)

    opening.require = require_others
    return naive(file, folder)


@fault
def missing_output(file, folder):
    status = golden(file, folder)
    last_view(folder).unlink()
    return status


@fault
def no_output(file, folder):
    return 0


@fault
def truncated_picture(file, folder):
    status = golden(file, folder)
    view = last_view(folder)
    view.write_bytes(view.read_bytes()[:-40])
    return status


@fault
def short_raw(file, folder):
    (pathlib.Path(folder) / "views.raw").write_bytes(b"\0" * 17)
    return 0


@fault
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


@fault
def low_bits_of_png(file, folder):
    """Samples of more than 8 bits in the low bits of 16, not the high ones."""
    return rewrite_png(file, folder, lambda sample, depth: sample, True)


@fault
def png_without_depth(file, folder):
    """PNG files of 16 bits without sBIT."""
    return rewrite_png(file, folder, lambda sample, depth: sample << (16 - depth), False)


@fault
def high_bits_of_png(file, folder):
    """No fault: PNG files as they may be, with zeros in the low bits."""
    return rewrite_png(file, folder, lambda sample, depth: sample << (16 - depth), True)


@fault
def wrong_exit_code(file, folder):
    golden(file, folder)
    return 1


@fault
def crash(file, folder):
    golden(file, folder)
    os.kill(os.getpid(), signal.SIGSEGV)


@fault
def hang(file, folder):
    golden(file, folder)
    time.sleep(1000)


@fault
def hanging_child(file, folder):
    """Ends, but leaves behind a child that holds its output open."""
    subprocess.Popen(["sleep", "1000"])
    return golden(file, folder)


@fault
def endless_messages(file, folder):
    while True:
        sys.stderr.write("still decoding\n" * 1000)


@fault
def memory_hog(file, folder):
    hoard = bytearray(1 << 40)
    return len(hoard) * 0


@fault
def accepts_everything(file, folder):
    golden(file, folder)
    return 0


def main():
    name, file, _, folder = sys.argv[1:]
    return FAULTS[name](file, folder)


if __name__ == "__main__":
    sys.exit(main())
