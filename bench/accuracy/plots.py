"""The pictures of the accuracy report."""

import math

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402

import studies  # noqa: E402
from tables import psnr_of_mse  # noqa: E402

COLOURS = {
    "hmlfc": "#ff7f0e",
    "rlfc": "#e0a458",
    "mc": "#8c564b",
    "fast": "#1f77b4",
    "medium": "#d62728",
    "slow": "#2ca02c",
    "nearest": "#7f7f7f",
    "bilinear": "#1f77b4",
    "quadrilinear": "#d62728",
}
COLUMNS = 4  # panels beside each other
BACKENDS = {"cpu": "o", "golden": "s", "gpu": "^"}


def draw(results, quick, folder, prefix=""):
    """Writes PREFIXSTUDY.png for every study that has points."""
    folder.mkdir(parents=True, exist_ok=True)
    drawn = Plots(results, quick)
    for name in studies.DRAWN:
        figure = getattr(drawn, name)()
        if figure is not None:
            figure.savefig(folder / f"{prefix}{name}.png", dpi=100)
            pyplot.close(figure)


class Plots:
    """A figure of each study, or None where it has no points."""

    def __init__(self, results, quick):
        self.results, self.quick = results, quick

    def encoder(self):
        """Above bits against PSNR, below CPU time of encoding; points on the fronts have a ring."""
        kinds = {}

        def panel_of(panels, scene):
            points = [p for p in self.results.of_scene(scene) if _psnr(p) < math.inf]
            marks = self.results.fronts(scene)
            for row, name in enumerate(("bpp", "encode_cpu_seconds")):
                front = [p for p in points if marks[p.identity][row]]
                _scatter(panels[row], front, name, s=90, facecolors="none", edgecolors="black",
                         linewidths=0.8)
                for kind in dict.fromkeys(map(_kind, points)):
                    own = [p for p in points if _kind(p) == kind]
                    _scatter(panels[row], own, name, s=22, color=COLOURS[kind])
                    profile = "main" if kind in studies.CURVES else "extended"
                    kinds[f"{profile} {kind}"] = {"color": COLOURS[kind]}

        labels = ("bits a pixel", "CPU s of encoding")
        return self._figure(self.results.of_scene, panel_of, labels, "PSNR RGB, dB", kinds)

    def block_size(self):
        return self._curves(lambda own: {"hmlfc": own.block_size()}, "block")

    def window(self):
        """Bits and PSNR against the window, as in the paper's figure."""
        curves = {scene: self.results.found(scene, self._studies(scene).window())
                  for scene in self.results.scenes}
        if not any(curves.values()):
            return None
        figure, panels = pyplot.subplots(1, 2, figsize=(11, 4.5))
        for scene, points in curves.items():
            if points:
                windows = [p.coding.window for p in points]
                panels[0].plot(windows, [_bpp(p) / _bpp(points[0]) for p in points], "o-", label=scene)
                panels[1].plot(windows, [_psnr(p) - _psnr(points[0]) for p in points], "o-")
        for panel, label in zip(panels, ("bits, window 1 = 1", "PSNR RGB over window 1, dB")):
            _logarithmic(panel, "window", base=2)
            panel.set_ylabel(label)
            panel.grid(True, color="#e4e4e4")
        panels[0].legend(fontsize=8)
        figure.tight_layout()
        return figure

    def threshold(self):
        return self._curves(lambda own: {m: own.curve(m) for m in ("hmlfc", "rlfc")}, "threshold")

    def methods(self):
        return self._curves(lambda own: {m: own.curve(m) for m in studies.CURVES})

    def reference_memory(self):
        """Bits against memory, from few reference images to many and from low trees to high."""

        def panel_of(panels, scene):
            own = self._studies(scene)
            for kind, codings, field in (("hmlfc", own.by_references(), "references"),
                                         ("mc", own.by_height(), "height")):
                points = self.results.found(scene, codings)
                memory = [max(p.number("reference_bytes") / 1024, 1) for p in points]
                _line(panels[0], points, memory, list(map(_bpp, points)), kind, f"by {field}", field)

        wanted = self._measured(lambda own: own.reference_memory())
        labels = ["KiB of decoded reference images"]
        return self._figure(wanted, panel_of, labels, "bits a pixel")

    def renderer(self):
        """CPU time of a frame against its error."""

        def frames(scene):
            return self.results.of_scene(scene, frames=True)

        def panel_of(panels, scene):
            for point in frames(scene):
                kind, _, _, backend = point.frame.split(":")
                filled = COLOURS[kind] if point.coding.profile == "extended" else "none"
                panels[0].scatter(point.number("cpu_ms.median"), psnr_of_mse(point.number("mse.total")),
                                  marker=BACKENDS[backend], facecolors=filled, edgecolors=COLOURS[kind])

        legend = {kind: {"color": COLOURS[kind]} for kind in studies.FILTERS}
        legend |= {name: {"color": "black", "marker": marker} for name, marker in BACKENDS.items()}
        legend["profile main"] = {"facecolors": "none", "edgecolors": "black"}
        return self._figure(frames, panel_of, ["CPU ms a frame, median"], "PSNR RGB, dB", legend)

    def _curves(self, curves, annotated=None):
        """Bits against PSNR, a panel for each light field, a line for each curve. annotated: the
        field of the coding that is written at each point."""

        def panel_of(panels, scene):
            for kind, codings in curves(self._studies(scene)).items():
                points = [p for p in self.results.found(scene, codings) if _psnr(p) < math.inf]
                x, y = list(map(_bpp, points)), list(map(_psnr, points))
                _line(panels[0], points, x, y, kind, kind, annotated)

        wanted = self._measured(lambda own: [c for codings in curves(own).values() for c in codings])
        return self._figure(wanted, panel_of, ["bits a pixel"], "PSNR RGB, dB")

    def _figure(self, wanted, panel_of, xlabels, ylabel, legend=None):
        """A figure with a row of panels for each of `xlabels` and a column for each light field that
        is wanted; panel_of(panels of a column, light field) draws. legend: {label: style}."""
        scenes = list(filter(wanted, self.results.scenes))
        if not scenes:
            return None
        figure, rows = _panels(len(xlabels), scenes)
        for column, scene in enumerate(scenes):
            rows[0][column].set_title(scene)
            panel_of([row[column] for row in rows], scene)
            for row, label in zip(rows, xlabels):
                _logarithmic(row[column], label)
        for label, style in (legend or {}).items():
            rows[0][0].scatter([], [], label=label, **style)
        return _finish(figure, rows, ylabel)

    def _studies(self, scene):
        return studies.Studies(self.results.scenes[scene]["chroma"], self.quick)

    def _measured(self, codings):
        return lambda scene: self.results.found(scene, codings(self._studies(scene)))


