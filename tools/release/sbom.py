#!/usr/bin/env python3
"""sbom.py ROOT FILE: the Debian packages of .ci/packages.txt as a bill of materials (CycloneDX 1.4, JSON).

Each has its installed version, what it is for, and the groups that need it; those of group build are linked, and of
scope required. The same bytes wherever the same versions are installed. Exit status 1 where a package of group build
is not installed; others are left out, by name on standard error.
"""

import json
import platform
import re
import subprocess
import sys
from pathlib import Path

DISTRO = "{ID}-{VERSION_ID}".format_map(platform.freedesktop_os_release())
LINE = re.compile(r"(?P<name>\S+)\s+(?P<groups>\S+)\s+(?P<purpose>.+)")


def listed(text):
    """(name, groups, purpose) of each name in packages.txt, of any release; "the same" repeats the purpose above it."""
    packages = []
    for line in text.splitlines():
        match = LINE.fullmatch(line)
        if line.startswith("#") or not match:
            continue
        purpose = match["purpose"].strip()
        if purpose.startswith("the same"):
            purpose = packages[-1][2] + purpose.removeprefix("the same")
        packages += [(name, match["groups"].split(","), purpose) for name in match["name"].split("|") if name != "-"]
    return packages


def installed():
    """Version and architecture by name of package."""
    form = "${db:Status-Status} ${Package} ${Version} ${Architecture}\n"
    lines = subprocess.run(["dpkg-query", "-W", "-f", form], check=True, capture_output=True, text=True).stdout
    return {name: (version, machine) for status, name, version, machine in map(str.split, lines.splitlines())
            if status == "installed"}  # fmt: skip


def component(name, groups, purpose, version, machine):
    return {
        "type": "library" if name.startswith("lib") else "application",
        "bom-ref": name,
        "name": name,
        "version": version,
        "description": purpose,
        "scope": "required" if "build" in groups else "excluded",
        "purl": f"pkg:deb/debian/{name}@{version.replace(':', '%3A').replace('+', '%2B')}?arch={machine}&distro={DISTRO}",
        "properties": [{"name": "hmlfc:groups", "value": ",".join(groups)}],
    }


def bill(packages, found, version):
    """The document, and the names of packages that are not installed, by whether group build needs them."""
    missing = {needed: [name for name, groups, _ in packages if name not in found and ("build" in groups) == needed]
               for needed in (True, False)}  # fmt: skip
    components = [component(name, groups, purpose, *found[name]) for name, groups, purpose in packages if name in found]
    subject = {"type": "library", "bom-ref": "hmlfc", "name": "hmlfc", "version": version}
    needed = [part["bom-ref"] for part in components if part["scope"] == "required"]
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.4",
        "version": 1,
        "metadata": {"component": subject},
        "components": components,
        "dependencies": [{"ref": "hmlfc", "dependsOn": needed}],
    }
    return document, missing


def main():
    root, file = map(Path, sys.argv[1:])
    version = re.search(r'HMLFC_VERSION "([^"]*)"', (root / "model/include/hmlfc/version.hpp").read_text())[1]
    document, missing = bill(listed((root / ".ci/packages.txt").read_text()), installed(), version)
    if missing[False]:
        print("not installed, left out:", *missing[False], file=sys.stderr)
    if missing[True]:
        print("not installed, but a build needs it:", *missing[True], file=sys.stderr)
        return 1
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(document, indent=1) + "\n")
    print(file)
    return 0


if __name__ == "__main__":
    sys.exit(main())
