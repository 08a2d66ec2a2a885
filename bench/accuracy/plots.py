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
        scenes = self._scenes(lambda name: bool(self.results.of_scene(name)))
        if not scenes:
            return None
        figure, panels = _panels(2, scenes)
        for column, scene in enumerate(scenes):
            points = [p for p in self.results.of_scene(scene) if _psnr(p) < math.inf]
            marks = self.results.fronts(scene)
            for row, name in enumerate(("bpp", "encode_cpu_seconds")):
                panel = panels[row][column]
                front = [p for p in points if marks[p.identity][row]]
                panel.scatter([p.number(name) for p in front], list(map(_psnr, front)), s=90,
                              facecolors="none", edgecolors="black", linewidths=0.8)
                for kind, group in _by(points, _kind):
                    panel.scatter([p.number(name) for p in group], list(map(_psnr, group)), s=22,
                                  color=COLOURS[kind])
                _logarithmic(panel)
            panels[1][column].set_xlabel("CPU s of encoding")
            panels[0][column].set_xlabel("bits a pixel")
        for kind in dict.fromkeys(_kind(p) for scene in scenes for p in self.results.of_scene(scene)):
            profile = "main" if kind in studies.CURVES else "extended"
            panels[0][0].scatter([], [], color=COLOURS[kind], label=f"{profile} {kind}")
        return _finish(figure, panels, scenes, "PSNR RGB, dB")

    def block_size(self):
        return self._curves(lambda own: {"hmlfc": own.block_size()}, "block")

    def window(self):
        """Bits and PSNR against the window, as in the paper's figure."""
        scenes = self._scenes(lambda name: self._points(name, self._studies(name).window()))
        if not scenes:
            return None
        figure, panels = pyplot.subplots(1, 2, figsize=(11, 4.5))
        for scene in scenes:
            points = self._points(scene, self._studies(scene).window())
            windows = [p.coding.window for p in points]
            panels[0].plot(windows, [_bpp(p) / _bpp(points[0]) for p in points], "o-", label=scene)
            panels[1].plot(windows, [_psnr(p) - _psnr(points[0]) for p in points], "o-")
        for panel, label in zip(panels, ("bits, window 1 = 1", "PSNR RGB over window 1, dB")):
            panel.set_xscale("log", base=2)
            panel.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
            panel.set_xlabel("window")
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
        scenes = self._scenes(lambda name: self._points(name, self._studies(name).reference_memory()))
        if not scenes:
            return None
        figure, panels = _panels(1, scenes)
        for panel, scene in zip(panels[0], scenes):
            own = self._studies(scene)
            for kind, codings, field in (("hmlfc", own.by_references(), "references"),
                                         ("mc", own.by_height(), "height")):
                points = self._points(scene, codings)
                memory = [max(p.number("reference_bytes") / 1024, 1) for p in points]
                panel.plot(memory, list(map(_bpp, points)), "o-", color=COLOURS[kind],
                           label=f"by {field}")
                for point, place in zip(points, memory):
                    _annotate(panel, getattr(point.coding, field), (place, _bpp(point)))
            _logarithmic(panel)
            panel.set_xlabel("KiB of decoded reference images")
        return _finish(figure, panels, scenes, "bits a pixel")

    def renderer(self):
        """CPU time of a frame against its error."""
        scenes = self._scenes(lambda name: bool(self.results.of_scene(name, frames=True)))
        if not scenes:
            return None
        figure, panels = _panels(1, scenes)
        for panel, scene in zip(panels[0], scenes):
            for point in self.results.of_scene(scene, frames=True):
                kind, _, _, backend = point.frame.split(":")
                filled = COLOURS[kind] if point.coding.profile == "extended" else "none"
                panel.scatter(point.number("cpu_ms.median"),
                              psnr_of_mse(point.number("mse.total")), marker=BACKENDS[backend],
                              facecolors=filled, edgecolors=COLOURS[kind])
            _logarithmic(panel)
            panel.set_xlabel("CPU ms a frame, median")
        for kind in studies.FILTERS:
            panels[0][0].scatter([], [], color=COLOURS[kind], label=kind)
        for backend, marker in BACKENDS.items():
            panels[0][0].scatter([], [], color="black", marker=marker, label=backend)
        panels[0][0].scatter([], [], facecolors="none", edgecolors="black", label="profile main")
        return _finish(figure, panels, scenes, "PSNR RGB, dB")

    def _curves(self, curves, annotated=None):
        """Bits against PSNR, a panel for each light field, a line for each curve. annotated: the
        field of the coding that is written at each point."""
        scenes = self._scenes(
            lambda name: any(self._points(name, c) for c in curves(self._studies(name)).values())
        )
        if not scenes:
            return None
        figure, panels = _panels(1, scenes)
        for panel, scene in zip(panels[0], scenes):
            for kind, codings in curves(self._studies(scene)).items():
                points = [p for p in self._points(scene, codings) if _psnr(p) < math.inf]
                panel.plot(list(map(_bpp, points)), list(map(_psnr, points)), "o-",
                           color=COLOURS[kind], label=kind)
                for point in points if annotated else ():
                    place = (_bpp(point), _psnr(point))
                    _annotate(panel, getattr(point.coding, annotated), place)
            _logarithmic(panel)
            panel.set_xlabel("bits a pixel")
        return _finish(figure, panels, scenes, "PSNR RGB, dB")

    def _studies(self, scene):
        return studies.Studies(self.results.scenes[scene]["chroma"], self.quick)

    def _points(self, scene, codings):
        return [p for p in (self.results.get(scene, coding) for coding in codings) if p]

    def _scenes(self, wanted):
        return [name for name in self.results.scenes if wanted(name)]


