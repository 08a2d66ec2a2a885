"""One point of the accuracy report: a light field encoded and decoded, or frames drawn of it."""

import hashlib
import json
import time
import zlib

import studies
from process import BenchError, run, run_measured
from similarity import Similarity

# Fixed work whose CPU time measures the current speed of the machine: 1 MiB of hexadecimal digits.
WORK = "".join(hashlib.sha256(bytes([k % 256, k // 256])).hexdigest() for k in range(16384)).encode()
WORK_RUNS = 3
DECODE_RUNS = 3
FRAMES = {False: (24, 256), True: (12, 64)}  # quick: number, pixels along a side


class Measure:
    """Measures one light field with the programs hmlfc and bench_accuracy in the folder `work`."""

    def __init__(self, programs, work, scene):
        self.hmlfc, self.bench = programs
        self.work, self.scene = work, scene
        self._similarity = None

    def coding(self, coding):
        """Encodes and decodes: a dict of what docs/accuracy.md explains."""
        stream = self.work / "stream.hmlfc"
        report, peak_bytes = self._encode(coding, stream)
        if self._similarity is None:
            self._similarity = Similarity(self.scene.folder)
        views = [f"{row},{col}" for row, col in self._similarity.views]
        folder = self.work / "decoded"
        folder.mkdir(exist_ok=True)
        command = [self.bench, "decode", stream, DECODE_RUNS, folder, *views]
        said, decoding = run_measured(command)
        decoded = json.loads(said)
        point = {
            **{name: report[name] for name in ("bytes", "bpp", "psnr_rgb", "psnr_y", "max_abs_error")},
            "ssim_y": self._similarity.mean(folder),
            **grouped("sections", report["sections"]),
            **grouped("states", self._info(stream)["states"]),
            "encode_cpu_seconds": report["cpu_seconds"],
            "encode_peak_bytes": peak_bytes,
            "decode_cpu_seconds": decoded["cpu_seconds"],
            "decode_peak_bytes": decoding.peak_bytes,
            "reference_bytes": decoded["reference_bytes"],
        }
        stream.unlink()
        return point

    def levels(self, coding):
        """Levels of the tree of the stream that `frames` draws from."""
        return self._info(self._frame_stream(coding))["tree_height"] + 1

    def frames(self, coding, settings, quick):
        """Draws frames with each setting: {setting: a dict}; one that cannot be drawn here has
        `skipped`, the reason."""
        number, side = FRAMES[quick]
        command = [self.bench, "frames", self._frame_stream(coding), self._lossless()]
        said, _ = run([*command, number, side, *settings])
        return {row.pop("setting"): row for row in json.loads(said)}

    def close(self):
        """Removes the files that frames were drawn from."""
        for path in self.work.glob("*.hmlfc"):
            path.unlink()

    def _encode(self, coding, stream):
        command = [self.hmlfc, "encode", self.scene.folder, "-o", stream, "--no-rig", "--json"]
        said, cost = run_measured([*command, *coding.options()])
        report = json.loads(said)
        if (report["rows"], report["cols"]) != (self.scene.rows, self.scene.cols):
            raise BenchError(f"hmlfc sees {report['rows']}x{report['cols']} views")
        return report, cost.peak_bytes

    def _info(self, stream):
        return json.loads(run([self.hmlfc, "info", stream, "--json"])[0])

    def _frame_stream(self, coding):
        stream = self.work / f"frames-{coding.profile}.hmlfc"
        if not stream.exists():
            self._encode(coding, stream)
        return stream

    def _lossless(self):
        """A stream that decodes to the source."""
        stream = self.work / "lossless.hmlfc"
        if not stream.exists():
            report, _ = self._encode(studies.coding.lossless(), stream)
            if report["max_abs_error"] != 0:
                raise BenchError(f"{self.scene.name}: --lossless has lost something")
        return stream


def grouped(group, values):
    return {f"{group}.{name}": value for name, value in values.items()}


def calibration_seconds():
    """CPU seconds of compressing WORK: the least of WORK_RUNS."""
    seconds = []
    for _ in range(WORK_RUNS):
        begin = time.process_time()
        zlib.compress(WORK, 6)
        seconds.append(time.process_time() - begin)
    return min(seconds)
