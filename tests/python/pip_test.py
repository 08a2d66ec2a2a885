#!/usr/bin/env python3
"""pip_test.py PYTHON SOURCE WORK PROGRAM: the wheel of a release, made with what Debian has, without a network.

It is for any Python from 3.11 on and any Linux. Installed in a virtual environment that sees Debian's packages it has
its types and passes the tests of the package against PROGRAM; uninstalled, it is gone. The source tree gets no files.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

NEEDED = ("pip", "venv", "setuptools", "wheel", "numpy", "PIL")


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
    offline = {**os.environ, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "no_proxy": "", "HMLFC_STATIC": "ON"}
    run(inside, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "-w", work, ".", cwd=source, env=offline)
    left = [*source.glob("*.egg-info"), *source.glob("tools/**/*.egg-info"), *source.glob("tools/**/*.so")]
    assert not left, f"pip leaves files in the source: {left}"
    (wheel,) = work.glob("*.whl")
    version = run(program, "--version").split()[1]
    assert re.fullmatch(rf"hmlfc-{version}-cp311-abi3-manylinux_2_\d+_\w+\.whl", wheel.name), wheel

    run(inside, "-m", "pip", "install", "--no-deps", wheel, env=offline)
    package = Path(run(inside, "-c", "import hmlfc; print(hmlfc.__file__)", cwd=work).strip()).parent
    assert package.is_relative_to(work / "venv"), package
    for name in ("py.typed", "_core.pyi"):
        assert (package / name).is_file(), f"{name} is not installed"
    for test in ("light_field", "encoding"):
        run(inside, "-B", Path(__file__).with_name(f"{test}_test.py"), program, package.parent)

    run(inside, "-m", "pip", "uninstall", "-y", "hmlfc")
    run(inside, "-c", "import hmlfc", code=1, cwd=work)
    return 0


if __name__ == "__main__":
    sys.exit(main())
