#!/usr/bin/env python3
"""windows_test.py BUILD: the GPU decoder, compiled for 64-bit Windows by MinGW, as far as the syntax.

Nothing is linked or run (tests/portable runs the library). Headers of Debian's packages that hold for every system are
taken from /usr/include one by one.

Exit: 0 good, 1 not (each problem is printed), 77 no compiler.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77
COMPILER = "x86_64-w64-mingw32-g++-posix"
HEADERS = ("tl", "vulkan", "vk_video")
# Builds without Vulkan, the DUT, a module of POSIX's dlopen, and the module for browsers.
LEFT_OUT = {"gpu_ref/no_vulkan.cpp", "gpu_ref/dut/gpu_dut.cpp", "gpu_ref/wasm/stream_module.cpp"}


def sources():
    files = [file.relative_to(ROOT).as_posix() for file in sorted((ROOT / "gpu_ref").rglob("*.cpp"))]
    return [file for file in files if file not in LEFT_OUT]


def complaint(file, includes):
    """What the compiler says of `file`; empty if it compiles."""
    command = [COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-D_WIN32_WINNT=0x0A00", *includes, ROOT / file]
    return subprocess.run(command, capture_output=True, text=True).stderr


def main():
    build = Path(sys.argv[1])
    if shutil.which(COMPILER) is None:
        print(f"{COMPILER} is missing (Debian: g++-mingw-w64-x86-64-posix)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        for name in HEADERS:
            (Path(folder) / name).symlink_to(Path("/usr/include") / name)
        own = [f"-I{path}" for path in (ROOT / "model", ROOT / "model/include", ROOT / "gpu_ref", ROOT / "gpu_ref/include", build / "gpu_ref")]
        includes = [*own, "-isystem", folder]
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            said = dict(zip(sources(), pool.map(lambda file: complaint(file, includes), sources())))
    wrong = [text for text in said.values() if text]
    print("\n".join(wrong) or f"{len(said)} files compile")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
