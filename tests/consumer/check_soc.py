#!/usr/bin/env python3
"""check_soc.py CMAKE BUILD_DIR [--antinous]: the example system of an installed decode unit decodes views.

Builds it; its pictures are those of the installed decoder; streams and requests that are wrong end with the driver's error.
--antinous: a view of the light field Antinous in both profiles, in the system that a run without it has built.
Exit status 77: Verilator or the light field is not there.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
STREAM = ROOT / "vectors" / "real" / "cards-main.hmlfc"
BAD_HEADER_CRC, BAD_REQUEST, LIMIT_EXCEEDED = 4, 25, 24


def must(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, **options)
    assert done.returncode == 0, f"{command}: exit status {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def same(picture, other):
    one, two = (np.asarray(Image.open(name)) for name in (picture, other))
    return one.shape == two.shape and one.max() > 0 and bool((one == two).all())


def soc(work, stream, row, col, name):
    arguments = [f"+stream={stream}", f"+row={row}", f"+col={col}", f"+out={work / name}"]
    return subprocess.run([work / "soc", *arguments], text=True, capture_output=True, cwd=work)


def check_view(work, stream, row, col):
    done = soc(work, stream, row, col, "view.ppm")
    assert done.returncode == 0 and " clocks" in done.stdout, done
    must(work / "prefix/bin/hmlfc", "decode", stream, "--view", f"{row},{col}", "-o", work)
    assert same(work / "view.ppm", work / f"{row:02}_{col:02}.png"), f"view {row},{col} of {stream.name} differs"
    print(f"{stream.name}, view {row},{col}: equal, {done.stdout.splitlines()[0]}")


def check_antinous(work):
    data = Path(os.environ.get("HMLFC_DATA_DIR") or ROOT.parent / "shared" / "data") / "hci-antinous-9x9-512x512"
    if not data.is_dir() or not (work / "soc").exists():
        print(f"SKIPPED: no folder {data} (HMLFC_DATA_DIR names where it is), or no system in {work}")
        sys.exit(77)
    for profile, quality in (("main", 60), ("extended", 40)):
        stream = work / f"antinous-{profile}.hmlfc"
        must(work / "prefix/bin/hmlfc", "encode", data, "--profile", profile, "--quality", quality, "-o", stream)
        check_view(work, stream, 3, 4)


def main():
    cmake, build, *option = sys.argv[1:]
    work = Path(build).resolve() / "soc"
    if option == ["--antinous"]:
        return check_antinous(work)
    if shutil.which("verilator") is None:
        sys.exit(77)
    shutil.rmtree(work, ignore_errors=True)
    must(cmake, "--install", build, "--prefix", work / "prefix")
    warnings = must("make", "-s", "-C", work / "prefix/share/hmlfc/rtl/example", f"BUILD={work}", "OPTIMISE=-O1")
    assert "arning" not in warnings, warnings

    for row, col in ((1, 2), (0, 0)):
        check_view(work, STREAM, row, col)
    assert not same(work / "view.ppm", work / "01_02.png"), "the comparison cannot fail"

    damaged = work / "damaged.hmlfc"
    damaged.write_bytes(STREAM.read_bytes()[:20] + b"?" + STREAM.read_bytes()[21:])
    deep = ROOT / "vectors/real/glass-depth10.hmlfc"
    for stream, row, code in ((damaged, 0, BAD_HEADER_CRC), (STREAM, 999, BAD_REQUEST), (deep, 0, LIMIT_EXCEEDED)):
        done = soc(work, stream, row, 0, "none.ppm")
        assert done.returncode != 0 and f": {code}\n" in done.stderr and not (work / "none.ppm").exists(), done


if __name__ == "__main__":
    main()
