#!/usr/bin/env python3
"""Packs the suite, unpacks it and runs it; packs it on another day as another user: the same bytes."""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))

from links import dead_links  # noqa: E402


def pack(root, folder):
    """Packs the suite of `root` into `folder`; the archive."""
    script = 'source "$1/run" && pack_vectors "$2"'
    subprocess.run(["bash", "-c", script, "bash", root, folder], check=True, stdout=subprocess.DEVNULL)
    (archive,) = folder.glob("*.tar.gz")
    return archive


def copy(root, target):
    """The sources of the archive with other times and modes."""
    target.mkdir()
    for name in ("run", "LICENSE", "tools/demo.sh", "tools/release.sh", "tests/evidence.sh"):
        (target / name).parent.mkdir(exist_ok=True)
        shutil.copyfile(root / name, target / name)
    shutil.copytree(root / "vectors", target / "vectors", copy_function=shutil.copyfile)
    for path in target.rglob("*"):
        os.utime(path, (1_000_000_000, 1_000_000_000))
        path.chmod(0o700 if path.is_dir() else 0o600)
    return target


def check(program, root, work):
    archive = pack(root, work / "one")
    version = json.loads((root / "vectors/manifest.json").read_text())["vectors_version"]
    assert archive.name == f"hmlfc-vectors-{version}.tar.gz", archive.name
    other = copy(root, work / "other")
    assert pack(other, work / "two").read_bytes() == archive.read_bytes(), "other bytes on another day"
    (other / "LICENSE").write_text("another")
    assert pack(other, work / "three").read_bytes() != archive.read_bytes(), "the licence is not in it"

    subprocess.run(["sha256sum", "--quiet", "-c", f"{archive.name}.sha256"], check=True, cwd=archive.parent)
    subprocess.run(["tar", "-xf", archive], check=True, cwd=work)
    suite = work / f"hmlfc-vectors-{version}"
    for name in ("README.md", "CHANGES.md", "LICENSE", "manifest.json", "manifest.schema.json"):
        assert (suite / name).is_file(), f"{name} is missing"
    for name in ("README.md", "CHANGES.md"):
        dead = list(dead_links(suite, name))
        assert not dead, f"links that the archive does not have: {dead}"
    assert f"## {version}" in (suite / "CHANGES.md").read_text(), "CHANGES.md does not have this version"
    subprocess.run([program, "vectors", "lint", "--suite", suite], check=True, stdout=subprocess.DEVNULL)
    command = [program, "conform", "--suite", suite, "--dut", suite / "duts/model.json", "--filter", "syntax/base-*"]
    done = subprocess.run([*command, "-o", work / "report"], check=False, stdout=subprocess.PIPE, text=True)
    assert done.returncode == 5 and " fail" not in done.stdout, done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="hmlfc")
    parser.add_argument("root", type=Path, help="the repository")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="hmlfc-pack-") as folder:
        check(arguments.program, arguments.root, Path(folder))


if __name__ == "__main__":
    main()
