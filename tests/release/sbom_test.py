#!/usr/bin/env python3
"""sbom_test.py ROOT: the bill of materials names every package of .ci/packages.txt with its installed version."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "tools/release"))

import sbom  # noqa: E402


def main():
    packages = sbom.listed((ROOT / ".ci/packages.txt").read_text())
    assert len(packages) > 50 and all(purpose and "the same" not in purpose for _, _, purpose in packages), packages
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / name / "sbom.json" for name in "ab"]
        for file in files:
            subprocess.run([sys.executable, "-B", ROOT / "tools/release/sbom.py", ROOT, file], check=True)
        text = files[0].read_text()
        assert text == files[1].read_text()
    version = json.loads(text)["metadata"]["component"]["version"]
    assert f"\n  VERSION {version}\n" in (ROOT / "CMakeLists.txt").read_text(), version
    parts = {part["name"]: part for part in json.loads(text)["components"]}
    found = sbom.installed()
    assert set(parts) == {name for name, _, _ in packages} & set(found)
    policy = subprocess.run(["apt-cache", "policy", "libtbb-dev"], capture_output=True, text=True).stdout
    assert f"Installed: {parts['libtbb-dev']['version']}\n" in policy, policy
    assert parts["libtbb-dev"]["scope"] == "required" and parts["yosys"]["scope"] == "excluded"
    # A package that is not installed: by name, an error only where a build needs it.
    for groups, needed in ((["build"], True), (["test"], False)):
        _, missing = sbom.bill([*packages, ("nosuch", groups, "nothing")], found, "1")
        assert "nosuch" in missing[needed] and "nosuch" not in missing[not needed], missing


if __name__ == "__main__":
    main()
