"""Frames, counts, errors and traces of pixels by docs/rendering.md in Python, against hmlfc render."""

import paths
import json
import math
import subprocess
import sys

from camera import Camera, CameraError
from frame import Frame, render, shot_of
from frame_trace import trace
from opening import Stream
from picture_files import ppm_bytes, raw_bytes
from pictures import read_png
from program import CORRUPT, DONE, ROOT, USAGE, CliTest, main
from stream_error import StreamError
from trace import PLANE_NAMES

# Cameras by stream, each as inputs of CAM-3, or with fov in degrees in place of tan_half. What is made for what:
# half steps and half pixels for ties, places half a step off the grid and a focus of the width of views for borders,
# turned and far cameras for rays that miss.
VIEWS = {"position": (1.0, 1.0, 0.0)}
TIES = {"position": (0.5, 0.5, 0.0), "frame_width": 17, "frame_height": 12}
TURNED = {"position": (1.2, 0.7, -0.25), "look_at": (1.5, 0.75, 0.75), "focus": -0.75, "fov": 70}
SMALL = {"frame_width": 15, "frame_height": 9}
SURFACE = {"geometry": "stream", "position": (1.4, 0.8, 0.0)}
CAMERAS = {
    "boundary/light-field-1x1": [{}, {"frame_width": 3, "frame_height": 2, "position": (9.0, -7.5, 0.0)}],
    "boundary/motion-1x1": [{**SURFACE, "focus": 0.3}, {**SURFACE, "frame_width": 5, "frame_height": 6}],
    "syntax/rig": [
        {"position": (0.5, 0.0, 0.0), "focus": x, "frame_width": 3, "frame_height": 3} for x in (16.0, -16.0)
    ],
    "boundary/view-23x1": [TIES, {"position": (0.25, 3.0, 0.1), "fov": 60, "frame_height": 7, "frame_width": 7}],
    "boundary/light-field-1xn": [{**SMALL, "position": (x, 0.4, 0.0)} for x in (-0.5, 12.5, 12.50001)],
    "boundary/light-field-nx1": [
        {"position": (0.2, y, 0.0), "aperture": 2, "row_pitch": -2.5, "focus": 0.5, "shear": 0.25} for y in (0.2, 9.6)
    ],
    "boundary/colour-clamps-depth12": [TIES, {**TIES, "filter": "bilinear"}],
    "syntax/depth-9": [{**TURNED, "filter": filtered} for filtered in ("nearest", "bilinear", "quadrilinear")],
    "syntax/lossy-keys-slight": [{"position": (0.3, 0.0, 0.2), "focus": 1.5, **SMALL}],
    "syntax/blocks-8-444": [{**TURNED, "aperture": 1}, {**TURNED, "look_at": (9.0, 0.7, -0.2)}],
    "syntax/tree-3": [
        *({"position": (2.3, 3.1, 0.0), "stop_level": level, "aperture": level} for level in range(4)),
        {"position": (2.0, 3.5, 0.0), "shear": 1.5, "focus": 1.5, "filter": "nearest", "focal": 30.5},
    ],
    "real/glass-lossless": [VIEWS, {**SURFACE, "position": (0.45, 0.55, 0.0)}],
    "real/glass-depth10": [
        *({**SURFACE, "position": (0.45, 0.55, 0.0), "frame_height": h} for h in (24, 23)), {**SMALL, "aperture": 3},
    ],
    "real/knights-tree": [
        {**SURFACE, "stop_level": 1, **SMALL},
        {**SURFACE, "filter": "nearest", "focus": -0.5, "frame_width": 30, "frame_height": 22},
        {**SURFACE, "position": (2.6, 1.5, -1.0), "look_at": (2.5, 1.6, 2.0), "row_pitch": 1.25, "fov": 55},
    ],
    "syntax/disparity-grid-8": [
        SURFACE,
        {**SURFACE, "focus": 1.5, "filter": "bilinear", "fov": 55},
        {**SURFACE, "position": (-0.4, 2.3, 0.0), "row_pitch": 1.23},
        {**SURFACE, "position": (1.01, 1.0, 0.0), "focus": -256.0, **SMALL},
        {**SURFACE, "aperture": 1, **SMALL},
    ],
    "stress/random-extended-08": [{**SURFACE, "position": (x + 0.375, 0.0, 0.0)} for x in range(3)],
    "stress/random-extended-24": [{**SURFACE, "position": (3.25, 1.25, 0.0)}],
    "syntax/all-flags": [{**SURFACE, "frame_width": 34}, {"geometry": "stream", "position": (3.5, -0.4, 0.0)}],
    "syntax/masks-quads-quads": [{**SURFACE, "position": (0.7, 0.0, 0.0), "frame_width": 26, "frame_height": 26}],
    "boundary/disparity-damaged-unused": [{**SURFACE, "position": (0.4, 0.0, 0.0), **SMALL}],
    "error/section-crc-tile": [{"position": (0.6, 0.0, 0.0)}],
    "error/level-base-28": [{"position": (x, 0.0, 0.0), "geometry": "stream"} for x in (0.0, 0.4)],
    "error/overrun-last-block": [{"position": (0.75, 0.0, 0.0)}],
    "error/pair-tree-second-key-disparity": [SURFACE, {"position": (0.0, 0.0, 0.0)}],
    "error/pair-tiles-level-bits-second-mask": [SURFACE, {"position": (1.5, 0.0, 0.0), "stop_level": 1}],
    "error/version-2": [{}],
}
PIXELS = [(0, 0), (5, 3), (14, 6)]

