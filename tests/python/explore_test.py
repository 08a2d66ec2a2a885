"""examples/explore.py and its pictures; the program of docs/python.md."""

import contextlib
import os
import subprocess
import sys

import numpy as np
from python_case import ROOT, STREAM, CliTest, hmlfc, main, picture


class ExploreTest(CliTest):
    def test_its_pictures(self):
        environment = {**os.environ, "PYTHONPATH": sys.argv[2], "PYTHONDONTWRITEBYTECODE": "1"}
        command = [sys.executable, ROOT / "examples" / "explore.py", STREAM, self.folder]
        subprocess.run(command, env=environment, check=True, timeout=60)
        lf = hmlfc.open(STREAM)
        np.testing.assert_array_equal(picture(self.folder / "view.png"), lf[2, 2])
        epipolar = picture(self.folder / "epipolar.png")
        self.assertEqual(epipolar.shape, (8 * 5, 40, 3))
        for col in range(5):
            np.testing.assert_array_equal(epipolar[8 * col + 3], lf[2, col, 20])
        frames = np.split(picture(self.folder / "focus.png"), 4, axis=1)
        nearest = lf.disparity(2, 2)[0].min()
        np.testing.assert_array_equal(frames[0], lf.render(focus=nearest, aperture=2, geometry="plane"))
        self.assertFalse(np.array_equal(frames[0], frames[3]))

    def test_what_is_missing_is_said(self):
        for name, says in [("numpy", "apt-get install python3-numpy"), ("hmlfc._core", "built for another Python")]:
            code = f"import sys; sys.path.insert(0, sys.argv[1]); sys.modules['{name}'] = None; import hmlfc"
            done = subprocess.run([sys.executable, "-c", code, sys.argv[2]], capture_output=True, text=True)
            self.assertRegex(done.stderr, f"ModuleNotFoundError: hmlfc cannot be imported: .*{says}")

    def test_the_document(self):
        text = (ROOT / "docs" / "python.md").read_text()
        self.hmlfc("synth", "--scene", "cards", "--grid", "5x5", "--size", "64x48", "-o", "views")
        self.hmlfc("encode", "views", "-o", "views.hmlfc", "--quality", "80")
        names = {}
        with contextlib.chdir(self.folder):
            exec(text.split("```python\n")[1].split("```")[0], names)
        self.assertEqual(names["part"].shape, (30, 40, 3))
        np.testing.assert_array_equal(names["part"], names["view"][10:40, 8:48])
        self.assertEqual((names["lines"].shape, names["frame"].shape), ((5, 64, 3), (48, 64, 3)))
        self.assertEqual(names["stream"], (self.folder / "views.hmlfc").read_bytes())


if __name__ == "__main__":
    main()