def _bpp(point):
    return point.number("bpp")


def _psnr(point):
    return point.number("psnr_rgb")


def _kind(point):
    return point.coding.preset or point.coding.method


def _scatter(panel, points, name, **style):
    panel.scatter([p.number(name) for p in points], list(map(_psnr, points)), **style)


def _line(panel, points, x, y, kind, label, annotated):
    """annotated: the field of the coding that is written at each point, or None."""
    panel.plot(x, y, "o-", color=COLOURS[kind], label=label)
    for point, *place in zip(points, x, y) if annotated else ():
        panel.annotate(str(getattr(point.coding, annotated)), place, textcoords="offset points",
                       xytext=(4, -9), fontsize=7)


def _logarithmic(panel, label, base=10):
    """A logarithmic axis with plain numbers."""
    panel.set_xscale("log", base=base)
    panel.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    if base == 10:
        panel.xaxis.set_minor_formatter(ticker.LogFormatter(minor_thresholds=(1, 0.3)))
        panel.tick_params(axis="x", which="minor", labelsize=7)
    panel.set_xlabel(label)


def _panels(rows, scenes):
    """(figure, panels by row and light field): COLUMNS light fields beside each other, each with
    its rows below each other."""
    columns = min(COLUMNS, len(scenes))
    groups = -(-len(scenes) // columns)
    size = (3.6 * columns + 1, 3.6 * rows * groups + 0.8)
    figure, grid = pyplot.subplots(groups * rows, columns, figsize=size, squeeze=False)
    places = [divmod(k, columns) for k in range(groups * columns)]
    panels = [[grid[group * rows + row][column] for group, column in places] for row in range(rows)]
    for row in panels:
        for panel in row[len(scenes) :]:
            panel.set_visible(False)
    return figure, [row[: len(scenes)] for row in panels]


def _finish(figure, panels, label):
    """Grids and one legend below."""
    for row in panels:
        for number, panel in enumerate(row):
            if number % COLUMNS == 0:
                panel.set_ylabel(label)
            panel.ticklabel_format(axis="y", useOffset=False)
            panel.grid(True, which="both", color="#e4e4e4")
            panel.set_axisbelow(True)
    handles, labels = panels[0][0].get_legend_handles_labels()
    columns = 2 * min(COLUMNS, len(panels[0]))
    lines = -(-len(labels) // columns)
    figure.tight_layout(rect=(0, (0.3 + 0.25 * lines) / figure.get_figheight(), 1, 1))
    figure.legend(handles, labels, loc="lower center", ncol=columns, frameon=False)
    return figure
