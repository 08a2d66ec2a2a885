"""The rigs of the conformance vectors: which are refused and why, and what the others say (RIG-2 to RIG-4).
The program refuses the same of many damaged ones."""

import paths
import json
import random
import unittest

from crc32c import crc32c
from header import number
from opening import Stream
from program import CORRUPT, DONE, CliTest, main
from rig import RigError, read_rig, rig_section
from stream_error import StreamError

FOLDER = paths.DECODER.parents[1] / "vectors"
REFUSED = {
    "boundary/rig-empty": "no JSON text",
    "boundary/rig-no-text": "no JSON text",
    "boundary/rig-zeros": "no JSON text",
    "boundary/rig-not-utf-8": "no UTF-8",
    "boundary/rig-schema-2": "another schema",
    "boundary/rig-member": "an unknown member",
    "boundary/rig-member-twice": "a member twice",
    "boundary/rig-positions-one": "positions: a wrong number of entries",
    "boundary/rig-position-far": "a position out of range",
    "boundary/rig-rotation-long": "a rotation of another length",
}


def rigs_of_vectors():
    """{id: (section RIG, rows, cols)} of the vectors that open and have one."""
    found = {}
    for vector in json.loads((FOLDER / "manifest.json").read_text())["vectors"]:
        if "camera_rig" in vector["flags"]:
            data = (FOLDER / vector["input"]["file"]).read_bytes()
            try:
                header = Stream(data).header
            except StreamError:
                continue
            found[vector["id"]] = rig_section(header, data), header.rows, header.cols
    return found


def refusal(section, rows, cols):
    try:
        read_rig(section, rows, cols)
    except RigError as error:
        return str(error)
    return None


def with_rig(data, text):
    """The stream `data`, which has a rig, with another one."""
    size = number(data, 10, 2)
    table = size - 4 - 5 * 24
    begin, length = number(data, table + 8, 8), number(data, table + 16, 8)
    header = bytearray(data[:size])
    header[table + 4 : table + 8] = crc32c(text).to_bytes(4, "little")
    header[table + 16 : table + 24] = len(text).to_bytes(8, "little")
    for entry in range(table + 24, table + 120, 24):
        offset = number(data, entry + 8, 8) + len(text) - length
        header[entry + 8 : entry + 16] = offset.to_bytes(8, "little")
    header[-4:] = crc32c(header[:-4]).to_bytes(4, "little")
    return bytes(header) + text + data[begin + length :]


VALUES = [
    0, 1, -1, 0.5, 1.0, 1e6, 2**20, 2**20 + 1, -(2**20), 0.0625, 0.06, 1e-13, 1e13, 1e300, None, True, "1",
    [], [1], {}, [1, 0, 0, 0], [0.99, 0, 0, 0], [0.9996, 0, 0, 0], [[1, 0, 0, 0]], [[1, 0, 0, 0]] * 2, [[0, 0, 0]] * 2,
]  # fmt: skip


# Forms of a text that readers may take differently: schema, then what follows it and what follows the text.
FORMS = [
    ("schema", "1.0", "", ""), ("schema", "10e-1", "", "\n"), ("schema", "01", "", ""), ("schema", "+1", "", ""),
    ("schema", "1.", "", ""), ("schema", ".1e1", "", ""), ("schema", "1E0", "", ""), ("schema", "0x1", "", ""),
    ("schema", "\u0661", "", ""), ("schema", "Infinity", "", ""), ("schema", "NaN", "", ""), ("schema", "[1]", "", ""),
    ("sch\\u0065ma", "1", "", ""), ("sch\\u0065ma", "1", ',"schema":1', ""), ("sch\\x65ma", "1", "", ""),
    ("schema\\u0000", "1", "", ""), ("sche\nma", "1", "", ""), ("\\ud800", "1", "", ""), ("SCHEMA", "1", "", ""),
    ("".join(f"\\u{ord(c):04x}" for c in "schema"), "1", "", ""), ("a" * 3000, "1", "", ""),
    ("schema", "1", ",", ""), ("schema", "1", "", "\0"), ("schema", "1", "", "\0\0\0"), ("schema", "1", "\0", ""),
    ("schema", "1", "\x0c", ""), ("schema", "1", "\u00a0", ""), ("schema", "1", "/**/", ""), ("schema", "1", "\t\r\n ", " "),
    ("schema", "1", "", "{}"), ("schema", "1", "", "]"), ("schema", "1." + "0" * 2046, "", ""),
    ("schema", "1." + "0" * 2047, "", ""), ("schema", "1e999", "", ""), ("schema", "1" * 5000, "", ""),
    ("schema", "1", ',"metres_per_unit":1e-400', ""), ("schema", "1", ',"metres_per_unit":5e-324', ""),
    ("schema", "1", ',"metres_per_unit":1099511627776.00006103515625', ""),
    ("schema", "1", ',"metres_per_unit":1099511627776.00012207031251', ""),
]  # fmt: skip
NESTED = [b"[" * 2**20, b'{"schema":' + b"[" * 2**20, b'{"a":' * 2**18, b'{"schema":1,"positions":' + b"[" * 2**20]


