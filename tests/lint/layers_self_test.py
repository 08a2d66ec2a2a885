#!/usr/bin/env python3
"""Plants one fault after another in a small clean tree: layers.py must name exactly that fault."""

import tempfile
import unittest
from pathlib import Path

from layers import ALLOWED, MAX_LINES, violations

CLEAN_TREE = {
    "run": "echo\n",
    "build/release/model/generated.cpp": '#include "cli/x.hpp"\n',
    "model/CMakeLists.txt": "add_library(hmlfc\n  bits/a.cpp\n  samples/b.cpp)\n",
    "model/include/hmlfc/public.hpp": "#include <cstdint>\n",
    "model/bits/a.hpp": "#pragma once\n",
    "model/bits/a.cpp": '#include "bits/a.hpp"\n\n#include <hmlfc/public.hpp>\n',
    "model/samples/b.cpp": '#include "bits/a.hpp"\n',
    "tests/CMakeLists.txt": "hmlfc_add_tests(bits SOURCES bits/a_test.cpp)\n",
    "tests/bits/a_test.cpp": '#include "bits/a.hpp"\n',
    "tests/fuzz/CMakeLists.txt": "hmlfc_add_fuzz(open.cpp\n)\n",
    "tests/fuzz/open.cpp": '#include "bits/a.hpp"\n',
    "tests/consumer/project/main.cpp": "int main() {}\n",
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

    def assert_found(self, faults, *expected_starts):
        found = self.found_with(faults)
        self.assertEqual(len(found), len(expected_starts), found)
        for violation, start in zip(found, expected_starts):
            self.assertTrue(violation.startswith(start), violation)

    def test_clean_tree(self):
        self.assert_found({})

    def test_upward_include(self):
        self.assert_found(
            {"model/bits/a.hpp": '#pragma once\n\n  #  include "samples/b.hpp"\n'},
            'model/bits/a.hpp:3: bits may not include samples ("samples/b.hpp")',
        )

    def test_inner_list(self):
        self.assert_found(
            {"tests/fuzz/CMakeLists.txt": "", "tests/CMakeLists.txt": "bits/a_test.cpp fuzz/open.cpp"},
            "tests/fuzz/open.cpp:1: not listed in tests/fuzz/CMakeLists.txt",
        )

    def test_every_pair_of_layers(self):
        codec = ("bits", "values", "fields", "samples", "encoder")
        below = {
            ("bits", "bits"),
            *(("values", layer) for layer in ("bits", "values")),
            *(("fields", layer) for layer in ("bits", "values", "fields")),
            *(("samples", layer) for layer in ("bits", "values", "fields", "samples")),
            *(("render", layer) for layer in ("bits", "values", "fields", "samples", "render")),
            *(("encoder", layer) for layer in codec),
            ("io", "io"),
            ("scenes", "io"),
            ("scenes", "scenes"),
            *(("vectors", layer) for layer in (*codec, "io", "scenes", "vectors")),
            *(("conform", layer) for layer in (*codec, "io", "vectors", "conform")),
        }
        layers = [layer for layer in ALLOWED if layer != "include"]
        for layer in layers:
            for target in layers:
                found = self.found_with({f"model/{layer}/x.hpp": f'#include "{target}/y.hpp"\n'})
                allowed = (layer == "cli" and target != "dut") or (layer, target) in below
                self.assertEqual(len(found), 0 if allowed else 1, (layer, target, found))

    def test_public_header_includes_a_layer(self):
        self.assert_found(
            {"model/include/hmlfc/public.hpp": '#include "bits/a.hpp"\n'},
            "model/include/hmlfc/public.hpp:1: include may not include bits",
        )

    def test_include_that_names_no_layer(self):
        for name in ("a.hpp", "../samples/b.hpp", "hmlfc/public.hpp", "include/hmlfc/public.hpp"):
            self.assert_found(
                {"model/bits/a.hpp": f'#include "{name}"\n'},
                f'model/bits/a.hpp:1: "{name}" does not name a layer',
            )

    def test_unknown_layer(self):
        self.assert_found(
            {"model/misc/x.hpp": "\n"}, "model/misc/x.hpp:1: model/misc is not a layer"
        )

    def test_long_file(self):
        self.assert_found({"run": "\n" * MAX_LINES})
        self.assert_found({"run": "\n" * (MAX_LINES + 1)}, f"run:{MAX_LINES + 1}: ")
        self.assert_found({".ci/x.sh": "\n" * 1000}, f".ci/x.sh:{MAX_LINES + 1}: 1000 lines")

    def test_unlisted_source(self):
        self.assert_found(
            {"model/bits/c.cpp": "\n", "tests/bits/c_test.cpp": "\n", "bench/d.cpp": "\n"},
            "model/bits/c.cpp:1: not listed in model/CMakeLists.txt",
            "tests/bits/c_test.cpp:1: not listed in tests/CMakeLists.txt",
            "bench/d.cpp:1: not listed in bench/CMakeLists.txt",
        )


if __name__ == "__main__":
    unittest.main()