def _bpp(point):
    return point.number("bpp")


def _psnr(point):
    return point.number("psnr_rgb")


def _kind(point):
    return point.coding.preset or point.coding.method


def _by(points, kind):
    """Pairs (kind, its points), in the order of COLOURS."""
    return [(k, [p for p in points if kind(p) == k]) for k in COLOURS if any(kind(p) == k for p in points)]


def _annotate(panel, text, place):
    panel.annotate(
        str(text), place, textcoords="offset points", xytext=(4, -9), fontsize=7
    )


def _logarithmic(panel):
    """A logarithmic axis with plain numbers."""
    panel.set_xscale("log")
    panel.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    panel.xaxis.set_minor_formatter(ticker.LogFormatter(minor_thresholds=(1, 0.3)))
    panel.tick_params(axis="x", which="minor", labelsize=7)


def _panels(rows, scenes):
    """(figure, panels by row and light field): COLUMNS light fields beside each other, each with
    its rows below each other."""
    columns = min(COLUMNS, len(scenes))
    groups = -(-len(scenes) // columns)
    figure, grid = pyplot.subplots(
        groups * rows,
        columns,
        figsize=(3.6 * columns + 1, 3.6 * rows * groups + 0.8),
        squeeze=False,
    )
    places = [divmod(k, columns) for k in range(groups * columns)]
    for row in range(rows):
        for group, column in places[len(scenes) :]:
            grid[group * rows + row][column].set_visible(False)
    panels = [
        [grid[group * rows + row][column] for group, column in places[: len(scenes)]]
        for row in range(rows)
    ]
    return figure, panels


def _finish(figure, panels, scenes, label):
    """Titles, grids and one legend below."""
    for panel, scene in zip(panels[0], scenes):
        panel.set_title(scene)
    for row in panels:
        for number, panel in enumerate(row):
            if number % COLUMNS == 0:
                panel.set_ylabel(label)
            panel.ticklabel_format(axis="y", useOffset=False)
            panel.grid(True, which="both", color="#e4e4e4")
            panel.set_axisbelow(True)
    handles, labels = panels[0][0].get_legend_handles_labels()
    columns = 2 * min(COLUMNS, len(scenes))
    lines = -(-len(labels) // columns)
    figure.tight_layout(rect=(0, (0.3 + 0.25 * lines) / figure.get_figheight(), 1, 1))
    figure.legend(handles, labels, loc="lower center", ncol=columns, frameon=False)
    return figure
