#!/usr/bin/env python3
"""site_test.py ROOT WORK: ./run docs makes a site without a dead link, and sees planted ones."""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT, WORK = map(Path, sys.argv[1:])
PLANTED = """# Title, with `code`

[here](#title-with-code) [there](docs/other.md#a-heading) [file](tools/x.cpp) [folder](tools)
![picture](docs/p.png) `[no](link.md)`

| [table](docs/other.md) |
|---|

[1](nowhere.md) [2](docs/other.md#no-heading) [3](#nothing) ![4](none.png)
"""


def planted(site):
    """The complaints about a small tree with four dead links."""
    with tempfile.TemporaryDirectory() as folder:
        root, out = Path(folder).resolve() / "root", Path(folder).resolve() / "out"
        for name, text in {"README.md": PLANTED, "docs/other.md": "# A heading\n", "docs/README.md": "[up](../README.md)",
                           "tools/x.cpp": "int x;\n", "docs/p.png": ""}.items():  # fmt: skip
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        (out / site.REFERENCE).parent.mkdir(parents=True)
        (out / site.REFERENCE).write_text("")
        site.write_pages(root, out)
        return [line for line in site.dead_links(out) if line.startswith("README.html")]


def main():
    try:
        sys.path.insert(0, str(ROOT / "tools/release"))
        import site_pages as site
    except ImportError:
        print("python3-markdown is not installed")
        return 77
    if not shutil.which("doxygen"):
        print("doxygen is not installed")
        return 77
    found = [line.split(": ")[1] for line in planted(site)]
    wanted = ["no file nowhere.html", "no heading docs/other.html#no-heading", "no heading #nothing", "no file none.png"]
    assert found == wanted, found
    command = [sys.executable, "-B", ROOT / "tools/release/site_pages.py", ROOT]
    subprocess.run([*command, WORK], check=True)
    for name in ("index.html", "docs/api.html", "docs/images/moving.webp", site.REFERENCE):
        assert (WORK / name).is_file(), name
    assert "hmlfc_decode_view" in (WORK / "api/html/hmlfc_8h.html").read_text(), "the C interface is not in the reference"
    # A folder with something else in it is left alone.
    refused = subprocess.run([*command, ROOT / "docs"], capture_output=True, text=True)
    assert refused.returncode == 2 and (ROOT / "docs/api.md").is_file(), refused
    return 0


if __name__ == "__main__":
    sys.exit(main())
