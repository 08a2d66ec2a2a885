#!/usr/bin/env python3
"""Time against error: what encodings and rendered frames cost, and how wrong they are.

Measures the light fields of HMLFC_DATA_DIR and the built-in scenes by studies; docs/accuracy.md says
what each measures. Writes points.csv, points.json and a picture for each study, prints the tables, and
compares with the recorded run: bytes and errors as they are, times after division by the CPU time of
fixed work. A point that is already in the folder, of the same programs, is not measured again.

Exit status: 0 done, 1 something is worse than in the recorded run, 2 something cannot be measured.
"""

import argparse
import json
import os
import resource
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    import plots
    import prediction
    import studies
    from bench_error import BenchError
    from calibration import Calibration
    from comparison import compare
    from document_tables import with_tables
    from measure import FRAMES, Measure
    from process import machine
    from results import Point, Results, read_json, write_csv, write_json
    from scenes import find_scenes
    from sources import ROOT
    from store import Store, digest, file_digest
    from tables import NAMES as TABLES
    from tables import Tables
except ImportError as error:
    names = "python3-numpy, python3-pil, python3-matplotlib and python3-skimage"
    sys.exit(f"{error}: install the Debian packages {names}")

RECORDED = Path(__file__).resolve().with_name("recorded.json")
MEASURING = [RECORDED.with_name(name) for name in ("measure.py", "similarity.py")]
DOCUMENT = ROOT / "docs" / "accuracy.md"


def say(text):
    """A message, in place of the progress on a terminal."""
    clear = "\r\033[K" if sys.stderr.isatty() else ""
    print(f"{clear}{text}", file=sys.stderr, flush=True)


class Run:
    """One run: what it measures, with what, and what came of it."""

    def __init__(self, options, work):
        self.options, self.work = options, work
        self.programs = (options.hmlfc, options.bench)
        self.program = file_digest(*self.programs, *MEASURING)
        self.store = Store(options.output / "measured.jsonl")
        self.calibration = Calibration()
        self.results = Results(machine())
        self.skipped, self.failed = [], []
        self.measured = self.reused = 0
        self.done = self.total = 0

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
        plans = [(scene, *self.plan(scene)) for scene in scenes]
        predicting = "prediction" in options.studies
        self.total = sum(len(codings) + len(streams) + predicting for _, codings, streams in plans)
        for scene, codings, streams in plans:
            self.results.scenes[scene.name] = facts(scene)
            measure = Measure(self.programs, self.work, scene)
            for coding in codings:
                self.encode(measure, coding)
            for coding in streams:
                self.draw(measure, coding)
            if predicting:
                self.predict(scene)
            measure.close()

    def key(self, kind, scene, coding, *more):
        return digest(kind, self.program, scene.identity, coding.options(), *more)

    def plan(self, scene):
        """Codings to measure, and those to draw frames of."""
        chosen, quick = self.options.studies, self.options.quick
        streams = studies.Studies(scene.chroma, quick).renderer() if "renderer" in chosen else []
        return studies.codings(chosen, scene.chroma, quick), streams

    def encode(self, measure, coding):
        scene = measure.scene

        def take(entry):
            self.add(scene, coding, None, entry["calibration_seconds"], entry["values"])

        what = f"{scene.name}: {coding.label()}"
        self.once(self.key("coding", scene, coding), what, lambda: measure.coding(coding), take)

    def draw(self, measure, coding):
        scene, quick = measure.scene, self.options.quick

        def frames():
            settings = studies.frame_settings(measure.levels(coding))
            return measure.frames(coding, settings, quick)

        def take(entry):
            for setting, values in entry["values"].items():
                if "skipped" in values:
                    self.skip(f"{scene.name} {setting}", values["skipped"])
                else:
                    self.add(scene, coding, setting, entry["calibration_seconds"], values)

        sweep = [FRAMES[quick], studies.FILTERS, studies.CACHES, studies.WHOLE_CACHE]
        what = f"{scene.name}: frames of {coding.label()}"
        self.once(self.key("frames", scene, coding, sweep), what, frames, take)

    def predict(self, scene):
        def take(entry):
            self.results.scenes[scene.name]["prediction"] = entry["values"]

        what = f"{scene.name}: predictions"
        self.once(
            digest("prediction", file_digest(Path(prediction.__file__)), scene.identity),
            *(what, lambda: prediction.measure(scene.folder), take),
        )

    def once(self, key, what, measure, take):
        """Takes what is stored of a point, or else measures it. A point that fails does not keep
        the others from being measured."""
        self.done += 1
        entry = self.store.get(key)
        if entry is not None:
            self.reused += 1
            return take(entry)
        self.show(f"[{self.done} of {self.total}] {what}")
        try:
            entry = {"calibration_seconds": self.calibration.now(), "values": measure()}
        except BenchError as error:
            self.failed.append({"what": what, "why": str(error)})
            return say(f"FAILED: {what}: {error}")
        self.measured += 1
        if not any(isinstance(v, dict) and "skipped" in v for v in entry["values"].values()):
            self.store.add(key, entry)
        return take(entry)

    def show(self, text):
        """Progress: the latest point on a terminal."""
        if sys.stderr.isatty():
            width = os.get_terminal_size(sys.stderr.fileno()).columns - 1
            print(f"\r\033[K{text[:width]}", end="", file=sys.stderr, flush=True)

    def add(self, scene, coding, frame, calibration, values):
        point = Point(scene.name, coding, frame, self.program, calibration, values)
        self.results.add(point)


