"""Structural similarity of decoded views."""

import numpy as np
from skimage.metrics import structural_similarity

from light_field import read_view, read_views

# That of Wang, Bovik, Sheikh and Simoncelli: weights of a Gaussian of 1.5 pixels.
PARAMETERS = {"gaussian_weights": True, "sigma": 1.5, "use_sample_covariance": False}
PEAK = 255


def chosen_views(rows, cols):
    """Positions of the corners, the middles of the borders and the centre of a grid."""
    return [
        (row, col)
        for row in sorted({0, (rows - 1) // 2, rows - 1})
        for col in sorted({0, (cols - 1) // 2, cols - 1})
    ]


def luma(view):
    """Y of YCoCg-R, as float64."""
    red, green, blue = (view[..., k].astype(np.int32) for k in range(3))
    difference = red - blue
    base = blue + (difference >> 1)
    return (base + ((green - base) >> 1)).astype(np.float64)


class Similarity:
    """Compares decoded views with those of a folder."""

    def __init__(self, folder):
        views = read_views(folder)
        self.views = {place: luma(views[place]) for place in chosen_views(*views.shape[:2])}

    def mean(self, folder):
        """Mean SSIM of the luma of the chosen views, decoded in a folder as RR_CC.png."""
        values = [
            structural_similarity(
                view,
                luma(read_view(folder / f"{row:02d}_{col:02d}.png")),
                data_range=PEAK,
                **PARAMETERS,
            )
            for (row, col), view in self.views.items()
        ]
        return float(np.mean(values))
