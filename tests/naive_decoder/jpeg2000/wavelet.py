"""The inverse reversible 5/3 transform of a tile at the origin (T.800 annex F)."""


def mirrored(values, index):
    """Symmetric extension: values[-1] is values[1], values[n] is values[n - 2]."""
    if index < 0:
        index = -index
    if index >= len(values):
        index = 2 * (len(values) - 1) - index
    return values[index]


def synthesize(low, high):
    """The signal of n low-pass and n or n - 1 high-pass coefficients."""
    count = len(low) + len(high)
    if count == 1:
        return list(low)
    signal = [0] * count
    signal[0::2], signal[1::2] = low, high
    for i in range(0, count, 2):
        signal[i] -= (mirrored(signal, i - 1) + mirrored(signal, i + 1) + 2) >> 2
    for i in range(1, count, 2):
        signal[i] += (mirrored(signal, i - 1) + mirrored(signal, i + 1)) >> 1
    return signal


def columns(rows, width):
    """The transpose of rows of `width` values."""
    return [[row[x] for row in rows] for x in range(width)]


def join(ll, hl, lh, hh):
    """The next resolution from its four subbands, each rows of coefficients."""
    upper = [synthesize(low, high) for low, high in zip(ll, hl)]
    lower = [synthesize(low, high) for low, high in zip(lh, hh)]
    width = len(upper[0])
    whole = [synthesize(low, high) for low, high in zip(columns(upper, width), columns(lower, width))]
    return columns(whole, len(upper) + len(lower))
