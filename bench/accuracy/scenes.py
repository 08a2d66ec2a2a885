"""The light fields that the accuracy report measures."""

from dataclasses import dataclass
from pathlib import Path

from light_field import read_views
from process import run
from sources import real_sources
from store import digest

SCENES = ("cards", "knights", "glass", "flat", "noise")
SCENE_CHROMA = "444"  # of profile main: halved chroma ends at 31 dB on knights, at 34 dB on glass
SCENE_SIZE = ("9x9", "256x192")
QUICK_SCENES = ("cards", "noise")
QUICK_SIZE = ("5x5", "96x64")
SYNTHETIC_AT = 36.0  # dB, to compare methods at


@dataclass
class Scene:
    """A folder of views. identity: digest of names and sizes; at: PSNR in dB to compare methods at;
    chroma: of profile main."""

    name: str
    folder: Path
    identity: str
    at: float
    chroma: str
    rows: int
    cols: int
    width: int
    height: int


# Of the real light fields: more would take hours.
REAL_NAMES = ("chess", "antinous", "knights")


def find_scenes(hmlfc, work, quick, names, skip):
    """The light fields of a run: the real ones that exist, then the built-in scenes, rendered into the
    folder `work`. quick: two small scenes. names: those to take, or empty for all. Calls
    skip(name, why) for those that are missing."""

    def wanted(name):
        return not names or name in names

    if not quick:
        missing = lambda name, why: name in REAL_NAMES and wanted(name) and skip(name, why)
        for source in real_sources(missing):
            if source.name in REAL_NAMES and wanted(source.name):
                yield _scene(source.name, source.folder, source.at, source.chroma)
    grid, size = QUICK_SIZE if quick else SCENE_SIZE
    for scene in QUICK_SCENES if quick else SCENES:
        name = f"synth-{scene}"
        if not wanted(name):
            continue
        folder = work / name
        command = [hmlfc, "synth", "--scene", scene, "--grid", grid, "--size", size, "-o", folder]
        run(command)
        yield _scene(name, folder, SYNTHETIC_AT, SCENE_CHROMA)


def _scene(name, folder, at, chroma):
    rows, cols, height, width, _ = read_views(folder).shape
    identity = digest([[path.name, path.stat().st_size] for path in sorted(folder.iterdir())])
    return Scene(name, folder, identity, at, chroma, rows, cols, width, height)
