#!/usr/bin/env python3
"""check_gpu_examples.py CMAKE BUILD_DIR COMPILER LIBDIR: the examples gpu_tiles and gpu_frames, built on the installed build.

At depth 8 and above, the picture of gpu_tiles is that of the installed `hmlfc decode`, and the frames of gpu_frames are those that the example
render_frame draws on the CPU. Exit: 77 no Vulkan device, or no component gpu.
"""

import json
import struct
import subprocess
import sys

from check_install import ROOT, VECTORS, Installation, run

sys.path.insert(0, str(ROOT / "tests" / "cli"))

import pictures  # noqa: E402

SKIPPED = 77
NO_DEVICE = 3
VIEW = (1, 2)
FRAMES = 7
STREAMS = {"real/knights-extended": 8, "stress/odd-prime-sides-depth12": 12}  # depths


def read_ppm(path):
    magic, size, most, body = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert magic == b"P6", magic
    return pictures.Picture(width, height, list(struct.unpack(f">{width * height * 3}{'H' if int(most) > 255 else 'B'}", body)))


class NoDevice(Exception):
    """This machine has no Vulkan device."""


def run_on_gpu(*command):
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True)
    if done.returncode == NO_DEVICE:
        raise NoDevice(done.stderr.strip())
    assert done.returncode == 0, done.stderr


def check_tiles(installation, folder, name, depth):
    stream, picture = VECTORS / f"{name}.hmlfc", folder / "view.ppm"
    row, col = VIEW
    run_on_gpu(folder / "gpu_tiles", stream, row, col, picture)
    installation.hmlfc("decode", stream, "--view", f"{row},{col}", "-o", folder / "decoded")
    ours = read_ppm(picture)
    if depth > 8:  # a PNG has 16 bits, the upper ones once more below
        ours.samples = [sample << 16 - depth | sample >> 2 * depth - 16 for sample in ours.samples]
    theirs = pictures.read_png(folder / "decoded" / f"{row:02}_{col:02}.png")
    assert len(set(theirs.samples)) > 16 and ours == theirs, f"{name}: other samples"


def check_frames(installation, folder, name):
    stream, drawn = VECTORS / f"{name}.hmlfc", folder / "frame.ppm"
    run_on_gpu(folder / "gpu_frames", stream, FRAMES, folder)
    facts = json.loads(installation.hmlfc("info", stream, "--json"))
    last_col, last_row = facts["cols"] - 1, facts["rows"] - 1
    different = set()
    for i in range(FRAMES):
        part = i / (FRAMES - 1)
        run(folder / "render_frame", stream, part * last_col, part * last_row, drawn)
        different.add(drawn.read_bytes())
        assert read_ppm(folder / f"{i}.ppm") == read_ppm(drawn), f"{name}: another frame {i}"
    assert len(different) == FRAMES


def main():
    installation = Installation(*sys.argv[1:], work="gpu_consumer")
    if not installation.gpu_headers:
        print("the build has no component gpu")
        return SKIPPED
    # Without NDEBUG, under which classes of Vulkan-Hpp have another layout in a program than in the library.
    folder = installation.build_examples("examples", "-DCMAKE_BUILD_TYPE=Debug")
    try:
        for name, depth in STREAMS.items():
            check_tiles(installation, folder, name, depth)
            check_frames(installation, folder, name)
    except NoDevice as problem:
        print(problem)
        return SKIPPED
    return 0


if __name__ == "__main__":
    sys.exit(main())
