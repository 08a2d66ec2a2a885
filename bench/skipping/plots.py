"""The pictures of docs/skipping.md."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

COLOURS = {"needed": "black", "decoded": "#d62728", "reused": "#2ca02c", "zero": "#1f77b4"}


def draw(results, folder, prefix=""):
    """Writes PREFIXframes.png and PREFIXcost.png."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, figure in (("frames", _frames(results)), ("cost", _cost(results))):
        figure.tight_layout()
        figure.savefig(folder / f"{prefix}{name}.png", dpi=80)
        pyplot.close(figure)


def _frames(results):
    """Blocks by frame along the paths of warm renderers, profile main."""
    warm = [p for p in results["paths"] if p["client"] == "warm" and p["profile"] == "main"]
    scenes = list(dict.fromkeys(p["scene"] for p in warm))
    paths = list(dict.fromkeys(p["path"] for p in warm))
    figure, panels = pyplot.subplots(len(scenes), len(paths), squeeze=False,
                                     figsize=(4 * len(paths), 2.4 * len(scenes)))
    for path in warm:
        panel = panels[scenes.index(path["scene"])][paths.index(path["path"])]
        for key, colour in COLOURS.items():
            panel.plot(path["frames"][key], "-" if key != "needed" else ":", color=colour, label=key)
        panel.set_title(f"{path['scene']}, {path['path']}", fontsize=9)
        panel.set_ylabel("blocks")
        panel.set_ylim(bottom=0)
        other = panel.twinx()
        other.plot([read / 1024 for read in path["frames"]["bytes"]], "--", color="#7f7f7f",
                   label="KiB touched")
        other.set_ylim(bottom=0)
    panels[0][0].legend(fontsize=7)
    return figure


def _cost(results):
    """Bytes and CPU time of one block by views, pixels of a view and file size."""
    kinds = list(dict.fromkeys(cost["by"] for cost in results["costs"]))
    figure, panels = pyplot.subplots(2, len(kinds), squeeze=False, figsize=(4 * len(kinds), 6))
    for column, kind in enumerate(kinds):
        own = [cost for cost in results["costs"] if cost["by"] == kind]
        at = [cost["at"] for cost in own]
        for request in ("block", "view"):
            panels[0][column].plot(at, [c[request]["bytes"] for c in own], "o-", label=f"one {request}")
            panels[1][column].plot(at, [1e6 * c[request]["cpu_seconds"] for c in own], "o-")
        panels[0][column].plot(at, [c["block"]["key_bytes"] for c in own], "s:", color="#7f7f7f",
                               label="key image for a block")
        panels[0][column].plot(at, [c["file_bytes"] for c in own], "k--", label="the file")
        for row in (0, 1):
            panels[row][column].set_xscale("log")
            panels[row][column].set_yscale("log")
            panels[row][column].grid(True, color="#e4e4e4")
        panels[1][column].set_xlabel({"pixels": "pixels of a view"}.get(kind, kind))
    panels[0][0].set_ylabel("bytes touched")
    panels[1][0].set_ylabel("CPU us")
    panels[0][0].legend(fontsize=8)
    return figure
