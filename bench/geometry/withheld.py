"""Withheld views: of a light field only the views of even rows and columns are encoded, and those between are rendered."""

import json
import re

import numpy as np
from light_field import read_view, read_views, squared_error
from PIL import Image, ImageDraw
from process import run, say

QUALITIES = (90, 60, 30)
MOST_VIEWS = 12  # of the withheld views of a light field, evenly spread
SEARCHED = 3  # of these, on which the best plane is searched
MARGIN = 16  # pixels at each border, which the focal plane may move out of the views (RAY-5)
CROP = 96, 72  # pixels of each part of the picture
SCALE = 3
FLAT = "scene flat"  # blank: its true plane is 0
LOSSLESS = "lossless"  # a quality
STATED = re.compile(r".*_(\d+)_(\d+)_(-?[\d.]+)_(-?[\d.]+)")  # names of the Stanford archive: row, column, y, x


class Withheld:
    """The views of a folder that a stream of the even ones leaves out, and how well they are rendered."""

    def __init__(self, hmlfc, work, name, folder):
        self.hmlfc, self.work, self.name, self.folder = hmlfc, work, name, folder
        views = read_views(folder)
        rows, cols = views.shape[:2]
        places = [(row, col) for row in range(1, rows - 1, 2) for col in range(1, cols - 1, 2)]
        chosen = np.linspace(0, len(places) - 1, min(MOST_VIEWS, len(places))).astype(int)
        self.places = [places[k] for k in chosen]
        self.views = [views[place] for place in self.places]
        self.even = f"0..{rows - 1}:2,0..{cols - 1}:2"
        self.stream = work / "even.hmlfc"
        stated = stated_places(folder)
        self.stated = [stated[place] for place in self.places] if stated else None

    def encode(self, quality):
        coding = ["--lossless"] if quality == LOSSLESS else ["--quality", quality]
        run([self.hmlfc, "encode", self.folder, "-o", self.stream, *coding, "--views", self.even])

    def frames(self, cameras, geometry, places=None):
        """The frames of [(number of a view, focus)], with cameras at `places` or on the grid."""
        path, out = self.work / "path.json", self.work / "frames"
        places = [((places or self.places)[k], focus) for k, focus in cameras]
        path.write_text(json.dumps([{"position": [col / 2, row / 2, 0], "focus": focus} for (row, col), focus in places]))
        run([self.hmlfc, "render", self.stream, "--path", path, "--geometry", geometry, "-o", out])
        return [read_view(out / f"frame_{k:04}.png") for k in range(len(cameras))]

    def errors(self, cameras, geometry, places=None):
        frames = self.frames(cameras, geometry, places)
        return [squared_error(inner(self.views[k]), inner(frame)) for (k, _), frame in zip(cameras, frames)]

    def psnr(self, errors, views):
        mean = sum(errors) / sum(inner(self.views[k]).size for k in views)
        return 10 * np.log10(255**2 / mean)

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
        views = range(len(self.views))
        cameras = [(k, focus) for k in views]
        plane, stream, unfocused = (
            self.psnr(self.errors(list_of, geometry), views)
            for list_of, geometry in (
                (cameras, "plane"), (cameras, "stream"), ([(k, 0) for k in views], "stream")
            )
        )
        row = {
            "light_field": self.name, "quality": quality, "views": len(self.views), "focus": focus,
            "plane": plane, "geometry": stream, "geometry_focus_0": unfocused,
        }
        if self.name == FLAT:
            row["plane_focus_0"] = self.psnr(self.errors([(k, 0) for k in views], "plane"), views)
        if self.stated:
            row["stated_places"] = self.psnr(self.errors([(k, 0) for k in views], "stream", self.stated), views)
        return row


def stated_places(folder):
    """{(row, column) of a view: where its file name says that its camera stood, in rows and columns of the even grid
    that fits all names best}; empty where no name says it."""
    names = [name for path in folder.iterdir() if (name := STATED.fullmatch(path.stem))]
    if not names:
        return {}
    rows, cols, ys, xs = np.array([name.groups() for name in names], float).T
    places = (np.polyval(np.polyfit(at, numbers, 1), at) for numbers, at in ((rows, ys), (cols, xs)))
    return dict(zip(zip(rows.astype(int), cols.astype(int)), zip(*places)))


def inner(view):
    return view[MARGIN:-MARGIN, MARGIN:-MARGIN]


def measure(hmlfc, work, folders, qualities):
    """A row for each light field of (name, folder) and quality."""
    for name, folder in folders:
        withheld = Withheld(hmlfc, work, name, folder)
        for quality in (*qualities, LOSSLESS) if name == FLAT else qualities:
            say(f"withheld views of {name}, quality {quality}")
            yield withheld.row(quality)


def tables(rows):
    head = ("light field", "quality", "best plane, pixels a column", "plane, dB", "geometry, dB", "gain, dB",
            "gain with --focus 0, dB")
    lines = [
        (row["light_field"], row["quality"], f"{row['focus']:g}", f"{row['plane']:.2f}", f"{row['geometry']:.2f}",
         f"{row['geometry'] - row['plane']:+.2f}", f"{row['geometry_focus_0'] - row['plane']:+.2f}")
        for row in rows
    ]
    return head, lines


def picture(hmlfc, work, folder, file):
    """Writes plane, geometry and truth of a withheld view, side by side: where both differ most."""
    withheld = Withheld(hmlfc, work, folder.name, folder)
    withheld.encode(QUALITIES[0])
    middle = len(withheld.views) // 2
    camera = [(middle, withheld.best_focus())]
    parts = [withheld.frames(camera, "plane")[0], withheld.frames(camera, "stream")[0], withheld.views[middle]]
    x, y = crop_of(np.abs(parts[0].astype(int) - parts[2]).sum(axis=2))
    width, height = CROP[0] * SCALE, CROP[1] * SCALE
    sheet = Image.new("RGB", (3 * width + 16, height + 18), "white")
    for k, (part, title) in enumerate(zip(parts, ("plane", "geometry", "truth"))):
        crop = Image.fromarray(part[y:y + CROP[1], x:x + CROP[0]]).resize((width, height), Image.LANCZOS)
        sheet.paste(crop, (k * (width + 8), 18))
        ImageDraw.Draw(sheet).text((k * (width + 8), 3), title, "black")
    sheet.save(file, format="PNG", optimize=True)


def crop_of(error):
    """(x, y) of the crop with the largest sum of `error`, a multiple of 8 each."""
    sums = np.pad(error, ((1, 0), (1, 0))).cumsum(axis=0).cumsum(axis=1)
    width, height = CROP
    best = {
        (x, y): sums[y + height, x + width] - sums[y, x + width] - sums[y + height, x] + sums[y, x]
        for y in range(0, error.shape[0] - height, 8) for x in range(0, error.shape[1] - width, 8)
    }
    return max(best, key=best.get)
