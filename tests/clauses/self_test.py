#!/usr/bin/env python3
"""Plants faults in a small tree of two clauses: the table must name each."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/spec"), str(ROOT / "bench/common")]

import clause_table  # noqa: E402  (its modules are found only now)
import implementations  # noqa: E402
from clause_cells import REASONS, ClauseCells  # noqa: E402
from specification import RENDERING, SPECIFICATION  # noqa: E402

# DEC-1 is everybody's; COL-1 is the model's alone, and has no vector.
TREE = {
    SPECIFICATION: "**[DEC-1]** First.\n\n**[COL-1]** Second.\n",
    RENDERING: "**[RAY-1]** A ray.\n",
    "model/decoder/block.cpp": "// DEC-1, COL-1\n",
    "model/include/hmlfc/decoder.hpp": "/// DEC-1, and DEC-1 again\n",
    "tests/decode_path/not_decoding.json": "[]",
    "tests/naive_decoder/block.py": '"""DEC-1."""\n',
    "rtl/hmlfc_unit.sv": "// DEC-1\nlogic [BITS-1:0] x;\n",
    "gpu_ref/shaders/block.glsl": "// DEC-1, RAY-1\n",
}
REASON = {"columns": ["vectors", "naive", "rtl", "gpu"], "clauses": ["COL-1"], "reason": "for encoders"}
FIRST = {"id": "syntax/first", "clauses": ["DEC-1"], "input": {"bytes": 9}}
SECOND = {"id": "syntax/second", "clauses": ["DEC-1"], "input": {"bytes": 8}}


class ClauseTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hmlfc-clauses-")
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name, text in TREE.items():
            self.write(name, text)
        self.reasons = [dict(REASON)]
        self.vectors = [dict(FIRST), dict(SECOND)]
        self.taken = {name: {"syntax/first", "syntax/second"} for name in implementations.FOLDERS}

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def cells(self):
        self.write(REASONS, json.dumps(self.reasons))
        return ClauseCells(self.root, {"vectors": self.vectors}, self.taken)

    def assert_found(self, *expected):
        found = list(self.cells().complaints())
        self.assertEqual(len(found), len(expected), found)
        for complaint, words in zip(found, expected):
            self.assertIn(words, complaint)


class Complaints(ClauseTest):
    def test_as_it_is(self):
        self.assert_found()

    def test_one_file_of_the_model_suffices(self):
        self.write("model/include/hmlfc/decoder.hpp", "")
        self.assert_found()
        self.write("model/decoder/block.cpp", "// COL-1")
        self.assert_found("DEC-1, model: no file cites it")

    def test_what_is_no_part_of_the_decoder_does_not_count(self):
        for column, name, other in (
            ("naive", "tests/naive_decoder/block.py", "tests/naive_decoder/tests/block_test.py"),
            ("rtl", "rtl/hmlfc_unit.sv", "rtl/formal/unit.sv"),
            ("gpu", "gpu_ref/shaders/block.glsl", "gpu_ref/dut/block.cpp"),
        ):
            with self.subTest(column):
                self.write(name, "")
                self.write(other, "// DEC-1")
                self.assert_found(f"DEC-1, {column}: no file cites it")
                self.write(name, TREE[name])
        self.write("tests/decode_path/not_decoding.json", '[{"file": "decoder/block.cpp", "reason": "x"}]')
        self.assert_found("COL-1, model: no file cites it")

    def test_new_clause(self):
        self.write(SPECIFICATION, TREE[SPECIFICATION] + "\n**[DEC-2]** Third.\n")
        lacks = [f"DEC-2, {name}: no file cites it" for name in implementations.FOLDERS]
        self.assert_found("DEC-2, vectors: no vector exercises it", *lacks)

    def test_clause_without_vector(self):
        self.vectors = []
        self.assert_found("DEC-1, vectors: no vector exercises it")

    def test_implementation_that_takes_no_vector(self):
        self.taken["rtl"] = {"syntax/other"}
        self.assert_found("DEC-1, rtl: takes none of its 2 vectors")
        del self.taken["gpu"]
        self.assert_found("DEC-1, rtl: takes none", "DEC-1, gpu: takes none")

    def test_missing_reason(self):
        self.reasons = []
        self.assert_found(
            "COL-1, vectors: no vector exercises it",
            *(f"COL-1, {name}: no file cites it" for name in ("naive", "rtl", "gpu")),
        )

    def test_stale_reason(self):
        self.write("rtl/hmlfc_unit.sv", "// DEC-1, COL-1")
        self.assert_found("reasons.json: COL-1, rtl has a reason, but is not empty")

    def test_stale_reason_of_vectors(self):
        self.vectors[0]["clauses"] = ["DEC-1", "COL-1"]
        self.assert_found("reasons.json: COL-1, vectors has a reason, but is not empty")

    def test_unknown_names(self):
        self.reasons.append({"columns": ["fpga"], "clauses": ["DEC-1"], "reason": "x"})
        self.assert_found("there is no column fpga")
        self.reasons[1] = {"columns": ["rtl"], "clauses": ["DEC-9"], "reason": "x"}
        self.assert_found("the specification does not have DEC-9")
        self.reasons[1] = dict(REASON, columns=["rtl"])
        self.assert_found("COL-1, rtl has two reasons")

    def test_unknown_clauses(self):
        self.vectors[0]["clauses"] = ["DEC-1", "DEC-7"]
        self.assert_found("syntax/first: cites DEC-7")
        self.vectors[0]["clauses"] = ["DEC-1"]
        self.write("rtl/hmlfc_other.sv", "// DEC-8")
        self.assert_found("rtl/hmlfc_other.sv: cites DEC-8")


class Table(ClauseTest):
    def test_rows(self):
        self.taken["rtl"] = {"syntax/second"}
        rows = clause_table.markdown(self.cells())
        self.assertEqual(
            rows[2], "| DEC-1 | 2 | `syntax/second` | `decoder.hpp` | `block.py` | `hmlfc_unit.sv` (1) | `block.glsl` |"
        )
        self.assertEqual(rows[3], "| COL-1 | *a* |  | `block.cpp` | *a* | *a* | *a* |")
        self.assertEqual(rows[5], "- *a*: for encoders.")


if __name__ == "__main__":
    unittest.main()
