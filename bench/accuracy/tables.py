"""The tables of docs/accuracy.md, made from the points of a run."""

import math

import paper
import studies
from rates import bpp_at

PEAK = 255  # of 8-bit samples
MIB = 1 << 20


def table(head, rows):
    """Markdown lines. head: the names of the columns."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]


def db(value):
    return "inf" if math.isinf(value) else f"{value:.2f}"


def bpp(value):
    return "-" if value is None else f"{value:.3f}" if value >= 0.1 else f"{value:.4f}"


def psnr_of_mse(mse):
    return math.inf if mse <= 0 else 10 * math.log10(PEAK**2 / mse)


def _dropped(point):
    """Share of blocks without a residual, in per cent."""
    states = point.values["states"]
    without = states["zero"] + states["motion"]
    return 100 * without / sum(states.values())


def _states(point):
    """Shares of the blocks of all levels, in per cent."""
    states = point.values["states"]
    names = ("zero", "motion", "motion_residual", "residual")
    return ", ".join(f"{100 * states[name] / sum(states.values()):.1f}" for name in names)


class Tables:
    """All tables of the results of a full or a quick run; one of a study without points has no
    rows."""

    def __init__(self, results, quick):
        self.results, self.quick = results, quick

    def make(self, name):
        """The lines of a table: `run` or a study of studies.NAMES."""
        return getattr(self, name)()

    def _studies(self, scene):
        return studies.Studies(self.results.scenes[scene]["chroma"], self.quick)

    def _points(self, scene, codings):
        """The points of these codings that were measured."""
        found = (self.results.get(scene, coding) for coding in codings)
        return [point for point in found if point]

    def run(self):
        rows = []
        for name, scene in self.results.scenes.items():
            grid = f"{scene['rows']}x{scene['cols']}"
            size = f"{scene['width']}x{scene['height']}"
            frames = len(self.results.of_scene(name, frames=True))
            count = len(self.results.of_scene(name))
            rows.append((name, grid, size, scene["chroma"], f"{scene['at']:g}", count, frames))
        head = ("light field", "views", "pixels", "chroma of main", "dB to compare at")
        lines = table((*head, "encodings", "settings of frames"), rows)
        return [*lines, "", f"Processor: {self.results.machine}."]

    def encoder(self):
        """The points on the front of bits and error."""
        rows = []
        for scene in self.results.scenes:
            marks = self.results.fronts(scene)
            points = [p for p in self.results.of_scene(scene) if marks[p.identity][0]]
            first = {p.number("bytes"): p for p in reversed(points)}  # of equal streams
            for _, point in sorted(first.items()):
                rows.append((scene, point.coding.label(), *self._measures(point)))
        head = ("light field", "coding", "bpp", "PSNR RGB", "PSNR Y", "SSIM Y", "largest error")
        times = ("encode CPU s", "decode CPU s", "encode MiB", "decode MiB")
        return table((*head, *times, "index, motion, residual, top %"), rows)

    def _measures(self, point):
        n = point.number
        shares = [100 * n(f"sections.{s}") / n("bytes") for s in ("index", "motion", "residual", "top")]
        return (
            *(bpp(n("bpp")), db(n("psnr_rgb")), db(n("psnr_y")), f"{n('ssim_y'):.4f}"),
            *(f"{n('max_abs_error'):.0f}", f"{n('encode_cpu_seconds'):.2f}"),
            f"{n('decode_cpu_seconds'):.3f}",
            *(f"{n(name) / MIB:.0f}" for name in ("encode_peak_bytes", "decode_peak_bytes")),
            ", ".join(f"{share:.0f}" for share in shares),
        )

    def block_size(self):
        rows = []
        for scene in self.results.scenes:
            points = self._points(scene, self._studies(scene).block_size())
            if len(points) == len(studies.BLOCKS):
                cells = [f"{bpp(p.number('bpp'))} at {db(p.number('psnr_rgb'))}" for p in points]
                rows.append((scene, *cells))
        for name, figures in paper.BLOCK_SIZE.items():
            cells = [f"{bits:g} at {psnr:g}" for psnr, bits in figures.values()]
            rows.append((f"{name} (paper)", *cells))
        return table(("light field", *(f"block {b}: bpp at dB" for b in studies.BLOCKS)), rows)

    def window(self):
        rows = []
        windows = studies.QUICK["WINDOWS"] if self.quick else studies.WINDOWS
        for scene in self.results.scenes:
            points = self._points(scene, self._studies(scene).window())
            if len(points) != len(windows):
                continue
            rows.append((scene, "bpp", *(bpp(p.number("bpp")) for p in points)))
            rows.append((scene, "PSNR RGB", *(db(p.number("psnr_rgb")) for p in points)))
            dropped = [f"{_dropped(p):.1f} %" for p in points]
            rows.append((scene, "without residual", *dropped))
            seconds = [f"{p.number('encode_cpu_seconds'):.2f}" for p in points]
            rows.append((scene, "encode CPU s", *seconds))
        return table(("light field", "", *(f"window {w}" for w in windows)), rows)

    def threshold(self):
        rows = []
        thresholds = studies.QUICK["THRESHOLDS"] if self.quick else studies.THRESHOLDS
        for scene in self.results.scenes:
            for method in ("hmlfc", "rlfc"):
                points = self._points(scene, self._studies(scene).curve(method))
                if len(points) != len(thresholds):
                    continue
                cells = [f"{bpp(p.number('bpp'))} at {db(p.number('psnr_rgb'))}" for p in points]
                rows.append((scene, method, *cells))
        return table(("light field", "method", *(f"threshold {t}" for t in thresholds)), rows)

    def methods(self):
        rows = []
        for scene, facts in self.results.scenes.items():
            bits = [self._bpp_of(scene, method, facts["at"]) for method in studies.CURVES]
            if not any(bits):
                continue
            times = [b / bits[0] if b and bits[0] else None for b in bits[1:]]
            cells = ["-" if ratio is None else f"{ratio:.2f}" for ratio in times]
            rows.append((scene, f"{facts['at']:g}", *map(bpp, bits), *cells))
        ranges = [f"{low} to {high}" for low, high in paper.TIMES_OF_HMLFC.values()]
        rows.append(("paper's", "40 to 41", "", "", "", *ranges))
        head = ("light field", "dB", "hmlfc bpp", "rlfc bpp", "mc bpp")
        return table((*head, "rlfc / hmlfc", "mc / hmlfc"), rows)

    def prediction(self):
        """What a view is predicted from, without anything coded of it."""
        rows = []
        names = ("mean_2", "mean_4", "mean_8", "vectors")
        for scene, facts in self.results.scenes.items():
            if found := facts.get("prediction"):
                rows.append((scene, *(db(found[name]) if name in found else "-" for name in names)))
        means = [f"mean of {side}, dB" for side in ("2x2", "4x4", "8x8")]
        return table(("light field", *means, "a view with vectors, dB"), rows)

    def sections(self):
        """Where the bits of the methods go at the paper's threshold, and what blocks have."""
        rows = []
        names = ("index", "motion", "residual", "top")
        for scene, facts in self.results.scenes.items():
            pixels = facts["rows"] * facts["cols"] * facts["width"] * facts["height"]
            own = self._studies(scene)
            for point in self._points(scene, [own.main(method=m) for m in studies.CURVES]):
                bits = [bpp(8 * point.number(f"sections.{name}") / pixels) for name in names]
                cells = (scene, point.coding.method, db(point.number("psnr_rgb")), *bits)
                rows.append((*cells, _states(point)))
        head = ("light field", "method", "PSNR RGB", *(f"{name}, bpp" for name in names))
        return table((*head, "blocks with nothing, motion, both, residual, %"), rows)

    def _bpp_of(self, scene, method, psnr):
        points = self._points(scene, self._studies(scene).curve(method))
        return bpp_at([(p.number("psnr_rgb"), p.number("bpp")) for p in points], psnr)

    def reference_memory(self):
        rows = []
        for scene, facts in self.results.scenes.items():
            pixels = facts["rows"] * facts["cols"] * facts["width"] * facts["height"]
            own = self._studies(scene)
            for point in self._points(scene, dict.fromkeys(own.reference_memory())):
                kib = point.number("reference_bytes") / 1024
                share = 100 * 1024 * kib / (3 * pixels)
                shape = (point.coding.height, point.coding.references)
                quality = (bpp(point.number("bpp")), db(point.number("psnr_rgb")))
                rows.append((scene, *shape, f"{kib:.0f}", f"{share:.2f} %", *quality))
        head = ("light field", "height", "references", "KiB", "of the views", "bpp", "PSNR RGB")
        return table(head, rows)

    def renderer(self):
        rows = []
        for scene in self.results.scenes:
            for point in self.results.of_scene(scene, frames=True):
                rows.append((scene, point.coding.profile, *self._frame_row(point)))
        causes = ("all", "stream", "filter", "fixed point")
        head = ("light field", "profile", "filter", "levels", "cache MiB", "backend")
        times = ("CPU ms, median", "95 %", "blocks needed", "decoded")
        errors = [f"dB: {cause}" for cause in causes]
        return table((*head, *times, *errors, "largest of fixed point (bound)"), rows)

    def _frame_row(self, point):
        n = point.number
        errors = [db(psnr_of_mse(n(f"mse.{cause}"))) for cause in ("total", "stream", "filter", "fixed")]
        bound = point.values.get("bound_fixed")
        largest = f"{n('largest_fixed'):.2f}" + (f" ({bound:.2f})" if bound else "")
        return (
            *point.frame.split(":"),
            *(f"{n('cpu_ms.median'):.2f}", f"{n('cpu_ms.p95'):.2f}"),
            *(f"{n('blocks_needed'):.0f}", f"{n('blocks_decoded'):.0f}"),
            *errors,
            largest,
        )


NAMES = ("run", *studies.NAMES, "sections")
