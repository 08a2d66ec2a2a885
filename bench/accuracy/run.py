"""One run of the accuracy report."""

import os
import sys
from pathlib import Path

import prediction
import studies
from measure import FRAMES, Measure, calibration_seconds
from process import BenchError, machine, say
from results import Point, Results
from scenes import find_scenes
from store import Store, digest, file_digest

FOLDER = Path(__file__).resolve().parent
MEASURING = [FOLDER / name for name in ("measure.py", "similarity.py")]
FACTS = ("rows", "cols", "width", "height", "chroma", "at")  # that the results keep of a light field


class Run:
    def __init__(self, options, work):
        self.options, self.work = options, work
        self.programs = (options.hmlfc, options.bench)
        self.program = file_digest(*self.programs, *MEASURING)
        self.store = Store(options.output / "measured.json")
        self.results = Results(machine())
        self.skipped, self.failed = [], []
        self.measured = self.reused = 0

    def skip(self, what, why):
        self.skipped.append({"what": what, "why": why})
        say(f"skipped: {what}: {why}")

    def measure(self):
        options = self.options
        scenes = list(
            find_scenes(options.hmlfc, self.work, options.quick, options.light_field, self.skip)
        )
        if not scenes:
            raise BenchError("none of the light fields asked for is there")
        for number, scene in enumerate(scenes, 1):
            self.show(f"[{number} of {len(scenes)}] {scene.name}")
            self.results.scenes[scene.name] = {name: getattr(scene, name) for name in FACTS}
            measure = Measure(self.programs, self.work, scene)
            for coding in studies.codings(options.studies, scene.chroma, options.quick):
                self.encode(measure, coding)
            if "renderer" in options.studies:
                for coding in studies.Studies(scene.chroma, options.quick).renderer():
                    self.draw(measure, coding)
            if "prediction" in options.studies:
                self.predict(scene)
            measure.close()
        self.show("")

    def encode(self, measure, coding):
        scene = measure.scene
        entry = self.once(
            self.key("coding", scene, coding), f"{scene.name}: {coding.label()}",
            lambda: measure.coding(coding),
        )
        if entry:
            self.add(scene, coding, None, entry, entry["values"])

    def draw(self, measure, coding):
        scene, quick = measure.scene, self.options.quick
        sweep = [FRAMES[quick], studies.FILTERS, studies.CACHES, studies.WHOLE_CACHE]
        entry = self.once(
            self.key("frames", scene, coding, sweep), f"{scene.name}: frames of {coding.label()}",
            lambda: measure.frames(coding, studies.frame_settings(measure.levels(coding)), quick),
        )
        for setting, values in entry["values"].items() if entry else ():
            if "skipped" in values:
                self.skip(f"{scene.name} {setting}", values["skipped"])
            else:
                self.add(scene, coding, setting, entry, values)

    def predict(self, scene):
        entry = self.once(
            digest("prediction", file_digest(Path(prediction.__file__)), scene.identity),
            f"{scene.name}: predictions", lambda: prediction.measure(scene.folder),
        )
        if entry:
            self.results.scenes[scene.name]["prediction"] = entry["values"]

    def key(self, kind, scene, coding, *more):
        return digest(kind, self.program, scene.identity, coding.options(), *more)

    def once(self, key, what, measure):
        """The stored entry of a point, or a new measurement; None if it fails, so that the run goes
        on with the other points."""
        entry = self.store.get(key)
        if entry is not None:
            self.reused += 1
            return entry
        self.show(what)
        try:
            entry = {"calibration_seconds": calibration_seconds(), "values": measure()}
        except BenchError as error:
            self.failed.append({"what": what, "why": str(error)})
            say(f"FAILED: {what}: {error}")
            return None
        self.measured += 1
        if not any(isinstance(v, dict) and "skipped" in v for v in entry["values"].values()):
            self.store.add(key, entry)
        return entry

    def show(self, text):
        """Progress: the latest point on a terminal."""
        if sys.stderr.isatty():
            width = os.get_terminal_size(sys.stderr.fileno()).columns - 1
            print(f"\r\033[K{text[:width]}", end="", file=sys.stderr, flush=True)

    def add(self, scene, coding, frame, entry, values):
        self.results.add(Point(scene.name, coding, frame, entry["calibration_seconds"], values))
