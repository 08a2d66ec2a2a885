#!/usr/bin/env python3
"""site_pages.py ROOT FOLDER: the documents as HTML pages, with the reference of the library that Doxygen makes, in FOLDER.

Pages lie where the documents lie in the repository, links between documents lead from page to page, and other files that
a document links to are copied. Exit status 1 where a link leads nowhere.
"""

import html
import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import markdown

DOCUMENTS = ("*.md", "docs/**/*.md", "vectors/*.md", "tests/fuzz/*.md")
REFERENCE = "api/html/index.html"
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body {{ max-width: 60rem; margin: auto; padding: 1rem; font: 1rem/1.5 sans-serif }}
img {{ max-width: 100% }} pre {{ overflow: auto; background: #f4f4f4; padding: .5rem }}
table {{ border-collapse: collapse; display: block; overflow: auto }} td, th {{ border: 1px solid #ccc; padding: .2rem .5rem }}
</style></head><body>
<nav><a href="{up}README.html">HMLFC</a> · <a href="{up}docs/README.html">Documents</a> ·
<a href="{up}{reference}">Reference of the library</a></nav>
{body}
</body></html>
"""


def slug(text, separator):
    """The anchor that a forge gives to a heading."""
    return re.sub(r"[^\w\- ]", "", html.unescape(text).lower()).replace(" ", separator)


def documents(root):
    return sorted({file.relative_to(root) for pattern in DOCUMENTS for file in root.glob(pattern)})


def page(text, name):
    """The HTML of document `name`."""
    extensions = ["tables", "fenced_code", "toc", "sane_lists"]
    body = markdown.markdown(text, extensions=extensions, extension_configs={"toc": {"slugify": slug}})
    body = re.sub(r'(href="(?![a-z]+:)[^"#]*)\.md(?=["#])', r"\1.html", body)
    heading = re.search(r"^# (.*)$", text, re.M)
    up = "../" * (len(name.parts) - 1)
    return PAGE.format(title=html.escape(heading[1] if heading else name.name), body=body, up=up, reference=REFERENCE)


class Links(HTMLParser):
    """The local links of a page, and its anchors."""

    def __init__(self, file):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value and not re.match(r"[a-z]+:|//", value):
                self.links.append(unquote(value))
            elif name in ("id", "name"):
                self.anchors.add(value)


def copy_linked(root, site, name):
    """Copies what the page of document `name` links to and is no page; of a folder, a list of its files."""
    for link in Links(site / name).links:
        path = Path(os.path.normpath(name.parent / link.partition("#")[0]))
        source, target = root / path, site / path
        if target.exists() or not source.resolve().is_relative_to(root):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_file():
            shutil.copy(source, target)
        elif source.is_dir():
            target.mkdir()
    for link in Links(site / name).links:
        path = Path(os.path.normpath(name.parent / link.partition("#")[0]))
        if (site / path).is_dir() and not (site / path / "index.html").exists():
            items = "".join(f"<li>{html.escape(file.name)}</li>" for file in sorted((root / path).iterdir()))
            up = "../" * len(path.parts)
            body = f"<h1>{path}/</h1><ul>{items}</ul>"
            text = PAGE.format(title=path, body=body, up=up, reference=REFERENCE)
            (site / path / "index.html").write_text(text, encoding="utf-8")


def dead_links(site):
    """A complaint for each link of a page that leads nowhere."""
    pages = {file: Links(file) for file in sorted(site.rglob("*.html"))}
    for file, found in pages.items():
        for link in found.links:
            path, _, anchor = link.partition("#")
            target = Path(os.path.normpath(file.parent / path)) if path else file
            if not target.exists():
                yield f"{file.relative_to(site)}: no file {link}"
            elif anchor and target in pages and anchor not in pages[target].anchors:
                yield f"{file.relative_to(site)}: no heading {link}"


def write_pages(root, site):
    names = documents(root)
    for name in names:
        target = (site / name).with_suffix(".html")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(page((root / name).read_text(encoding="utf-8"), name), encoding="utf-8")
    for name in names:
        copy_linked(root, site, name.with_suffix(".html"))
    shutil.copy(site / "README.html", site / "index.html")


def make_site(root, site):
    shutil.rmtree(site, ignore_errors=True)
    (site / "api").mkdir(parents=True)
    environment = {**os.environ, "HMLFC_DOCS_OUTPUT": str(site / "api")}
    subprocess.run(["doxygen", "docs/Doxyfile"], cwd=root, env=environment, check=True)
    write_pages(root, site)


def main():
    root, site = (Path(argument).resolve() for argument in sys.argv[1:])
    if site.exists() and any(site.iterdir()) and not (site / REFERENCE).exists():
        print(f"{site}: holds something else than a site; give an empty folder", file=sys.stderr)
        return 2
    make_site(root, site)
    found = list(dead_links(site))
    print("\n".join(found) if found else site / "index.html")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
