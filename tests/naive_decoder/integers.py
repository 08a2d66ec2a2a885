"""Integer helpers of section 1, and rshift of MOT-8."""


def clamp(x, lo, hi):
    """CNV-2."""
    return lo if x < lo else hi if x > hi else x


def ceil_div(x, y):
    """ceil(x / y) for x >= 0, y > 0 (CNV-1)."""
    return (x + y - 1) // y


def popcount(mask):
    """The number of 1 bits (CNV-6)."""
    return bin(mask).count("1")


def rank(mask, i):
    """The number of 1 bits below bit i (CNV-6)."""
    return popcount(mask % 2**i)


def signed(field, bits):
    """The value of a two's complement field (CNV-5)."""
    return field - 2**bits if bits > 0 and field >= 2 ** (bits - 1) else field


def least_bits(count):
    """The least b with 2^b >= count."""
    bits = 0
    while 2**bits < count:
        bits += 1
    return bits


def rshift(x, k):
    """Division by 2^k, rounded to nearest, halves upwards (MOT-8)."""
    return x if k == 0 else (x + 2 ** (k - 1)) >> k
