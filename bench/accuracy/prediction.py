"""What a view can be predicted from before anything of it is coded: the mean of its cluster, as by the
tree, or another view, as by motion."""

import numpy as np

from light_field import read_views
from similarity import chosen_views, luma
from tables import psnr_of_mse

SIDES = (2, 4, 8)  # views along a side of a cluster: a tree of height 3 of clusters of 2x2
BLOCK = 4  # pixels along a side
WINDOW = 16  # largest component of a vector, in pixels


def measure(folder):
    """PSNR of luma in dB of predictions of the views at the corners and the middles of the borders of
    the first and largest cluster of a folder's grid.

    mean_N: each by the mean of its cluster of NxN; vectors: each by the view in the middle, with the
    best vector of whole pixels for each block."""
    views = read_views(folder)
    clusters = [side for side in SIDES if side <= min(views.shape[:2])]
    largest = clusters[-1]
    views = luma(views[:largest, :largest])
    middle = ((largest - 1) // 2, (largest - 1) // 2)
    targets = [place for place in chosen_views(largest, largest) if place != middle]
    errors = {f"mean_{side}": [_of_mean(views, place, side) for place in targets] for side in clusters}
    errors["vectors"] = [compensated_error(views[middle], views[place]) for place in targets]
    return {name: psnr_of_mse(np.mean(values)) for name, values in errors.items()}


def _of_mean(views, place, side):
    row, col = (at // side * side for at in place)
    mean = views[row : row + side, col : col + side].mean(axis=(0, 1))
    return np.mean((views[place] - mean) ** 2)


def compensated_error(reference, view):
    """Mean squared error of a view, each whole block of it by the best place in the reference, which
    its border continues."""
    height, width = (size // BLOCK * BLOCK for size in view.shape)
    view = view[:height, :width]
    around = np.pad(reference, WINDOW, mode="edge")
    best = np.full((height // BLOCK, width // BLOCK), np.inf)
    for y in range(2 * WINDOW + 1):
        for x in range(2 * WINDOW + 1):
            squares = (around[y : y + height, x : x + width] - view) ** 2
            blocks = squares.reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK).sum(axis=(1, 3))
            np.minimum(best, blocks, out=best)
    return best.sum() / (height * width)
