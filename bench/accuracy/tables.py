"""The tables of docs/results/accuracy.md, made from the points of a run."""

import math

import studies
from light_field import bpp_at
from result_file import table

PEAK = 255  # of 8-bit samples
MIB = 1 << 20
SECTIONS = ("index", "motion", "residual", "top")
STATES = ("zero", "motion", "motion_residual", "residual")
PREDICTIONS = ("mean_2", "mean_4", "mean_8", "vectors")

# Figures of Pratapa and Manocha's paper, for tables beside the measured ones.
# Block size: {light field: {block: (PSNR in dB, bits a pixel)}}, thresholds 75, window 16, height 3.
PAPER_BLOCK_SIZE = {
    "Amethyst": {2: (38.7, 0.0592), 4: (43.69, 0.106), 8: (48.35, 0.707)},
    "Bunny": {2: (40.52, 0.0173), 4: (43.35, 0.0411), 8: (47.52, 0.548)},
    "Bracelet": {2: (37.03, 0.033), 4: (44.15, 0.35), 8: (48.79, 1.108)},
    "Lego Knights": {2: (38.27, 0.096), 4: (43.046, 0.243), 8: (47.89, 1.15)},
}

# How many times the bits of HMLFC the other methods take at similar PSNR, over its light fields.
PAPER_TIMES_OF_HMLFC = {"rlfc": (2, 5), "mc": (2, 3)}


def db(value):
    return "inf" if math.isinf(value) else f"{value:.2f}"


def bpp(value):
    return "-" if value is None else f"{value:.3f}" if value >= 0.1 else f"{value:.4f}"


def psnr_of_mse(mse):
    return math.inf if mse <= 0 else 10 * math.log10(PEAK**2 / mse)


def rate(point):
    return f"{bpp(point.number('bpp'))} at {db(point.number('psnr_rgb'))}"


def states(point):
    """Shares of the blocks of all levels by state, in per cent."""
    counts = [point.number(f"states.{name}") for name in STATES]
    return [100 * count / sum(counts) for count in counts]


def listed(form, values):
    return ", ".join(form.format(value) for value in values)


