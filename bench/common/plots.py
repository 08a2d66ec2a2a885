"""Pictures of results: a grid of panels with curves."""

from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


@dataclass
class Curve:
    """Points, in their order. style: of matplotlib."""

    label: str
    x: list
    y: list
    style: str = "o-"


@dataclass
class Panel:
    title: str
    curves: list
    x: str  # what the axis shows
    y: str
    logarithmic: str = "x"  # these axes are


def draw(path, panels, across):
    """Writes a picture of the panels, `across` of them next to each other. A label has one colour in all panels."""
    path.parent.mkdir(parents=True, exist_ok=True)
    down = -(-len(panels) // across)
    figure, grid = pyplot.subplots(down, across, squeeze=False, figsize=(3.6 * across + 1, 3.4 * down + 0.8))
    colours, lines = {}, {}
    for axes in grid.flat[len(panels):]:
        axes.set_visible(False)
    for axes, panel in zip(grid.flat, panels):
        axes.set(title=panel.title, xlabel=panel.x, ylabel=panel.y)
        axes.grid(True, which="both", color="#e4e4e4")
        for name in panel.logarithmic:
            getattr(axes, f"set_{name}scale")("log")
            getattr(axes, f"{name}axis").set_major_formatter(lambda value, _: f"{value:g}")
        for curve in panel.curves:
            colour = colours.setdefault(curve.label, f"C{len(colours)}")
            (lines[curve.label],) = axes.plot(curve.x, curve.y, curve.style, color=colour, label=curve.label)
    figure.tight_layout(rect=(0, 0.7 / figure.get_figheight(), 1, 1))
    figure.legend(handles=list(lines.values()), loc="lower center", ncol=4, frameon=False)
    figure.savefig(path, dpi=110)
    pyplot.close(figure)
