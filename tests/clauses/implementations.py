"""The four implementations: where each of them cites clauses, and which vectors it takes."""

import json
import re
import subprocess
import tempfile

from specification import cited_clauses

# For each implementation, named as its declaration in vectors/duts: the folders that decode, and what is
# below them that does not. A folder in both lists is cited where no other file is.
FOLDERS = {
    "model": (
        ["model/bits", "model/arithmetic", "model/syntax", "model/decoder", "model/render", "model/include"],
        [],
    ),
    "naive": (["tests/naive_decoder"], ["tests/naive_decoder/tests"]),
    "rtl": (["rtl", "rtl/driver"], ["rtl/driver", "rtl/formal", "rtl/synth"]),
    "gpu": (["gpu_ref"], ["gpu_ref/dut"]),
}
RENDERERS = ["model", "naive", "gpu"]
SUFFIXES = {".c", ".cpp", ".hpp", ".h", ".py", ".sv", ".svh", ".glsl", ".comp"}


def citations(root, name):
    """{clause: files that cite it}; first the file that names it most often, of several the one that
    cites the fewest clauses."""
    folders, left_out = FOLDERS[name]
    left_out = left_out + (not_decoding(root) if name == "model" else [])
    ranked = {}
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            skip = any(path.is_relative_to(root / part) for part in left_out if part != folder)
            if path.suffix not in SUFFIXES or skip:
                continue
            text, file = citing_text(path), path.relative_to(root).as_posix()
            cited = cited_clauses(text)
            for clause in cited:
                times = len(re.findall(rf"\b{clause}\b", text))
                ranked.setdefault(clause, []).append((folder in left_out, -times, len(cited), file))
    return {clause: [entry[-1] for entry in sorted(rank)] for clause, rank in ranked.items()}


def not_decoding(root):
    """Files in the model's folders that are no part of decoding."""
    entries = json.loads((root / "tests/decode_path/not_decoding.json").read_text())
    return [f"model/{entry['file']}" for entry in entries if "begins" not in entry]


def citing_text(path):
    """Returns the text that may cite: of Verilog only the comments, since a range such as [BITS-1:0] is no clause."""
    text = path.read_text()
    return "\n".join(re.findall(r"//.*", text)) if path.suffix in {".sv", ".svh"} else text


# The declaration of each renderer, where that is not the one of the decoder.
RENDERER_DUTS = {"model": "model-library"}


def claimed_vectors(program, root, frames=False):
    """{implementation: ids of the vectors, or frames, that its declaration does not exclude}, as the runner selects."""
    names = {RENDERER_DUTS.get(name, name): name for name in RENDERERS} if frames else {name: name for name in FOLDERS}
    with tempfile.TemporaryDirectory(prefix="hmlfc-clauses-") as folder:
        command = [program, "conform", "--suite", root / "vectors", "--shard", "1000000/1000000", "--json", "-o", folder]
        command += ["--frames"] if frames else []
        for dut in names:
            command += ["--dut", root / f"vectors/duts/{dut}.json"]
        result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    return {
        names[run["dut"]]: {vector["id"] for vector in run["results"] if vector["status"] == "skipped"}
        for run in json.loads(result.stdout)["runs"]
    }
