"""Which points each study of the accuracy report measures of a light field.

A point that several studies name is measured once.
"""

import coding

BLOCKS = (2, 4, 8)
WINDOWS = (1, 2, 4, 8, 16, 32, 64)
THRESHOLDS = (10, 25, 50, 75, 150, 300)
CURVES = ("hmlfc", "rlfc", "mc")
REFERENCES = ("2x2", "4x4", "8x8", "16x16")
HEIGHTS = (1, 2, 3, 4)
CLUSTERS = ("2x2", "3x3", "4x4")
PRESETS = ("fast", "medium", "slow")
QUALITIES = (30, 45, 60, 75, 90)

QUICK = {  # what --quick has in place of these
    "WINDOWS": (1, 4, 16),
    "THRESHOLDS": (25, 75, 300),
    "REFERENCES": ("2x2", "8x8"),
    "HEIGHTS": (1, 3),
    "CLUSTERS": ("2x2", "3x3"),
    "PRESETS": ("fast", "medium"),
    "QUALITIES": (30, 60, 90),
}


class Studies:
    """The studies of a light field whose profile main has this chroma format."""

    def __init__(self, chroma, quick):
        self.chroma, self.quick = chroma, quick

    def values(self, name):
        """The values of a list above in this run."""
        return QUICK[name] if self.quick and name in QUICK else globals()[name]

    def main(self, **changes):
        return coding.main(self.chroma, **changes)

    def curve(self, method):
        """Points of one method of profile main by threshold."""
        return [self.main(method=method, threshold=t) for t in self.values("THRESHOLDS")]

    def preset(self, preset):
        """Points of one preset of profile extended by quality."""
        return [coding.extended(preset=preset, quality=q) for q in self.values("QUALITIES")]

    def block_size(self):
        return [self.main(block=block) for block in self.values("BLOCKS")]

    def window(self):
        return [self.main(window=window) for window in self.values("WINDOWS")]

    def threshold(self):
        return [*self.curve("hmlfc"), *self.curve("rlfc")]

    def methods(self):
        return [point for method in CURVES for point in self.curve(method)]

    def by_references(self):
        return [self.main(references=references) for references in self.values("REFERENCES")]

    def by_height(self):
        return [self.main(height=height) for height in self.values("HEIGHTS")]

    def reference_memory(self):
        return [*self.by_references(), *self.by_height()]

    def encoder(self):
        """Both profiles, and each parameter alone away from what the program takes."""
        points = [self.main(cluster=cluster) for cluster in self.values("CLUSTERS")]
        for preset in self.values("PRESETS"):
            points += self.preset(preset)
        points += [coding.extended(block=block) for block in self.values("BLOCKS")]
        points += [coding.extended(window=window) for window in (16, 127)]
        points += [coding.extended(height=height) for height in (1, 2)]
        points += [coding.extended(height=1, cluster="3x3")]
        return points

    def compared(self):
        """One point of each preset and of each method."""
        presets = [coding.extended(preset=preset) for preset in self.values("PRESETS")]
        return [*presets, *(self.main(method=method) for method in CURVES)]

    def renderer(self):
        """The streams that frames are drawn from."""
        return [self.main(), coding.extended()]


ENCODING = ("encoder", "block_size", "window", "threshold", "methods", "reference_memory")
DRAWN = (*ENCODING, "renderer")  # those with a picture
NAMES = (*DRAWN, "prediction")


def codings(names, chroma, quick):
    """The distinct points that the named studies of encoding measure, in their order."""
    studies = Studies(chroma, quick)
    points = [point for name in names if name in ENCODING for point in getattr(studies, name)()]
    return list(dict.fromkeys(points))


FILTERS = ("nearest", "bilinear", "quadrilinear")
CACHES = (0, 1, 4, 16)  # MiB, beside WHOLE_CACHE
WHOLE_CACHE = 256


def frame_settings(levels):
    """What frames of a stream of this many levels are drawn with: FILTER:LEVELS:CACHE:BACKEND."""
    settings = [f"{name}:{levels}:{WHOLE_CACHE}:cpu" for name in FILTERS]
    settings += [f"quadrilinear:{level}:{WHOLE_CACHE}:cpu" for level in range(1, levels)]
    settings += [f"quadrilinear:{levels}:{cache}:cpu" for cache in CACHES]
    return settings + [f"quadrilinear:{levels}:0:{backend}" for backend in ("golden", "gpu")]