# Cameras that are not valid, and the input that is named first.
NOT_VALID = [
    ({"focal": 0.5, "row_pitch": 0.01}, "focal"),
    ({"focal": 65536.0}, "tan_half"),
    ({"shear": 300.0, "position": (9000.0, 0.0, 0.0)}, "shear"),
    ({"row_pitch": -8.0}, "row_pitch"),
    ({"position": (0.0, 0.0, 3000.0), "row_pitch": 0.5}, "position"),
    ({"position": (1.0, 1.0, 0.0), "look_at": (1.0, 5.0, 0.0)}, "look_at"),
    ({"position": (1.0, 1.0, 0.0), "look_at": (1.0, 1.0, 2**-21)}, "look_at"),
    ({"position": (0.0, 0.0, 4000.0), "look_at": (0.0, 0.0, 4000.0), "focus": 256.0, "row_pitch": 1.0}, "look_at"),
    ({"position": (0.0, 0.0, 4000.0), "focus": 256.0, "row_pitch": 1.0}, "position"),
]


def camera_of(fov=None, **inputs):
    """The camera, with tan_half as a user interface has it (CAM-3)."""
    if fov is not None:
        inputs["tan_half"] = math.floor(math.tan(math.radians(fov) / 2) * 2**20 + 0.5) / 2**20
    return Camera(**inputs)


def options_of(header, fov=None, **inputs):
    """The options of hmlfc render for a camera."""
    camera = Camera(**inputs)
    given = {
        "camera": camera.position, "look-at": camera.look_at, "fov": fov, "focal": camera.focal, "shear": camera.shear,
        "row-pitch": camera.row_pitch, "focus": camera.focus, "aperture": camera.aperture, "filter": camera.filter,
        "geometry": camera.geometry, "levels": header.tree_height + 1 - camera.stop_level,
        "size": f"{camera.frame_width or header.width}x{camera.frame_height or header.height}",
    }  # fmt: skip
    numbers = {name: ",".join(map(str, v)) if isinstance(v, tuple) else v for name, v in given.items()}
    return [f"--{name}={value}" for name, value in numbers.items() if value is not None]


def kinds_of(shot, frame):
    """What happens in a frame: names."""
    surface = shot.surface
    cells = [cell for cell in surface.cells.values() if not cell.ray.outside] if surface else []
    steps = [step for cell in cells for proposal in cell.proposals for step in proposal.steps]
    known = [step.disparity for step in steps if step.confidence > 0]
    found = {
        "inside": frame.counts["outside"] < frame.width * frame.height,
        "outside": frame.counts["outside"] > 0,
        "moved": any(cell.displacement != 0 for cell in cells),
        "views disagree": any(cell.displacement != cell.median for cell in cells),
        "unknown": len(known) < len(steps),
        "fine": any(0 < abs(disparity) < frame.record["fine"] for disparity in known),
        "steps differ": any(steps[i].displacement != steps[i + 1].displacement for i in range(0, len(steps), 2)),
    }
    return {name for name, is_so in found.items() if is_so}


