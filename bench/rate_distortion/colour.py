"""RGB to BT.709 YCbCr video samples and back, 8 bits, limited range, chroma 4:2:0 or 4:4:4.

All sums are in double precision; each sample is rounded once, to the nearest. Samples of 4:2:0
chroma lie in the middle of their four pixels: they are the mean of the four unrounded values.
"""

import numpy as np

KR, KG, KB = 0.2126, 0.7152, 0.0722
LUMA_GAIN = 219.0 / 255.0
CB_GAIN = 224.0 / 255.0 / (2.0 * (1.0 - KB))
CR_GAIN = 224.0 / 255.0 / (2.0 * (1.0 - KR))


def to_ycbcr(view, chroma):
    """Planes (Y, Cb, Cr), uint8, of a uint8 RGB view; even sides for chroma "420"."""
    red, green, blue = (view[..., channel].astype(np.float64) for channel in range(3))
    luma = KR * red + KG * green + KB * blue
    blue_difference = CB_GAIN * (blue - luma)
    red_difference = CR_GAIN * (red - luma)
    if chroma == "420":
        blue_difference = _halve(blue_difference)
        red_difference = _halve(red_difference)
    return (
        _to_bytes(16.0 + LUMA_GAIN * luma),
        _to_bytes(128.0 + blue_difference),
        _to_bytes(128.0 + red_difference),
    )


def to_rgb(planes, enlarge):
    """The uint8 RGB view of planes (Y, Cb, Cr). enlarge: the function that makes chroma full."""
    luma = (planes[0] - 16.0) / LUMA_GAIN
    blue_difference = enlarge(planes[1] - 128.0) / CB_GAIN
    red_difference = enlarge(planes[2] - 128.0) / CR_GAIN
    view = np.empty((*luma.shape, 3), np.uint8)
    view[..., 0] = _to_bytes(luma + red_difference)
    view[..., 1] = _to_bytes(luma - (KB * blue_difference + KR * red_difference) / KG)
    view[..., 2] = _to_bytes(luma + blue_difference)
    return view


def same(plane):
    """Chroma that is full already."""
    return plane


def replicate(plane):
    """Each sample to its 2x2 pixels."""
    return plane.repeat(2, axis=0).repeat(2, axis=1)


def bilinear(plane):
    """Each pixel from the four samples around it, weights 3/4 and 1/4 along each axis."""
    return _double_rows(_double_rows(plane).T).T


def pad(view, multiple):
    """The view with its last row and column repeated up to sides that are multiples."""
    height, width = view.shape[:2]
    below, right = -height % multiple, -width % multiple
    return np.pad(view, ((0, below), (0, right), (0, 0)), mode="edge")


def _halve(plane):
    return 0.25 * (plane[::2, ::2] + plane[::2, 1::2] + plane[1::2, ::2] + plane[1::2, 1::2])


def _double_rows(plane):
    padded = np.pad(plane, ((1, 1), (0, 0)), mode="edge")
    doubled = np.empty((2 * plane.shape[0], plane.shape[1]))
    doubled[::2] = 0.75 * plane + 0.25 * padded[:-2]
    doubled[1::2] = 0.75 * plane + 0.25 * padded[2:]
    return doubled


def _to_bytes(values):
    return np.clip(np.floor(values + 0.5), 0, 255).astype(np.uint8)
