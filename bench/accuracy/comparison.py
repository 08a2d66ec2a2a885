"""Differences between a run and the recorded one."""

from dataclasses import dataclass
from statistics import median

# Which way is better: -1 less, 1 more. The same program gives the same values on every machine,
# but for the double-precision frames, in which compilers may round differently.
EXACT = {
    "bytes": -1,
    "psnr_rgb": 1,
    "psnr_y": 1,
    "ssim_y": 1,
    "max_abs_error": -1,
    "reference_bytes": -1,
    "mse.total": -1,
    "mse.fixed": -1,
    "blocks_decoded": -1,
}
EXACT_TOLERANCE = 2e-6  # of the value; recorded values have seven digits

MEMORY = ("encode_peak_bytes", "decode_peak_bytes")
MEMORY_NOISE = 1.15  # the number of threads at work varies

TIMES = {  # with the least that is compared: below it the clock and the cold start are what is seen
    "encode_cpu_seconds": 0.2,
    "decode_cpu_seconds": 0.05,
    "cpu_ms.median": 1.0,
}
# Points of one program on a machine under other load differed by up to 1.26 after the division.
TIME_NOISE = 1.35


@dataclass
class Change:
    """A value that differs from the recorded one beyond noise. ratio: new / old, of times after
    division by the calibrations."""

    what: str
    value: str
    old: float
    new: float
    ratio: float
    worse: bool

    def text(self):
        direction = "worse" if self.worse else "better"
        return f"{direction}: {self.what}: {self.value} {self.old:g} -> {self.new:g} (x {self.ratio:.3f})"


def compare(recorded, current):
    """(Changes, number of points that both runs have)."""
    pairs = [
        (recorded.points[identity], point)
        for identity, point in current.points.items()
        if identity in recorded.points
    ]
    noise = TIME_NOISE * _spread(old for old, _ in pairs) * _spread(new for _, new in pairs)
    return [change for old, new in pairs for change in _changes(old, new, noise)], len(pairs)


def _spread(points):
    """How much slower than usual the machine was in its worst moment."""
    seconds = [point.calibration_seconds for point in points]
    return max(seconds) / median(seconds) if seconds else 1


def _changes(old, new, time_noise):
    faster = old.calibration_seconds / new.calibration_seconds
    for value in sorted(old.values.keys() & new.values.keys()):
        a, b = old.number(value), new.number(value)
        ratio = b / a if a else float("inf")
        if value in EXACT and a != b and abs(b - a) > EXACT_TOLERANCE * abs(a):
            yield Change(new.label(), value, a, b, ratio, (b - a) * EXACT[value] < 0)
        elif value in MEMORY and not 1 / MEMORY_NOISE <= ratio <= MEMORY_NOISE:
            yield Change(new.label(), value, a, b, ratio, ratio > 1)
        elif value in TIMES and max(a, b) >= TIMES[value]:
            ratio *= faster
            if not 1 / time_noise <= ratio <= time_noise:
                yield Change(new.label(), value, a, b, ratio, ratio > 1)
