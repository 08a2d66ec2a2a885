"""The weights of views for a ray (SMP-1)."""

from camera import FILTERS
from integers import clamp


def weights_along(place, count, aperture):
    """{column: weight} of U, or {row: weight} of V, without weights of 0."""
    reach, k = 2**aperture, 8 - 2 * aperture
    rounded = (place + 2 ** (15 - k)) >> (16 - k)
    weights = {}
    for m in range((rounded >> k) - reach + 1, (rounded >> k) + reach + 1):
        weight = max(0, reach * 2**k - abs(m * 2**k - rounded))
        if weight > 0:
            inside = clamp(m, 0, count - 1)
            weights[inside] = weights.get(inside, 0) + weight
    return weights


def view_weights(record, ray):
    """{(row, col): weight} of the views of weight above 0 for a ray that is inside, row by row; the sum is 65536."""
    if FILTERS[record["filter"]] == "nearest":
        return {ray.nearest: 65536}
    u, v = ray.on_grid()
    rows = weights_along(v, record["rows"], record["aperture"])
    cols = weights_along(u, record["cols"], record["aperture"])
    return {(row, col): rows[row] * cols[col] for row in rows for col in cols}
