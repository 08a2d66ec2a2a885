"""How a light field is encoded in one point of the accuracy report."""

from dataclasses import asdict, dataclass, fields


@dataclass(frozen=True)
class Coding:
    """Options of `hmlfc encode`. None: the default of the program.

    threshold: both thresholds of profile main; quality, preset: of profile extended.
    """

    profile: str
    method: str = "hmlfc"
    block: int = 4
    window: int | None = 16
    height: int | None = 3
    cluster: str | None = "2x2"
    references: str | None = "8x8"
    chroma: str | None = None
    threshold: int | None = None
    quality: float | None = None
    preset: str | None = None
    lossless: bool = False

    def options(self):
        """Arguments of `hmlfc encode`."""
        options = []
        for name, value in asdict(self).items():
            if name == "threshold" and value is not None:
                options += ["--threshold-ref", value, "--threshold-pred", value]
            elif name == "lossless":
                options += ["--lossless"] if value else []
            elif value is not None:
                options += [f"--{name}", value]
        return [str(option) for option in options]

    def changes(self):
        """The fields that are not the class's defaults, by name."""
        return {f.name: getattr(self, f.name) for f in fields(self) if getattr(self, f.name) != f.default}

    def label(self):
        """A short name for tables and messages."""
        if self.lossless:
            return "lossless"
        kind = self.method if self.profile == "main" else f"extended {self.preset}"
        aim = f"t{self.threshold}" if self.profile == "main" else f"q{self.quality:g}"
        letters = ("block", "window", "height", "cluster", "references")
        shape = [f"{name[0]}{getattr(self, name)}" for name in letters if getattr(self, name) is not None]
        return " ".join([kind, aim, *shape])


# Options that a method does not have.
WITHOUT = {
    "hmlfc": {},
    "rlfc": {"window": None, "references": None},
    "mc": {"height": None, "cluster": None},
}


def main(chroma, method="hmlfc", **changes):
    """Profile main as in the paper's studies: blocks of 4, window 16, height 3, thresholds 75."""
    standard = {"profile": "main", "chroma": chroma, "threshold": 75, **WITHOUT[method]}
    return Coding(**{**standard, "method": method, **changes})


def extended(**changes):
    """Profile extended as `hmlfc encode` has it, at quality 60."""
    standard = {
        "profile": "extended",
        "window": 64,
        "height": 0,
        "references": None,
        "quality": 60,
        "preset": "medium",
    }
    return Coding(**{**standard, **changes})


def lossless():
    """Keeps every RGB value; stands for the uncompressed light field."""
    return extended(preset="fast", quality=None, lossless=True)
