"""Rates at one PSNR."""

import math


def bpp_at(curve, psnr):
    """Bits a pixel of a curve at a PSNR in dB: log(bpp) linear in PSNR between the two points
    around it. None where the curve does not reach it: nothing is extrapolated.

    curve: pairs (PSNR in dB, bits a pixel)."""
    curve = sorted(curve)
    for (low, low_bpp), (high, high_bpp) in zip(curve, curve[1:]):
        if low <= psnr <= high and high > low and math.isfinite(high):
            share = (psnr - low) / (high - low)
            return math.exp((1 - share) * math.log(low_bpp) + share * math.log(high_bpp))
    return None
