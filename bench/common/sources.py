"""The light fields that benchmarks in Python measure."""

import os
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Source:
    """A light field on disk. at: PSNR in dB to compare at; chroma: of profile main."""

    name: str
    folder: Path
    at: float = 38.0
    chroma: str = "444"


REAL = (
    Source("chess", Path("stanford-chess-16x16-700x400"), 39.0, "420"),
    Source("antinous", Path("hci-antinous-9x9-512x512"), 39.5, "420"),
    Source("knights", Path("stanford-legoknights-17x17-256x256-jpeg"), 36.5),
    Source("toylf", Path("toylf-16x16-320x240"), 36.0),
)


def real_sources(skip):
    """Those of REAL whose folders exist; calls skip(name, why) for the others."""
    data = Path(os.environ.get("HMLFC_DATA_DIR") or ROOT.parent / "shared" / "data")
    for source in REAL:
        if (data / source.folder).is_dir():
            yield replace(source, folder=data / source.folder)
        else:
            skip(source.name, f"no folder {source.folder} (HMLFC_DATA_DIR names where it is)")
