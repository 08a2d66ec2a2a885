#!/usr/bin/env python3
"""check_gpu_tiles.py CMAKE BUILD_DIR COMPILER LIBDIR: the example gpu_tiles, built on the installed build.

Its picture is that of the installed `hmlfc decode`, at depth 8 and above. Exit: 77 no Vulkan device, or no component gpu.
"""

import struct
import subprocess
import sys

from check_install import ROOT, VECTORS, Installation

sys.path.insert(0, str(ROOT / "tests" / "cli"))

import pictures  # noqa: E402

SKIPPED = 77
NO_DEVICE = 3
VIEW = (1, 2)
STREAMS = {"real/knights-extended": 8, "stress/odd-prime-sides-depth12": 12}  # depths


def read_ppm(path):
    magic, size, most, body = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert magic == b"P6", magic
    return pictures.Picture(width, height, list(struct.unpack(f">{width * height * 3}{'H' if int(most) > 255 else 'B'}", body)))


def main():
    installation = Installation(*sys.argv[1:], work="gpu_consumer")
    if not installation.gpu_headers:
        print("the build has no component gpu")
        return SKIPPED
    folder = installation.build_examples("examples")
    row, col = VIEW
    for name, depth in STREAMS.items():
        stream, picture = VECTORS / f"{name}.hmlfc", folder / "view.ppm"
        done = subprocess.run([folder / "gpu_tiles", stream, str(row), str(col), picture], text=True, capture_output=True)
        if done.returncode == NO_DEVICE:
            print(done.stderr.strip())
            return SKIPPED
        assert done.returncode == 0, done.stderr
        installation.hmlfc("decode", stream, "--view", f"{row},{col}", "-o", folder / "decoded")
        ours = read_ppm(picture)
        if depth > 8:  # a PNG has 16 bits, the upper ones once more below
            ours.samples = [sample << 16 - depth | sample >> 2 * depth - 16 for sample in ours.samples]
        theirs = pictures.read_png(folder / "decoded" / f"{row:02}_{col:02}.png")
        assert len(set(theirs.samples)) > 16 and ours == theirs, f"{name}: other samples"
    return 0


if __name__ == "__main__":
    sys.exit(main())
