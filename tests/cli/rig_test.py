"""Rigs: encode --rig and --no-rig, positions in file names, what info says and writes."""

import json
import shutil

from program import CORRUPT, INPUT, ROOT, USAGE, CliTest, main

POSITIONS = [[0, 0, 0], [1, 0.5, 0], [0, 1, 0], [1, 1, 0.25]]
RIG = {"schema": 1, "metres_per_unit": 0.5, "positions": POSITIONS, "intrinsics": [[40, 40, 19.5, 14.5]]}


class Rig(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 2x2 --size 40x30 -o views".split())
        cls.hmlfc(*"encode views -o plain.hmlfc".split())
        cls.write("rig.json", RIG)
        cls.hmlfc(*"encode views -o posed.hmlfc --rig rig.json".split())
        (cls.folder / "named").mkdir()
        for row in range(2):
            for col in range(2):
                name = f"out_{row:02}_{col:02}_{-380.5 - 8 * row}_{1100 - 9 * col}.png"
                shutil.copy(cls.folder / f"views/{row:02}_{col:02}.png", cls.folder / "named" / name)

    @classmethod
    def write(cls, name, content):
        (cls.folder / name).write_text(json.dumps(content))

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def test_what_info_writes_encode_reads(self):
        text = self.hmlfc("info", "posed.hmlfc", "--rig")
        self.assertEqual(json.loads(text), RIG)
        self.assertEqual(self.hmlfc_json("info", "posed.hmlfc")["rig"], RIG)
        (self.folder / "again.json").write_text(text)
        self.hmlfc(*"encode views -o again.hmlfc --rig again.json".split())
        self.assertEqual(self.bytes_of("again.hmlfc"), self.bytes_of("posed.hmlfc"))

    def test_names_state_positions(self):
        self.noted("numbers 1 and 2 of the names; 3 and 4 vary", *"encode named -o named.hmlfc".split())
        rig = self.hmlfc_json("info", "named.hmlfc")["rig"]
        self.assertEqual(rig["positions"], [[-1100, 380.5, 0], [-1091, 380.5, 0], [-1100, 388.5, 0], [-1091, 388.5, 0]])
        line = "4 cameras at x -1100 to -1091, y 380.5 to 388.5, z 0; rotations: none; intrinsics: not known"
        self.assertIn(f"Rig           {line}\n", self.hmlfc("info", "named.hmlfc"))
        self.noted("numbers 1 and 2 of the names; 3 and 4 vary", *"encode named -o part.hmlfc --views 0..1,1".split())
        self.assertEqual(len(self.hmlfc_json("info", "part.hmlfc")["rig"]["positions"]), 2)

    def folder_with(self, name, file, text):
        """A copy of the views, with `file` beside them."""
        shutil.copytree(self.folder / "views", self.folder / name)
        (self.folder / name / file).write_text(text)

    def test_what_lies_beside_the_views(self):
        self.folder_with("both", "rig.json", json.dumps(RIG))
        (self.folder / "both" / "parameters.cfg").write_text("rig.json comes first")
        self.hmlfc(*"encode both -o both.hmlfc".split())
        self.assertEqual(self.bytes_of("both.hmlfc"), self.bytes_of("posed.hmlfc"))
        self.hmlfc(*"encode both -o bare.hmlfc --no-rig".split())
        self.assertEqual(self.bytes_of("bare.hmlfc"), self.bytes_of("plain.hmlfc"))
        (self.folder / "both" / "rig.json").unlink()
        self.refused(INPUT, *"encode both -o x.hmlfc".split(),
                     says=["both/parameters.cfg: line 1", "(--no-rig leaves it out)"])
        self.folder_with("old", "rig.json", json.dumps({**RIG, "positions": POSITIONS[:3]}))
        self.refused(INPUT, *"encode old -o x.hmlfc".split(), says=["old/rig.json: positions has 3 entries", "--no-rig"])

    def test_without_a_rig(self):
        self.noted("numbers 1 and 2 of the names; 3 and 4 vary", *"encode named -o left.hmlfc --no-rig".split())
        self.assertEqual(self.bytes_of("left.hmlfc"), self.bytes_of("plain.hmlfc"))
        self.noted("numbers 1 and 2 of the names; 3 and 4 vary", *"encode named -o main.hmlfc --profile main".split())
        self.assertIsNone(self.hmlfc_json("info", "main.hmlfc")["rig"])
        self.assertNotIn("Rig", self.hmlfc("info", "plain.hmlfc"))
        self.refused(INPUT, *"info plain.hmlfc --rig".split(), says=["plain.hmlfc", "has no rig"])

    def test_a_target_counts_the_rig(self):
        self.hmlfc(*"encode views -o most.hmlfc --max-bytes 4000 --rig rig.json".split())
        self.assertLessEqual(len(self.bytes_of("most.hmlfc")), 4000)

    def test_cameras_of_a_scene(self):
        self.hmlfc(*"synth --scene cards --grid 2x2 --size 40x30 -o scene --rig scene.json".split())
        self.hmlfc(*"encode scene -o scene.hmlfc --rig scene.json".split())
        text = (self.folder / "scene.json").read_text()
        self.assertEqual(self.hmlfc("info", "scene.hmlfc", "--rig"), text)
        (left, top, _), (right, bottom, _) = json.loads(text)["positions"][0::3]
        self.assertEqual((left, top), (-right, -bottom))
        self.refused(USAGE, *"synth --scene flat --grid 2x2 --size 40x30 -o flat --rig x.json".split(), says=["--rig"])

    def test_scenes_from_rigs(self):
        synth = "synth --scene cards --grid 2x3 --size 40x30 --baseline 40 -o {0} --rig {0}.json --cameras {0}"
        seen = set()
        for cameras in ("grid", "plane", "sphere", "path"):
            self.hmlfc(*synth.format(cameras).split())
            rig = json.loads((self.folder / f"{cameras}.json").read_text())
            self.assertEqual("rotations" in rig, cameras in ("sphere", "path"), cameras)
            self.assertEqual(len({z for _, _, z in rig["positions"]}) > 1, cameras in ("sphere", "path"))
            seen.add((self.folder / cameras / "00_00.png").read_bytes())
        self.assertEqual(len(seen), 4)
        again = synth.format("sphere").replace("sphere --rig", "again --threads 1 --force --rig").split()
        self.hmlfc(*again)
        for name in ("00_00.png", "01_02.png"):
            self.assertEqual((self.folder / "again" / name).read_bytes(), (self.folder / "sphere" / name).read_bytes())
        scene = "synth --scene {} --grid 2x2 --size 40x30 -o x --cameras sphere"
        self.refused(USAGE, *scene.format("flat").split(), says=["--cameras", "choose another"])
        self.refused(USAGE, *scene.format("cards --disparity y").split(), says=["--disparity needs --cameras grid"])

    def test_files_that_hold_no_rig(self):
        encode = "encode views -o x.hmlfc --rig bad.json".split()
        self.write("bad.json", {**RIG, "positions": POSITIONS[:3]})
        self.refused(INPUT, *encode, says=["bad.json", "positions has 3 entries; 4 are needed"])
        self.write("bad.json", {**RIG, "lens": 1})
        self.refused(INPUT, *encode, says=["bad.json", "lens"])
        (self.folder / "bad.json").write_text("{")
        self.refused(INPUT, *encode, says=["bad.json", "no JSON text: byte 2"])
        self.refused(INPUT, *"encode views -o x.hmlfc --rig none.json".split(), says=["none.json"])
        self.refused(USAGE, *"encode views -o x.hmlfc --profile main --rig rig.json".split(),
                     says=["--rig needs --profile extended"])
        self.refused(USAGE, *"encode views -o x.hmlfc --no-rig --rig rig.json".split(), says=["--rig"])

    def test_a_stream_whose_rig_cannot_be_read(self):
        vector = ROOT / "vectors/boundary/rig-positions-one.hmlfc"
        what = "section RIG at byte 172: positions has 1 entries; 2 are needed, one for each view"
        for arguments, says in (((), f"Rig           cannot be read: {what}\n"), (("--json",), f'"error": "{what}"')):
            result = self.run_hmlfc("info", vector, *arguments)
            self.assertEqual(result.returncode, CORRUPT)
            self.assertIn(says, result.stdout.decode())
            self.assertIn(what, result.stderr.decode())
        self.refused(CORRUPT, "info", vector, "--rig", says=[str(vector), what])


if __name__ == "__main__":
    main()