def damaged_text(rng):
    """A rig of two views, and up to two changes of its members, its numbers or its bytes."""
    rig = {
        "schema": 1, "metres_per_unit": 0.5, "positions": [[0, 0, 0], [1, 0, 0]],
        "rotations": [[1, 0, 0, 0]], "intrinsics": [[20, 20, 7, 7], [21, 21, 8, 8]],
    }  # fmt: skip
    for _ in range(rng.randrange(3)):
        member = rng.choice([*rig, "other"])
        kind = rng.randrange(4)
        if kind == 0:
            rig.pop(member, None)
        elif kind == 1:
            rig[member] = rng.choice(VALUES)
        elif isinstance(rig.get(member), list) and rig[member]:
            entry = rng.randrange(len(rig[member]))
            inner = rig[member][entry]
            if kind == 2 and isinstance(inner, list) and inner:
                inner[rng.randrange(len(inner))] = rng.choice(VALUES)
            else:
                rig[member][entry] = rng.choice(VALUES)
    text = bytearray(json.dumps(rig).encode())
    if rng.random() < 0.3:
        at = rng.randrange(len(text))
        text[at : at + rng.randrange(2)] = rng.choice([b"\xff", b"1", b"}", b"e999", b"\xc3\xa9", b"\xef\xbb\xbf", b" ", b""])
    return bytes(text)


class DamagedRigTest(CliTest):
    def agreed(self, stream, text, turn):
        """Why the naive reader refuses the text, as the program must too, or None."""
        (self.folder / "a.hmlfc").write_bytes(with_rig(stream, text))
        reason = refusal(text, 1, 2)
        result = self.run_hmlfc("info", "a.hmlfc", "--rig")
        self.assertEqual(result.returncode, CORRUPT if reason else DONE, (turn, text[:4000], reason, result.stderr))
        if not reason:
            self.assertEqual(result.stdout, text + b"\n")
        return reason

    def test_the_program_takes_the_same_forms(self):
        stream = (FOLDER / "syntax/rig.hmlfc").read_bytes()
        taken = 0
        for turn, (name, schema, between, after) in enumerate(FORMS):
            text = f'{{"{name}":{schema}{between},"positions":[[0,0,0],[1,0,0]]}}{after}'
            taken += self.agreed(stream, text.encode(), turn) is None
        self.assertEqual(taken, 8)

    def test_nested_texts_are_refused_at_once(self):
        stream = (FOLDER / "syntax/rig.hmlfc").read_bytes()
        for turn, text in enumerate(NESTED):
            reason = self.agreed(stream, text, turn)
            self.assertIn(reason, ("no object", "schema: no number", "an unknown member", "positions: no number"))

    def test_the_program_refuses_the_same(self):
        stream = (FOLDER / "syntax/rig.hmlfc").read_bytes()
        rng = random.Random(1)
        seen = {None: 0}
        for turn in range(400):
            text = damaged_text(rng)
            reason = self.agreed(stream, text, turn)
            seen[reason] = seen.get(reason, 0) + 1
        self.assertGreater(seen[None], 40)
        self.assertGreater(len(seen), 12, seen)


class RigTest(unittest.TestCase):
    def test_vectors_are_refused_for_their_reasons(self):
        rigs = rigs_of_vectors()
        self.assertLess(len(REFUSED), len(rigs))
        for name, rig in rigs.items():
            with self.subTest(vector=name):
                self.assertEqual(refusal(*rig), REFUSED.get(name))

    def test_every_member_is_read(self):
        rig = read_rig(*rigs_of_vectors()["syntax/rig"])
        self.assertEqual(rig["metres_per_unit"], 0.001)
        self.assertEqual(rig["positions"], [[0, 0, 0], [62.5, -0.25, 0.1]])
        self.assertEqual(rig["rotations"], [[1, 0, 0, 0], [0.6, 0, -0.8, 0]])
        self.assertEqual(rig["intrinsics"], [[24.5, 24.5, 7.5, 7.5]] * 2)

    def test_what_is_missing_has_its_meaning(self):
        rig = read_rig(*rigs_of_vectors()["syntax/rig-positions"])
        self.assertEqual(rig["rotations"], [[1, 0, 0, 0]] * 2)
        self.assertIsNone(rig["intrinsics"])
        self.assertIsNone(rig["metres_per_unit"])


if __name__ == "__main__":
    main()