class FramesTest(CliTest):
    def test_frames_counts_errors_and_traces(self):
        seen, failed = set(), set()
        for name, cameras in CAMERAS.items():
            data = (ROOT / "vectors" / f"{name}.hmlfc").read_bytes()
            for inputs in cameras:
                with self.subTest(stream=name, camera=inputs):
                    try:
                        shot = shot_of(data, camera_of(**inputs))
                        frame = Frame(shot, shot.pixels.header.depth)
                        shot.pixels.require_all()
                    except StreamError as error:
                        failed.add(error.name)
                        self.compare_error(name, data, inputs, error)
                        continue
                    seen |= kinds_of(shot, frame)
                    self.compare(name, data, inputs, frame)
        kinds = {"inside", "outside", "moved", "views disagree", "unknown", "fine", "steps differ"}
        self.assertEqual(seen, kinds)
        self.assertGreater(len(failed), 3)

    def compare_error(self, name, data, inputs, error):
        """The program names the same error, at the byte that it names for the block at the error's place."""
        file, options = ROOT / f"vectors/{name}.hmlfc", []
        if error.place:
            header = Stream(data, whole=False).header
            options = options_of(header, **inputs)
            level, row, col, plane, *block = error.place
            view = row * header.cluster_rows**level, col * header.cluster_cols**level
            place = ["--view={},{}".format(*view), f"--plane={PLANE_NAMES[plane]}", "--block={},{}".format(*block)]
            says = self.refused(CORRUPT, "inspect", file, *place, f"--levels={header.tree_height + 1 - level}")
        else:
            says = f"{file}: {error.name} in "
        self.assertIn(f"{error.name} in ", says)
        self.refused(CORRUPT, "render", file, *options, "-o", "none.png", says=says)

    def compare(self, name, data, inputs, frame):
        """The frame is that of the program, and it is that of the program's frame record."""
        header = Stream(data, whole=False).header
        arguments = [ROOT / f"vectors/{name}.hmlfc", *options_of(header, **inputs), "--threads=1"]
        report = self.hmlfc_json("render", *arguments, "--force", "-o", "frame.png")["frames"][0]
        picture = read_png(self.folder / "frame.png")
        shift = 16 - header.depth if header.depth > 8 else 0
        samples = [sample for row in frame.samples for pixel in row for sample in pixel]
        self.assertEqual([sample >> shift for sample in picture.samples], samples)
        pixels = frame.width * frame.height
        outside = round(report["outside"] * pixels)
        counts = {count: report[count] for count in ("blocks_needed", "disparities_looked_up")}
        self.assertEqual({**counts, "outside": outside}, frame.counts)
        camera = camera_of(**inputs)
        for x, y in {(x % frame.width, y % frame.height) for x, y in PIXELS}:
            told = self.hmlfc_json("render", *arguments, f"--trace={x},{y}")
            self.assertEqual(told, trace(data, camera, x, y))
        words = [value["value"] % 2**32 for value in told["stages"][0]["values"]]
        self.assertEqual(trace(data, words, x, y, camera.stop_level), told)

    def test_a_camera_that_is_not_valid_is_named(self):
        name = ROOT / "vectors/syntax/disparity-grid-8.hmlfc"
        header = Stream(name.read_bytes()).header
        for inputs, fault in NOT_VALID:
            with self.subTest(camera=inputs), self.assertRaises(CameraError) as raised:
                render(name.read_bytes(), Camera(**inputs))
            self.assertEqual(raised.exception.name, fault)
            self.refused(USAGE, "render", name, *options_of(header, **inputs), "-o", "none.png", says=fault)

    def test_a_record_of_another_light_field(self):
        data = [(ROOT / f"vectors/{name}.hmlfc").read_bytes() for name in ("syntax/depth-9", "syntax/tree-3")]
        words = list(render(data[0], Camera()).record.values())
        for wrong in (words[:-1], words + [0]):
            self.assertRaises(ValueError, render, data[0], wrong)
        self.assertRaises(ValueError, render, data[1], words)


class RenderCommand(CliTest):
    """render.py as its users see it."""

    def ran(self, name, *arguments):
        command = [sys.executable, "-B", paths.DECODER / "render.py", ROOT / f"vectors/{name}.hmlfc", *arguments]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False, timeout=60)

    def test_files_and_counts(self):
        data = (ROOT / "vectors/syntax/depth-9.hmlfc").read_bytes()
        camera = Camera(position=(0.5, 0.5, 0.0), frame_width=5, frame_height=4)
        frame = render(data, camera)
        shots = [{"position": [0.5, 0.5, 0], "frame_width": 5, "frame_height": 4}]
        shots.append({"record": list(frame.record.values()), "stop_level": 0})
        for shot in shots:
            for file, as_bytes in (("frame.raw", raw_bytes), ("frame.ppm", ppm_bytes)):
                result = self.ran("syntax/depth-9", json.dumps(shot), "-o", file)
                self.assertEqual((result.returncode, json.loads(result.stdout)), (DONE, frame.counts), result.stderr)
                self.assertEqual((self.folder / file).read_bytes(), as_bytes(frame.samples, 9))
            result = self.ran("syntax/depth-9", json.dumps(shot), "--trace", "1,2")
            self.assertEqual(json.loads(result.stdout), trace(data, camera, 1, 2))

    def test_errors(self):
        self.assertEqual(self.ran("error/version-2", "{}", "-o", "none").stderr, "bad_version\n")
        result = self.ran("error/level-base-28", '{"position": [1, 0, 0]}', "-o", "none")
        self.assertEqual((result.returncode, result.stderr[:13]), (CORRUPT, "bad_levels 0 "))
        result = self.ran("syntax/depth-9", '{"focal": 0}', "-o", "none")
        self.assertEqual((result.returncode, result.stderr), (USAGE, "focal\n"))
        for shot in ("", "{", '{"zoom": 1}', '{"record": [1, 2]}', "[]", "3"):
            self.assertEqual(self.ran("syntax/depth-9", shot, "-o", "none").returncode, USAGE, shot)
        self.assertEqual(self.ran("syntax/missing", "{}", "-o", "none").returncode, 3)
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    main()
