"""A 4D Haar wavelet with sparse, directly addressed coefficients, after Peter and Strasser, "The Wavelet Stream" (2001).

Cubes of 8^4 samples of each of three colour channels have three levels of the 4D Haar transform: a node of a tree turns
one value into 16 by 15 details. Details are quantised, zeros are not stored, and a node without any below it is not
there. Each node says where its children are, so that a pixel takes one root and at most three nodes of each channel;
nothing is entropy coded.

File: HEAD, uint32 for each cube and channel (where its record lies), records. Record: int32 mean, root node. Node:
uint16 mask of its details, bit 15: values of 16 bits instead of 8; above the lowest level uint16 mask of children and
for each the uint16 distance of its node from the record; then the values. All arithmetic is on integers.
"""

import struct

import numpy as np

HEAD = struct.Struct("<4s5H")  # magic; rows, cols, height, width; step
MAGIC = b"HW4D"
SIDE = 8
STEPS = (5, 3, 5)  # of the channels, for about the same error in RGB; units of step / 16
LEAST_STEP, MOST_STEP = 8, 4095  # from 8 on values fit 16 bits
WIDE = 1 << 15
SIGNS = np.array([[1 - 2 * (bin(i & j).count("1") & 1) for j in range(16)] for i in range(16)], np.int64)


def quantised(views, step):
    """Arrays of int64 over cubes and channels: the means [n], then details [n, 15], [n, 16, 15], [n, 16, 16, 15]."""
    padded = np.pad(views, [(0, -side % SIDE) for side in views.shape[:4]] + [(0, 0)], mode="edge").astype(np.int64)
    red, green, blue = np.moveaxis(padded, -1, 0)
    low = np.stack([red + 2 * green + blue, red - blue, 2 * green - red - blue], axis=-1)
    details = []
    for level in (1, 2, 3):
        transformed = _grouped(low) @ SIGNS
        unit = 4**level * step * np.array(STEPS)  # 16 times a step of the channel
        details = [_grouped(array) for array in details] + [_divided(transformed[..., 1:], unit[:, None])]
        low = transformed[..., 0]
    flat = [array.reshape(-1, *array.shape[5:]) for array in reversed(details)]
    return [_divided(low, unit).reshape(-1), *flat]


