#!/usr/bin/env python3
"""Plants one fault after another in a small clean tree: layers.py must name exactly that fault."""

import tempfile
import unittest
from pathlib import Path
from unittest.mock import patch

from layers import ALLOWED, MAX_LINES, violations

CLEAN_TREE = {
    "run": "echo\n",
    "build/release/model/generated.cpp": '#include "cli/x.hpp"\n',
    "model/CMakeLists.txt": "add_library(hmlfc\n  bits/a.cpp\n  decoder/b.cpp)\n",
    "model/include/hmlfc/public.hpp": "#include <cstdint>\n",
    "model/bits/a.hpp": "#pragma once\n",
    "model/bits/a.cpp": '#include "bits/a.hpp"\n\n#include <hmlfc/public.hpp>\n',
    "model/decoder/b.cpp": '#include "bits/a.hpp"\n',
    "model/decoder/b.hpp": "#pragma once\n",
    "tests/CMakeLists.txt": "hmlfc_add_tests(bits SOURCES bits/a_test.cpp)\n",
    "tests/bits/a_test.cpp": '#include "bits/a.hpp"\n',
    "tests/fuzz/CMakeLists.txt": "hmlfc_add_fuzz(open.cpp\n)\n",
    "tests/fuzz/open.cpp": '#include "bits/a.hpp"\n',
    "examples/CMakeLists.txt": "add_executable(example example.cpp)\n",
    "examples/example.cpp": '#include <hmlfc/public.hpp>\n',
}


CHAIN = {
    "model/decoder/golden/x.hpp": '#include "decoder/b.hpp"\n#include "bits/a.hpp"\n',
    "model/decoder/b.hpp": '#include "decoder/c.hpp"\n',
    "model/decoder/c.hpp": '#include "decoder/b.hpp"\n#include "decoder/fast/y.hpp"\n',
    "model/decoder/fast/y.hpp": '#include "decoder/golden/x.hpp"\n',
}
PATH = '"${PROJECT_SOURCE_DIR}/%s/x.cpp"\n'

