"""Predictions between samples (MOT-9)."""


def eighths(component, vector_precision, halved):
    """A vector component in eighths of a sample of the plane; `halved`: 4:2:0 chroma with motion of Y."""
    u = component * 2 ** (3 - vector_precision)
    return (u + 1) >> 1 if halved else u


def interpolate(ref, x, y, ux, uy):
    """I(x, y): 64 times ref at (x, y) moved by (ux, uy) eighths.

    ref(x, y) is called only where its weight is not 0.
    """
    ix, iy = ux >> 3, uy >> 3
    fx, fy = ux - 8 * ix, uy - 8 * iy
    total = 0
    for down, weight_y in ((0, 8 - fy), (1, fy)):
        for right, weight_x in ((0, 8 - fx), (1, fx)):
            if weight_x * weight_y != 0:
                total += weight_x * weight_y * ref(x + ix + right, y + iy + down)
    return total


def predict(interpolated):
    """R(x, y) of one or two values of I(x, y)."""
    if len(interpolated) == 1:
        return (interpolated[0] + 32) >> 6
    return (interpolated[0] + interpolated[1] + 64) >> 7
