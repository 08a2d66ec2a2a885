#!/usr/bin/env python3
"""Three pictures of a light field: a view, an epipolar image, and a stack of frames with different focus.

usage: explore.py FILE.hmlfc FOLDER
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

import hmlfc

lf = hmlfc.open(sys.argv[1])
folder = Path(sys.argv[2])
rows, cols, height, width, _ = lf.shape
row, col = rows // 2, cols // 2


def save(name, pixels):
    eight_bits = (pixels >> (lf.depth - 8)).astype(np.uint8)
    Image.fromarray(eight_bits).save(folder / name)


# One view of the grid.
save("view.png", lf[row, col])

# The same line of pixels in all views of a row, one below the other: a point of the scene is a straight line whose
# slope is its disparity. Only blocks with that line are decoded. Each view takes eight rows of the picture.
epipolar = lf[row, :, height // 2]
save("epipolar.png", np.repeat(epipolar, 8, axis=0))

# What the stream knows of depth, and frames focused from near to far, each a mean of many views.
disparity, confidence = lf.disparity(row, col)
known = disparity[confidence > 0] if confidence.any() else disparity
stack = [
    lf.render(focus=focus, aperture=2, geometry="plane")
    for focus in np.linspace(known.min(), known.max(), 4)
]
save("focus.png", np.concatenate(stack, axis=1))
