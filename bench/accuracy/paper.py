"""Figures of Pratapa and Manocha's paper, for tables beside the measured ones."""

# Block size: {light field: {block: (PSNR in dB, bits a pixel)}}, thresholds 75, window 16, height 3.
BLOCK_SIZE = {
    "Amethyst": {2: (38.7, 0.0592), 4: (43.69, 0.106), 8: (48.35, 0.707)},
    "Bunny": {2: (40.52, 0.0173), 4: (43.35, 0.0411), 8: (47.52, 0.548)},
    "Bracelet": {2: (37.03, 0.033), 4: (44.15, 0.35), 8: (48.79, 1.108)},
    "Lego Knights": {2: (38.27, 0.096), 4: (43.046, 0.243), 8: (47.89, 1.15)},
}

# How many times the bits of HMLFC the other methods take at similar PSNR, over its light fields.
TIMES_OF_HMLFC = {"rlfc": (2, 5), "mc": (2, 3)}