class Tables:
    """All tables of the results of a full or a quick run; one of a study without points has no
    rows."""

    def __init__(self, results, quick):
        self.results, self.quick = results, quick

    def make(self, name):
        """The lines of a table of TITLES."""
        return getattr(self, name)()

    def all(self):
        """Pairs (what a table shows, its lines)."""
        return [(title, self.make(name)) for name, title in TITLES.items()]

    def _own(self):
        """Pairs (light field, its studies)."""
        for name, facts in self.results.scenes.items():
            yield name, studies.Studies(facts["chroma"], self.quick)

    def _values(self, name):
        return studies.Studies("", self.quick).values(name)

    def _complete(self, scene, codings):
        """The points of these codings where all were measured, or none."""
        found = self.results.found(scene, codings)
        return found if len(found) == len(codings) else []

    def run(self):
        rows = []
        for name, scene in self.results.scenes.items():
            counts = [len(self.results.of_scene(name, frames)) for frames in (False, True)]
            views, size = (f"{scene[a]}x{scene[b]}" for a, b in (("rows", "cols"), ("width", "height")))
            rows.append((name, views, size, scene["chroma"], f"{scene['at']:g}", *counts))
        head = ("light field", "views", "pixels", "chroma of main", "dB to compare at")
        lines = table((*head, "encodings", "settings of frames"), rows)
        return [*lines, "", f"Processor: {self.results.machine}."]

    def encoder(self):
        rows = []
        for scene, own in self._own():
            for point in self.results.found(scene, own.compared()):
                rows.append((scene, point.coding.label(), *self._measures(point)))
        head = ("light field", "coding", "bpp", "PSNR RGB", "PSNR Y", "SSIM Y", "largest error")
        times = ("encode CPU s", "decode CPU s", "encode MiB", "decode MiB")
        return table((*head, *times, "index, motion, residual, top %"), rows)

    def _measures(self, point):
        n = point.number
        return (
            *(bpp(n("bpp")), db(n("psnr_rgb")), db(n("psnr_y")), f"{n('ssim_y'):.4f}"),
            *(f"{n('max_abs_error'):.0f}", f"{n('encode_cpu_seconds'):.2f}"),
            f"{n('decode_cpu_seconds'):.3f}",
            *(f"{n(name) / MIB:.0f}" for name in ("encode_peak_bytes", "decode_peak_bytes")),
            listed("{:.0f}", (100 * n(f"sections.{name}") / n("bytes") for name in SECTIONS)),
        )

    def block_size(self):
        rows = []
        for scene, own in self._own():
            if points := self._complete(scene, own.block_size()):
                rows.append((scene, *map(rate, points)))
        for name, figures in PAPER_BLOCK_SIZE.items():
            rows.append((f"{name} (paper)", *(f"{bits:g} at {psnr:g}" for psnr, bits in figures.values())))
        return table(("light field", *(f"block {b}: bpp at dB" for b in studies.BLOCKS)), rows)

    def window(self):
        rows = []
        for scene, own in self._own():
            if points := self._complete(scene, own.window()):
                rows.append((scene, "bpp at dB", *map(rate, points)))
                dropped = [f"{sum(states(p)[:2]):.1f} %" for p in points]
                rows.append((scene, "blocks without residual", *dropped))
                seconds = [f"{p.number('encode_cpu_seconds'):.2f}" for p in points]
                rows.append((scene, "encode CPU s", *seconds))
        return table(("light field", "", *(f"window {w}" for w in self._values("WINDOWS"))), rows)

    def threshold(self):
        rows = []
        for scene, own in self._own():
            for method in studies.CURVES:
                if points := self._complete(scene, own.curve(method)):
                    rows.append((scene, method, *map(rate, points)))
        thresholds = [f"threshold {t}: bpp at dB" for t in self._values("THRESHOLDS")]
        return table(("light field", "method", *thresholds), rows)

    def methods(self):
        rows = []
        for scene, own in self._own():
            at = self.results.scenes[scene]["at"]
            curves = [own.preset("medium"), *map(own.curve, studies.CURVES)]
            bits = [self._bpp_at(scene, curve, at) for curve in curves]
            if any(bits):
                times = [f"{b / bits[1]:.2f}" if b and bits[1] else "-" for b in bits[2:]]
                rows.append((scene, f"{at:g}", *map(bpp, bits), *times))
        ranges = [f"{low} to {high}" for low, high in PAPER_TIMES_OF_HMLFC.values()]
        rows.append(("paper's", "40 to 41", "", "", "", "", *ranges))
        head = ("light field", "dB", "extended bpp", "hmlfc bpp", "rlfc bpp", "mc bpp")
        return table((*head, "rlfc / hmlfc", "mc / hmlfc"), rows)

    def _bpp_at(self, scene, codings, psnr):
        points = self.results.found(scene, codings)
        return bpp_at([(p.number("psnr_rgb"), p.number("bpp")) for p in points], psnr)

    def prediction(self):
        rows = []
        for scene, facts in self.results.scenes.items():
            if found := facts.get("prediction"):
                rows.append((scene, *(db(found[n]) if n in found else "-" for n in PREDICTIONS)))
        means = [f"mean of {side}, dB" for side in ("2x2", "4x4", "8x8")]
        return table(("light field", *means, "a view with vectors, dB"), rows)

    def sections(self):
        rows = []
        for scene, own in self._own():
            pixels = self.results.pixels(scene)
            for point in self.results.found(scene, [own.main(method=m) for m in studies.CURVES]):
                bits = [bpp(8 * point.number(f"sections.{name}") / pixels) for name in SECTIONS]
                cells = (scene, point.coding.method, db(point.number("psnr_rgb")), *bits)
                rows.append((*cells, listed("{:.1f}", states(point))))
        head = ("light field", "method", "PSNR RGB", *(f"{name}, bpp" for name in SECTIONS))
        return table((*head, "blocks with nothing, motion, both, residual, %"), rows)

    def reference_memory(self):
        rows = []
        for scene, own in self._own():
            for point in self.results.found(scene, dict.fromkeys(own.reference_memory())):
                held = point.number("reference_bytes")
                share = 100 * held / (3 * self.results.pixels(scene))
                shape = (point.coding.height, point.coding.references)
                rows.append((scene, *shape, f"{held / 1024:.0f}", f"{share:.2f} %", rate(point)))
        return table(("light field", "height", "references", "KiB", "of the views", "bpp at dB"), rows)

    def renderer(self):
        rows = []
        for scene in self.results.scenes:
            points = self.results.of_scene(scene, frames=True)
            for coding in dict.fromkeys(point.coding for point in points):
                own = {tuple(p.frame.split(":")): p for p in points if p.coding == coding}
                rows.append((scene, coding.profile, *self._frame_cells(own)))
        head = ("light field", "profile", "CPU ms: 256 MiB", "95th percentile", "no cache", "golden", "gpu")
        blocks = ("blocks needed", "decoded with 1 MiB", "with 256 MiB")
        filters = ", ".join(studies.FILTERS)
        errors = (f"dB: {filters}", "by levels", "stream", "filter", "fixed point", "largest (bound)")
        return table((*head, *blocks, *errors), rows)

    def _frame_cells(self, own):
        """own: points by (filter, levels, cache, backend)."""
        whole, levels = str(studies.WHOLE_CACHE), max(int(setting[1]) for setting in own)

        def values(name, form, *settings):
            found = (own.get((s[0], str(s[1]), *s[2:])) for s in settings)
            return ", ".join(form(point.number(name)) if point else "-" for point in found)

        def error(mse):
            return db(psnr_of_mse(mse))

        best, filters = "quadrilinear", [(name, levels, whole, "cpu") for name in studies.FILTERS]
        yield values("cpu_ms.median", "{:.2f}".format, filters[-1])
        yield values("cpu_ms.p95", "{:.2f}".format, filters[-1])
        for backend in ("cpu", "golden", "gpu"):
            yield values("cpu_ms.median", "{:.2f}".format, (best, levels, "0", backend))
        for cache in ("0", "1", whole):
            yield values("blocks_decoded", "{:.0f}".format, (best, levels, cache, "cpu"))
        yield values("mse.total", error, *filters)
        steps = [(best, k, whole, "cpu") for k in range(1, levels + 1)]
        yield values("mse.total", error, *steps)
        yield values("mse.stream", error, filters[-1])
        yield values("mse.filter", error, *filters[:2])
        yield values("mse.fixed", error, filters[-1])
        bound = values("bound_fixed", "{:.2f}".format, filters[-1])
        yield f"{values('largest_fixed', '{:.2f}'.format, filters[-1])} ({bound})"


TITLES = {
    "run": "Light fields",
    "encoder": "Presets at quality 60, methods of profile main at thresholds 75",
    "methods": "Bits a pixel at equal PSNR, log(bpp) linear in PSNR between the points",
    "block_size": "Block size: thresholds 75, window 16, height 3",
    "window": "Window: blocks of 4, height 3, thresholds 75",
    "threshold": "Thresholds: blocks of 4, height 3, window 16",
    "sections": "Sections of the file and states of blocks at thresholds 75",
    "prediction": "What a view is predicted from before anything of it is coded: PSNR of luma",
    "reference_memory": "Memory of decoded reference images, thresholds 75",
    "renderer": "Frames: CPU time of filter quadrilinear, PSNR by filter, level and cause",
}