# Files added to the clean tree or replaced in it, and how the violations begin.
FAULTS = {
    "clean tree": ({}, []),
    "upward include": (
        {"model/bits/a.hpp": '#pragma once\n\n  #  include "decoder/b.hpp"\n'},
        ['model/bits/a.hpp:3: model/bits may not include model/decoder ("decoder/b.hpp")'],
    ),
    "public header includes a layer": (
        {"model/include/hmlfc/public.hpp": '#include "bits/a.hpp"\n'},
        ["model/include/hmlfc/public.hpp:1: model/include may not include model/bits"],
    ),
    "include of no file": (
        {"model/bits/a.hpp": '#include "hmlfc/nothing.hpp"\n'},
        ['model/bits/a.hpp:1: "hmlfc/nothing.hpp" is no file'],
    ),
    "public header by another name": (
        {"model/bits/a.hpp": '#include "include/hmlfc/public.hpp"\n'},
        ['model/bits/a.hpp:1: "include/hmlfc/public.hpp" is a public header'],
    ),
    "layer by another name": (
        {"model/bits/a.hpp": '#include "../decoder/b.hpp"\n'},
        ["model/bits/a.hpp:1: model/bits may not include model/decoder"],
    ),
    "from one top folder to another": (
        {"gpu_ref/x.hpp": '#include "../testbench/oracle/y.hpp"\n', "testbench/oracle/y.hpp": ""},
        ["gpu_ref/x.hpp:1: gpu_ref may not include testbench/oracle"],
    ),
    "inside a top folder": (
        {"testbench/oracle/x.hpp": '#include "unit/y.hpp"\n', "testbench/unit/y.hpp": ""},
        ["testbench/oracle/x.hpp:1: testbench/oracle may not include testbench/unit"],
    ),
    "golden includes fast": (
        {"model/decoder/golden/x.hpp": '#include "decoder/fast/y.hpp"\n', "model/decoder/fast/y.hpp": ""},
        ["model/decoder/golden/x.hpp:1: model/decoder/golden may not include model/decoder/fast"],
    ),
    "golden reaches fast": (
        CHAIN,
        ["model/decoder/golden/x.hpp:1: model/decoder/golden reaches model/decoder/fast: "
         "model/decoder/b.hpp -> model/decoder/c.hpp -> model/decoder/fast/y.hpp"],
    ),
    "golden reaches only shared files": ({**CHAIN, "model/decoder/c.hpp": '#include "decoder/b.hpp"\n'}, []),
    "CMake names a folder below": ({"tools/CMakeLists.txt": PATH % "model", "tests/x.cmake": PATH % "bench"}, []),
    "CMake names a folder on top": (
        {"tools/CMakeLists.txt": "\n" + PATH % "tests", "gpu_ref/x.cmake": PATH % "tools"},
        ["gpu_ref/x.cmake:1: gpu_ref may not use tools", "tools/CMakeLists.txt:2: tools may not use tests"],
    ),
    "unknown folder": (
        {"model/misc/x.hpp": "\n", "new_ref/x.hpp": "\n"},
        ["model/misc/x.hpp:1: model/misc is not a folder of the table",
         "new_ref/x.hpp:1: new_ref is not a folder of the table"],
    ),
    "longest file": ({"run": "\n" * MAX_LINES}, []),
    "long file": ({"run": "\n" * (MAX_LINES + 1)}, [f"run:{MAX_LINES + 1}: "]),
    "long script of .ci": ({".ci/x.sh": "\n" * 1000}, [f".ci/x.sh:{MAX_LINES + 1}: 1000 lines"]),
    "unlisted sources": (
        {"bench/d.cpp": "\n", "model/bits/c.cpp": "\n", "tests/bits/c_test.cpp": "\n"},
        ["bench/d.cpp:1: not listed in CMakeLists.txt",
         "model/bits/c.cpp:1: not listed in model/CMakeLists.txt",
         "tests/bits/c_test.cpp:1: not listed in tests/CMakeLists.txt"],
    ),
    "listed above the nearest list": (
        {"tests/fuzz/CMakeLists.txt": "", "tests/CMakeLists.txt": "bits/a_test.cpp fuzz/open.cpp"},
        ["tests/fuzz/open.cpp:1: not listed in tests/fuzz/CMakeLists.txt"],
    ),
}


class LayersTest(unittest.TestCase):
    def found_with(self, faults):
        """The violations of the clean tree with these files added or replaced."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**CLEAN_TREE, **faults}.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return violations(Path(folder))

    def assert_found(self, faults, expected_starts):
        found = self.found_with(faults)
        self.assertEqual(len(found), len(expected_starts), found)
        for violation, start in zip(found, expected_starts):
            self.assertTrue(violation.startswith(start), violation)

    def test_planted_faults(self):
        for name, (faults, expected_starts) in FAULTS.items():
            with self.subTest(name):
                self.assert_found(faults, expected_starts)

    def test_every_pair_of_folders(self):
        """Each folder may include what the table says."""
        targets = {f"{target}/y.hpp": "" for target in ALLOWED}
        includes = "".join(f'#include "{target}"\n' for target in targets)
        found = self.found_with({**targets, **{f"{folder}/x.hpp": includes for folder in ALLOWED}})
        for folder in ALLOWED:
            for line, target in enumerate(ALLOWED, 1):
                refused = any(v.startswith(f"{folder}/x.hpp:{line}: ") for v in found)
                allowed = folder == target or target in ALLOWED[folder]
                self.assertEqual(refused, not allowed, (folder, target))

    def test_cycle(self):
        for folder, target in (("model/syntax", "tools/io"), ("model/arithmetic", "model/decoder/fast")):
            with patch.dict(ALLOWED, {folder: {target}}):
                self.assert_found({}, [f"tests/lint/layers.py:1: ALLOWED: {folder} names {target}"])


if __name__ == "__main__":
    unittest.main()