def views_of(coefficients, shape, step):
    """The inverse: uint8 [row, col, y, x, RGB] of shape (rows, cols, height, width)."""
    means, *details = coefficients
    values = means
    for level, array in enumerate(details):
        values = values[..., None] + 4**level * (array @ SIGNS[1:])
    counts = [-(-side // SIDE) for side in shape]
    values = values.reshape(*counts, 3, *[2] * 12)
    order = [axis for a in range(4) for axis in (a, 5 + a, 9 + a, 13 + a)]
    whole = values.transpose(*order, 4).reshape(*[count * SIDE for count in counts], 3)
    return rgb(whole * np.array(STEPS) * step)[tuple(slice(side) for side in shape)]


def rgb(values):
    """uint8 RGB of channels in units of 1/1024."""
    luma, orange, green = np.moveaxis(np.asarray(values), -1, 0)
    summed = np.stack([luma - green + 2 * orange, luma + green, luma - green - 2 * orange], axis=-1)
    return np.clip((summed + 2048) >> 12, 0, 255).astype(np.uint8)


def encode(views, step):
    """The file. views: uint8 [row, col, y, x, RGB]; step: [LEAST_STEP, MOST_STEP], the larger the coarser."""
    return pack(quantised(views, step), views.shape[:4], step)


def pack(coefficients, shape, step):
    means, *details = coefficients
    present = [array.any(axis=-1) for array in details]
    present[1] |= present[2].any(axis=-1)
    masks = [(array != 0) @ (1 << np.arange(15)) for array in details]
    places, records = [], bytearray()
    begin = HEAD.size + 4 * len(means)
    for cube, mean in enumerate(means):
        places.append(begin + len(records))
        record = bytearray(struct.pack("<i", mean))
        _put(record, (cube,), details, masks, present)
        records += record
    return HEAD.pack(MAGIC, *shape, step) + np.array(places, "<u4").tobytes() + bytes(records)


def _put(record, place, details, masks, present):
    """Appends the node at `place`: cube, and child of each level above it; then those below."""
    level = len(place) - 1
    values = details[level][place]
    values = values[values != 0]
    wide = len(values) > 0 and max(values.max(), -1 - values.min()) > 127
    record += struct.pack("<H", int(masks[level][place]) | (WIDE if wide else 0))
    children = np.flatnonzero(present[level + 1][place]) if level < 2 else []
    pointers = len(record) + 2
    if level < 2:
        record += struct.pack("<H", sum(1 << int(child) for child in children)) + bytes(2 * len(children))
    record += values.astype("<i2" if wide else "i1").tobytes()
    for number, child in enumerate(children):
        struct.pack_into("<H", record, pointers + 2 * number, len(record))
        _put(record, (*place, child), details, masks, present)


class Reader:
    """Random access. Keeps the nodes that it has read: `bytes` counts them, `samples` the values computed from them."""

    def __init__(self, file):
        magic, *shape, self.step = HEAD.unpack_from(file)
        if magic != MAGIC:
            raise ValueError("not a file of wavelet coefficients")
        self.file, self.shape = file, tuple(shape)
        self.counts = tuple(-(-side // SIDE) for side in self.shape)
        self.kept = {}
        self.bytes = self.samples = 0

    def pixel(self, row, col, y, x):
        """RGB of one pixel."""
        cube = int(np.ravel_multi_index((row // SIDE, col // SIDE, y // SIDE, x // SIDE), self.counts))
        children = [sum((v >> bit & 1) << (3 - axis) for axis, v in enumerate((row, col, y, x))) for bit in (2, 1, 0)]
        return rgb([self._value(3 * cube + channel, children) * STEPS[channel] * self.step for channel in range(3)])

    def _value(self, cube, children):
        begin, value = self._record(cube)
        at = 4
        for level, child in enumerate(children):
            coded, pointers = self._node(begin, at, level == 2)
            value += 4**level * int(coded @ SIGNS[1:, child])
            at = pointers.get(child)
            if at is None:
                break
        return value

    def _record(self, cube):
        if cube not in self.kept:
            begin = struct.unpack_from("<I", self.file, HEAD.size + 4 * cube)[0]
            self.kept[cube] = begin, struct.unpack_from("<i", self.file, begin)[0]
            self.bytes += 8
        return self.kept[cube]

    def _node(self, begin, at, lowest):
        """(15 details, {child: distance of its node from the record})"""
        key = begin, at
        if key not in self.kept:
            place = begin + at
            mask = struct.unpack_from("<H", self.file, place)[0]
            place += 2
            pointers = {}
            if not lowest:
                there = struct.unpack_from("<H", self.file, place)[0]
                found = [child for child in range(16) if there >> child & 1]
                pointers = dict(zip(found, struct.unpack_from(f"<{len(found)}H", self.file, place + 2)))
                place += 2 + 2 * len(found)
            coded = np.zeros(15, np.int64)
            where = [i for i in range(15) if mask >> i & 1]
            kind = np.dtype("<i2" if mask & WIDE else "i1")
            coded[where] = np.frombuffer(self.file, kind, len(where), place)
            self.kept[key] = coded, pointers
            self.bytes += place + kind.itemsize * len(where) - begin - at
            self.samples += 16
        return self.kept[key]


def _grouped(array):
    """From [row, col, y, x, channel, ...] to half the sides and, after the channel, 16 places of 2^4."""
    halves = [part for side in array.shape[:4] for part in (side // 2, 2)]
    split = array.reshape(*halves, *array.shape[4:])
    rest = range(9, split.ndim)
    return split.transpose(0, 2, 4, 6, 8, 1, 3, 5, 7, *rest).reshape(*halves[::2], array.shape[4], 16, *array.shape[5:])


def _divided(values, unit):
    """16 * values / unit, rounded to zero by a sixth of a unit more than to the nearest."""
    return np.sign(values) * ((48 * np.abs(values) + unit) // (3 * unit))
