#!/usr/bin/env python3
"""pip_test.py PYTHON SOURCE WORK PROGRAM: `pip install .` with what Debian has, without a network.

In a virtual environment that sees Debian's packages: the package is that of the environment, has its types, and gives
the samples of PROGRAM; uninstalled, it is gone. The source tree gets no files.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

NEEDED = ("pip", "venv", "setuptools", "wheel", "numpy", "PIL")
SUM = "import sys, hmlfc; print(hmlfc.__file__, hmlfc.open(sys.argv[1])[1, 2].sum())"


def run(*command, code=0, **options):
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, **options)
    assert done.returncode == code, f"{command}: exit status {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def main():
    python, source, work, program = (Path(argument) for argument in sys.argv[1:])
    missing = [name for name in NEEDED if subprocess.run([python, "-c", f"import {name}"], capture_output=True).returncode]
    if missing:
        print("not installed:", *missing)
        return 77
    shutil.rmtree(work, ignore_errors=True)
    run(python, "-m", "venv", "--system-site-packages", work / "venv")
    inside = work / "venv/bin/python"
    # All that pip could fetch is out of reach.
    offline = {**os.environ, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "no_proxy": ""}
    run(inside, "-m", "pip", "install", "--no-build-isolation", ".", cwd=source, env=offline)
    left = [*source.glob("*.egg-info"), *source.glob("tools/**/*.egg-info"), *source.glob("tools/**/*.so")]
    assert not left, f"pip leaves files in the source: {left}"

    stream = source / "vectors/real/knights-extended.hmlfc"
    where, total = run(inside, "-c", SUM, stream, cwd=work).split()
    package = Path(where).parent
    assert package.is_relative_to(work / "venv"), where
    for name in ("py.typed", "_core.pyi"):
        assert (package / name).is_file(), f"{name} is not installed"
    version = run(program, "--version").split()[1]
    assert f"Version: {version}\n" in run(inside, "-m", "pip", "show", "hmlfc"), version
    run(program, "decode", stream, "--view", "1,2", "-o", work / "view")
    picture = "import sys, numpy; from PIL import Image; print(numpy.asarray(Image.open(sys.argv[1])).sum())"
    assert run(inside, "-c", picture, work / "view/01_02.png").strip() == total

    run(inside, "-m", "pip", "uninstall", "-y", "hmlfc")
    run(inside, "-c", "import hmlfc", code=1, cwd=work)
    return 0


if __name__ == "__main__":
    sys.exit(main())
