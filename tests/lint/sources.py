"""Which files of the repository the lint tests look at."""

from pathlib import Path

CPP_SUFFIXES = {".cpp", ".hpp", ".h"}
SCRIPT_SUFFIXES = {".py", ".sh", ".cmake", ".js", ".css"}
SCRIPT_NAMES = {"run", "CMakeLists.txt"}
GENERATED = {"build", "out", "__pycache__"}


def repository_files(root):
    """Every file below root, sorted, without build products and hidden folders; .ci counts."""
    for path in sorted(root.iterdir()):
        if path.is_dir():
            hidden = path.name.startswith(".") and path.name != ".ci"
            if not hidden and path.name not in GENERATED and not path.is_symlink():
                yield from repository_files(path)
        else:
            yield path


def cpp_files(root: Path):
    return [path for path in repository_files(root) if path.suffix in CPP_SUFFIXES]


def source_files(root: Path):
    return [
        path
        for path in repository_files(root)
        if path.suffix in CPP_SUFFIXES | SCRIPT_SUFFIXES or path.name in SCRIPT_NAMES
    ]
