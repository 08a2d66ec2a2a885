"""Withheld views: of a light field only the views of even rows and columns are encoded, and those between are rendered."""

import json

import numpy as np
from light_field import load, psnr_of_mse, squared_error
from PIL import Image
from process import hmlfc, say

QUALITIES = (90, 60, 30)
MOST_VIEWS = 12  # of the withheld views of a light field, evenly spread
SEARCHED = 3  # of these, on which the best plane is searched
MARGIN = 16  # pixels at each border, which the focal plane may move out of the views (RAY-5)


class Withheld:
    """The views of a folder that a stream of the even ones leaves out, and how well they are rendered."""

    def __init__(self, work, name, folder):
        self.work, self.name, self.folder = work, name, folder
        views = load(name, folder).grid
        rows, cols = views.shape[:2]
        places = [(row, col) for row in range(1, rows - 1, 2) for col in range(1, cols - 1, 2)]
        chosen = np.linspace(0, len(places) - 1, min(MOST_VIEWS, len(places))).astype(int)
        self.places = [places[k] for k in chosen]
        self.views = [views[place] for place in self.places]
        self.even = f"0..{rows - 1}:2,0..{cols - 1}:2"
        self.stream = work / "even.hmlfc"

    def encode(self, quality):
        hmlfc("encode", self.folder, "-o", self.stream, "--quality", quality, "--views", self.even)

    def frames(self, cameras, geometry):
        """The frames of [(number of a view, focus)]."""
        path, out = self.work / "path.json", self.work / "frames"
        places = [(self.places[k], focus) for k, focus in cameras]
        path.write_text(json.dumps([{"position": [col / 2, row / 2, 0], "focus": focus} for (row, col), focus in places]))
        hmlfc("render", self.stream, "--path", path, "--geometry", geometry, "-o", out)
        return [np.asarray(Image.open(out / f"frame_{k:04}.png")) for k in range(len(cameras))]

    def errors(self, cameras, geometry):
        """The squared errors of these frames."""
        frames = self.frames(cameras, geometry)
        return [squared_error(inner(self.views[k]), inner(frame)) for (k, _), frame in zip(cameras, frames)]

    def psnr(self, focus, geometry):
        """Of all views."""
        errors = self.errors([(k, focus) for k in range(len(self.views))], geometry)
        return psnr_of_mse(sum(errors) / sum(inner(view).size for view in self.views))

    def best_focus(self):
        """The plane with the least error on SEARCHED views, to 1/8 pixel a column."""
        searched = sorted({int(k) for k in np.linspace(0, len(self.views) - 1, SEARCHED)})
        focus = 0.0
        for reach, step in ((16, 1), (1, 0.125)):
            planes = [focus + step * k for k in range(-int(reach / step), int(reach / step) + 1)]
            errors = self.errors([(k, plane) for plane in planes for k in searched], "plane")
            sums = np.reshape(errors, (len(planes), len(searched))).sum(axis=1)
            focus = planes[int(np.argmin(sums))]
        return focus

    def row(self, quality):
        self.encode(quality)
        focus = self.best_focus()
        return {
            "light_field": self.name, "quality": quality, "views": len(self.views), "focus": focus,
            "plane": self.psnr(focus, "plane"), "geometry": self.psnr(focus, "stream"),
            "geometry_focus_0": self.psnr(0, "stream"),
        }


def inner(view):
    return view[MARGIN:-MARGIN, MARGIN:-MARGIN]


def measure(work, folders, qualities):
    """A row for each light field of (name, folder) and quality."""
    for name, folder in folders:
        withheld = Withheld(work, name, folder)
        for quality in qualities:
            say(f"withheld views of {name}, quality {quality}")
            yield withheld.row(quality)