def facts(scene):
    """What the results keep of a light field."""
    names = ("rows", "cols", "width", "height", "chroma", "at")
    return {name: getattr(scene, name) for name in names}


def cpu_seconds():
    """Of this process and the programs that it ran."""
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return sum(usage.ru_utime + usage.ru_stime for usage in map(resource.getrusage, who))


def write_document(path, results):
    """Puts the tables of the recorded run into the document."""
    text = path.read_text(encoding="utf-8")
    path.write_text(document_text(text, results), encoding="utf-8")


def document_text(text, results):
    return with_tables(text, Tables(results, quick=False).make, TABLES)


def check_document(options):
    """Whether the tables of the document are those of the recorded run."""
    text = options.document.read_text(encoding="utf-8")
    if document_text(text, read_json(options.recorded)) == text:
        return 0
    say(f"the tables of {options.document} are not those of {options.recorded}: "
        "./run bench accuracy --write-document puts them there")
    return 1


def report(run):
    """Writes the files of a run, prints tables and changes. Returns the exit status."""
    output, options = run.options.output, run.options
    write_csv(run.results, output / "points.csv")
    write_json(run.results, output / "points.json")
    plots.draw(run.results, options.quick, output)
    recorded = read_json(options.recorded)
    changes, compared = compare(recorded, run.results)
    if options.json:
        print_json(run, changes, compared)
    else:
        print_tables(run, changes, compared)
    if options.record:
        recorded.merge(run.results)
        write_json(recorded, options.recorded)
    if run.failed:
        return 2
    return 1 if not options.record and any(change.worse for change in changes) else 0


def print_tables(run, changes, compared):
    tables = Tables(run.results, run.options.quick)
    for name in ("run", *run.options.studies):
        print(f"\n{name}\n")
        print("\n".join(tables.make(name)))
    print(f"\n{run.measured} points measured, {run.reused} taken from {run.store.path}, "
          f"{cpu_seconds():.0f} CPU s")
    print(f"compared with {compared} points of {run.options.recorded}:")
    for change in changes:
        print(f"  {change.text()}")
    if not changes:
        print("  nothing differs beyond noise")
    for title, entries in (("skipped", run.skipped), ("FAILED", run.failed)):
        for entry in entries:
            print(f"{title}: {entry['what']}: {entry['why']}")


def print_json(run, changes, compared):
    counts = {"measured": run.measured, "reused": run.reused, "compared": compared}
    counts["cpu_seconds"] = cpu_seconds()
    listed = [{**vars(change), "text": change.text()} for change in changes]
    lists = {"changes": listed, "skipped": run.skipped, "failed": run.failed}
    print(json.dumps({**counts, **lists}, indent=2))


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="accuracy", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("--studies", nargs="+", choices=studies.NAMES, metavar="STUDY",
        default=list(studies.NAMES), help="of: " + " ".join(studies.NAMES) + " (default all)")
    add("--light-field", nargs="+", metavar="NAME", default=[],
        help="of: chess antinous knights synth-cards synth-knights synth-glass synth-flat "
             "synth-noise (default all)")
    add("--quick", action="store_true", help="two small scenes, fewer points")
    add("--record", action="store_true",
        help="take the points into the recorded run, in place of comparing with it")
    add("--write-document", action="store_true",
        help="measure nothing: put the tables of the recorded run into the document, and its pictures "
             "beside it")
    add("--check-document", action="store_true",
        help="measure nothing: exit status 1 where the document's tables are not the recorded run's")
    add("--json", action="store_true", help="print counts, changes and what was skipped as JSON")
    add("-o", "--output", type=Path, default=ROOT / "out" / "accuracy", metavar="FOLDER",
        help="default out/accuracy")
    add("--recorded", type=Path, default=RECORDED, metavar="FILE",
        help="default bench/accuracy/recorded.json")
    add("--document", type=Path, default=DOCUMENT, metavar="FILE", help="default docs/accuracy.md")
    add("--hmlfc", type=Path, default=ROOT / "build" / "release" / "model" / "hmlfc",
        help="the program (default: that of ./run)")
    add("--bench", type=Path, default=ROOT / "build" / "release" / "bench" / "bench_accuracy",
        help="the program beside it (default: that of ./run)")
    return parser.parse_args()


def run_studies(options):
    for program in (options.hmlfc, options.bench):
        if not program.is_file():
            raise BenchError(f"no program {program}: ./run bench accuracy builds it")
    options.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=options.output) as work:
        run = Run(options, Path(work))
        run.measure()
        run.show("")
        return report(run)


def main():
    options = parse_arguments()
    try:
        if options.check_document:
            return check_document(options)
        if options.write_document:
            recorded = read_json(options.recorded)
            write_document(options.document, recorded)
            plots.draw(recorded, False, options.document.parent / "images", "accuracy_")
            return 0
        return run_studies(options)
    except BenchError as error:
        say(f"accuracy: {error}")
        return 2


if __name__ == "__main__":
    sys.exit(main())
