"""The links of a Markdown document, and the paths of the repository that it names as code."""

import re

LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(r"`((?:model|tools|rtl|gpu_ref|testbench|tests|bench|vectors|examples|docs)/[\w./-]*)`")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
FENCED = re.compile(r"^\s*```.*?^\s*```$", re.MULTILINE | re.DOTALL)


def anchors(text):
    """The anchors that a forge gives to the headings of a document."""
    heads = HEADING.findall(FENCED.sub("", text))
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def dead_links(root, name):
    """A complaint for each link of document `name` that leads nowhere."""
    text = (root / name).read_text(encoding="utf-8")
    for target in LINK.findall(FENCED.sub("", text)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (root / name).parent / path if path else root / name
        if not file.exists():
            yield f"{name}: no file {target}"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file.read_text(encoding="utf-8")):
            yield f"{name}: no heading {target}"


def dead(root, name):
    """A complaint for each link of document `name`, and each path in it, that leads nowhere."""
    yield from dead_links(root, name)
    text = (root / name).read_text(encoding="utf-8")
    for path in PATH.findall(text):
        # A name in capitals stands for others; a program has no suffix, its source has one.
        if not re.search(r"[A-Z]{2}", path.rpartition("/")[2]) and not any(root.glob(path + "*")):
            yield f"{name}: no file {path}"
