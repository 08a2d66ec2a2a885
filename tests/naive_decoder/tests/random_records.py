"""Random tile records of every kind, most of them valid (TIL-1, STP-1, MOT-3, MOT-6).

A bounded integer sequence is random bits: each is one (BISE-10).
"""

from bise import least_code, levels_of, sequence_bits
from bit_writer import BitWriter
from integers import ceil_div, least_bits, popcount
from tile_mask import blocks_in_plane

RARE = 0.002  # how often a field is drawn without regard to what is valid


def put_random(writer, rng, bits):
    """Appends random bits."""
    writer.put(rng.getrandbits(bits) if bits else 0, bits)


def random_mask(rng, inside, allowed_modes=(0, 1, 2, 3)):
    """(mode, mask) with mask bits inside the plane."""
    mode = rng.choice(allowed_modes)
    if mode == 0:
        return mode, 0
    mask = inside if mode == 1 else inside & rng.getrandbits(64)
    return mode, mask | (1 << rng.randrange(64) if mode > 1 and rng.random() < RARE else 0)


def put_mask(writer, mode, mask):
    """TIL-3."""
    if mode == 2:
        writer.put(mask, 64)
    if mode == 3:
        quads = [mask >> 4 * quad & 15 for quad in range(16)]
        writer.put(sum(1 << quad for quad in range(16) if quads[quad]), 16)
        for quad in filter(None, quads):
            writer.put(quad, 4)


def put_vectors(writer, rng, window, count):
    """sign_mode to vectors_y (TIL-6)."""
    sign_mode = rng.choice([0, 1, 2]) if rng.random() > RARE else 3
    writer.put(sign_mode, 2)
    greatest = least_code(2 * window + 1)
    sequences = []
    for _ in "xy":
        code = rng.randint(0, greatest)
        least = rng.randint(0, max(0, 2 * window + 1 - levels_of(code)))
        writer.put(least, least_bits(2 * window + 1))
        writer.put(code, least_bits(greatest + 1))
        sequences.append(sequence_bits(count, levels_of(code)))
    put_random(writer, rng, count if sign_mode == 2 else 0)
    for bits in sequences:
        put_random(writer, rng, bits)


def put_residuals(writer, rng, geometry, count):
    """level_base to the block values (TIL-8, TIL-9, STP-1)."""
    header = geometry.header
    greatest = 27 + 3 * (header.depth - 8)
    level_bits = rng.randint(0, 4) if rng.random() > RARE else 7
    bias_bits = rng.randint(0, header.depth + 2) if rng.random() > RARE else 15
    level_base = rng.randint(0, max(0, greatest + 2 - 2**level_bits)) if rng.random() < 0.5 else 0
    writer.put(level_base, 6)
    writer.put(level_bits, 3)
    writer.put(bias_bits, 4)
    step_base, step_bits = rng.choice([0, 0, 3, 12]), rng.randint(0, 2)
    if header.residual_step:
        writer.put(step_base, 4)
        writer.put(step_bits, 2)
    lengths = []
    for _ in range(count):
        delta = rng.randrange(2**level_bits)
        if level_base + delta > greatest and rng.random() > RARE:
            delta = 0
        writer.put(delta, level_bits)
        put_random(writer, rng, step_bits if header.residual_step else 0)
        put_random(writer, rng, bias_bits)
        lengths.append(sequence_bits(geometry.block**2, levels_of(level_base + delta)))
    for bits in lengths:
        put_random(writer, rng, bits)


def residual_record(rng, geometry, plane, tile, predictive):
    """The record of a tile of plane 0 to 2."""
    writer = BitWriter()
    header = geometry.header
    inside = blocks_in_plane(geometry, plane, *tile)
    has_motion = predictive and not header.motion_tiles
    motion_mode, motion_mask = random_mask(rng, inside) if has_motion else (0, 0)
    residual_mode, residual_mask = random_mask(rng, inside)
    if has_motion:
        writer.put(motion_mode, 2)
    writer.put(residual_mode, 2)
    put_mask(writer, motion_mode, motion_mask)
    put_mask(writer, residual_mode, residual_mask)
    if motion_mask:
        put_vectors(writer, rng, header.window, popcount(motion_mask))
    if residual_mask:
        put_residuals(writer, rng, geometry, popcount(residual_mask))
    return writer.bytes()


def cells_of_tile(geometry, plane, tile, side):
    """How many squares of `side` samples of a motion tile lie at least partly in its plane."""
    count = 1
    for size, index in zip(geometry.plane_size(plane), tile):
        count *= ceil_div(min(geometry.tile_side(plane), size - index * geometry.tile_side(plane)), side)
    return count


def motion_record(rng, geometry, plane, tile, level):
    """The record of a motion tile of a predictive image."""
    writer = BitWriter()
    header = geometry.header
    motion_block = rng.randint(max(0, header.block_log2 - 2), 3) if rng.random() > RARE else 0
    palette_size = rng.randint(1, 8)
    explicit_bits = rng.randint(0, 12) if rng.random() > RARE else 13
    writer.put(motion_block, 2)
    writer.put(palette_size - 1, 3)
    writer.put(explicit_bits, 4)
    for _ in range(palette_size):
        put_random(writer, rng, 3 if header.two_references else 0)
        choice = rng.randint(0, 11) if header.shared_disparity else rng.choice([0, 11])
        writer.put(choice if rng.random() > RARE else rng.randrange(16), 4)
        put_random(writer, rng, 0 if geometry.is_keyed(level) else 1)
        put_random(writer, rng, explicit_bits * {10: 1, 11: 2}.get(choice, 0))
    cells = cells_of_tile(geometry, plane, tile, 4 * 2**motion_block)
    levels = levels_of(least_code(palette_size))
    put_random(writer, rng, sequence_bits(cells, levels))
    return writer.bytes()


def disparity_record(rng, geometry, plane, tile):
    """The record of a motion tile of a reference image."""
    writer = BitWriter()
    code = rng.randint(0, 18) if rng.random() > RARE else rng.randrange(32)
    near_end = rng.random() < 10 * RARE
    writer.put(rng.choice([-4096, 4095 - levels_of(code)]) if near_end else rng.randint(-300, 300), 13)
    writer.put(code, 5)
    cells = cells_of_tile(geometry, plane, tile, 2**geometry.header.disparity_grid_log2)
    put_random(writer, rng, sequence_bits(cells, levels_of(code)))
    return writer.bytes()
