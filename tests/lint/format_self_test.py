#!/usr/bin/env python3
"""format_self_test.py CLANG_FORMAT STYLE_FILE: format.py must accept a clean file and name a fault."""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from format import SKIPPED, major_version


def check(program, style, text):
    """Runs format.py on a tree with one C++ file."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        shutil.copy(style, root / ".clang-format")
        (root / "model").mkdir()
        (root / "model" / "planted.cpp").write_text(text)
        command = [sys.executable, Path(__file__).with_name("format.py"), program, root]
        return subprocess.run(command, capture_output=True, text=True, check=False)


def main():
    program, style = sys.argv[1:]
    if major_version(program) != 14:
        return SKIPPED
    clean = check(program, style, "int main() { return 0; }\n")
    faulty = check(program, style, "int main()\n{\n    return 0; }\n")
    print(clean.stdout + clean.stderr + faulty.stdout + faulty.stderr)
    ok = clean.returncode == 0 and faulty.returncode == 1 and "planted.cpp:1:" in faulty.stderr
    absent = check("no-such-program", style, "int x;\n")
    return 0 if ok and absent.returncode == SKIPPED else 1


if __name__ == "__main__":
    sys.exit(main())
