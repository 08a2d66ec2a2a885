"""Which encodings each study of the accuracy report measures, and how frames are drawn.

An encoding is a dict of options of `hmlfc encode`, without "--"; `threshold` stands for both thresholds of profile
main. One that several studies name is measured once.
"""

METHODS = ("hmlfc", "rlfc", "mc")
WITHOUT = {"hmlfc": (), "rlfc": ("window", "references"), "mc": ("height", "cluster")}  # options that a method has not
FULL = {
    "block": (2, 4, 8), "window": (1, 2, 4, 8, 16, 32, 64), "threshold": (10, 25, 50, 75, 150, 300),
    "references": ("2x2", "4x4", "8x8", "16x16"), "height": (1, 2, 3, 4), "preset": ("fast", "medium", "slow"),
    "quality": (25, 45, 60, 75, 90),
}
QUICK = {
    **FULL, "window": (1, 4, 16), "threshold": (25, 75, 300), "references": ("2x2", "8x8"), "height": (1, 3),
    "preset": ("fast", "medium"), "quality": (30, 60, 90),
}
ENCODING = ("encoder", "block_size", "window", "methods", "reference_memory")
NAMES = (*ENCODING, "renderer")
FILTERS = ("nearest", "views", "quadrilinear")
CACHES = (0, 1, 256)  # MiB, the last more than all blocks take


def main(method="hmlfc", **changes):
    """Profile main as in the paper's studies: blocks of 4, window 16, height 3, thresholds 75."""
    coding = {"profile": "main", "method": method, "block": 4, "window": 16, "height": 3, "cluster": "2x2",
              "references": "8x8", "threshold": 75, **changes}
    return {name: value for name, value in coding.items() if name not in WITHOUT[method]}


def extended(**changes):
    """Profile extended as `hmlfc encode` has it, at quality 60."""
    return {"profile": "extended", "preset": "medium", "quality": 60, "block": 4, "window": 64, "height": 0, **changes}


def studies(quick):
    """{study: its encodings}"""
    values = QUICK if quick else FULL
    return {
        "encoder": [extended(preset=p, quality=q) for p in values["preset"] for q in values["quality"]],
        "block_size": [main(block=block) for block in values["block"]],
        "window": [main(window=window) for window in values["window"]],
        "methods": [main(method, threshold=t) for method in METHODS for t in values["threshold"]],
        "reference_memory": [*(main(references=r) for r in values["references"]),
                             *(main(height=h) for h in values["height"])],
    }


def label(coding):
    """The name of an encoding in results and tables, such as "hmlfc t75 b4 w16 h3 c2x2 r8x8"."""
    kind = coding["method"] if coding["profile"] == "main" else f"extended {coding['preset']}"
    aim = f"t{coding['threshold']}" if coding["profile"] == "main" else f"q{coding['quality']}"
    shape = [f"{name[0]}{coding[name]}" for name in ("block", "window", "height", "cluster", "references") if name in coding]
    return " ".join([kind, aim, *shape])


def arguments(coding, chroma):
    """Of `hmlfc encode`. chroma: of profile main."""
    options = {name: value for name, value in coding.items() if name != "threshold"}
    if coding["profile"] == "main":
        options |= {"threshold-ref": coding["threshold"], "threshold-pred": coding["threshold"], "chroma": chroma}
    return [text for name, value in options.items() for text in (f"--{name}", value)]


def frame_settings(levels):
    """What frames of a stream of this many levels are drawn with: FILTER:LEVELS:CACHE."""
    return [*(f"{name}:{levels}:{CACHES[-1]}" for name in FILTERS),
            *(f"quadrilinear:{level}:{CACHES[-1]}" for level in range(1, levels)),
            *(f"quadrilinear:{levels}:{cache}" for cache in CACHES[:-1])]
