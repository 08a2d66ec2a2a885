"""Vector quantisation of light fields with entropy coding, after Levoy and Hanrahan, "Light Field Rendering" (1996).

4D tiles of RGB samples are replaced by the number of the nearest word of a trained codebook. The numbers have one
width, so that any tile can be looked up in the layer of numbers; the file is codebook and layer, deflated.

File: HEAD, then deflate of the codebook (words of uint8 samples) and the layer (uint16 each, tiles in row-major order).
Everything is exact: sums are integers below 2^24, so that float32 products give the same result in any order.
"""

import struct
import zlib

import numpy as np

HEAD = struct.Struct("<4s4H4BH")  # magic; rows, cols, height, width; tile; words - 1
MAGIC = b"VQ4D"
TILES = ((2, 2, 2, 2), (1, 1, 2, 2))  # views down, views right, rows, columns: theirs, then one for higher PSNR
MOST_SAMPLES = 120  # of a tile: 2 * 120 * 255^2 < 2^24
TRAINED_TILES, ROUNDS, CHUNK = 8192, 4, 512


def encode(views, tile, words):
    """The file. views: uint8 [row, col, y, x, RGB]; tile: of TILES; words: of the codebook, [1, 65536]."""
    tiles = _tiles_of(views, tile)
    codebook = train(tiles[spread(len(tiles))], words)
    layer = nearest(tiles, codebook).astype("<u2")
    head = HEAD.pack(MAGIC, *views.shape[:4], *tile, len(codebook) - 1)
    return head + zlib.compress(codebook.astype(np.uint8).tobytes() + layer.tobytes(), 9)


def spread(count):
    """At most TRAINED_TILES of `count` numbers, spread evenly over rows, columns and views alike: by the golden ratio."""
    step = int(count * 0.6180339887) | 1
    return np.unique(np.arange(min(count, TRAINED_TILES), dtype=np.int64) * step % count)


def train(samples, words):
    """Lloyd's algorithm from words spread over the samples by brightness. The result is in order of brightness, which
    makes neighbouring numbers alike for the entropy coder."""
    order = np.argsort(samples.sum(axis=1), kind="stable")
    codebook = samples[order[np.arange(words) * len(order) // words]].astype(np.int64)
    for _ in range(ROUNDS):
        chosen = nearest(samples, codebook)
        count = np.bincount(chosen, minlength=words)
        by_word = np.argsort(chosen, kind="stable")
        used = np.flatnonzero(count)
        starts = np.cumsum(count)[used] - count[used]
        sums = np.add.reduceat(samples[by_word].astype(np.int64), starts, axis=0)
        codebook[used] = (2 * sums + count[used, None]) // (2 * count[used, None])
    return codebook[np.argsort(codebook.sum(axis=1), kind="stable")]


def nearest(tiles, codebook):
    """The number of the nearest word of each tile, the first of equals."""
    if tiles.shape[1] > MOST_SAMPLES:
        raise ValueError(f"a tile has {tiles.shape[1]} samples, more than {MOST_SAMPLES}")
    words = codebook.astype(np.float32)
    norms, doubled = (words * words).sum(axis=1), -2 * words.T
    chosen = np.empty(len(tiles), np.int64)
    for i in range(0, len(tiles), CHUNK):
        scores = tiles[i : i + CHUNK].astype(np.float32) @ doubled
        scores += norms
        chosen[i : i + CHUNK] = np.argmin(scores, axis=1)
    return chosen


class Layer:
    """The file with its entropy coding undone, as it lies in memory while tiles are looked up."""

    def __init__(self, file):
        magic, *shape, words = HEAD.unpack_from(file)
        if magic != MAGIC:
            raise ValueError("not a file of vector quantisation")
        self.shape, self.tile, words = tuple(shape[:4]), tuple(shape[4:]), words + 1
        self.counts = tuple(-(-side // step) for side, step in zip(self.shape, self.tile))
        samples = 3 * int(np.prod(self.tile))
        content = zlib.decompress(file[HEAD.size :])
        self.held = len(content)
        self.codebook = np.frombuffer(content, np.uint8, words * samples).reshape(words, *self.tile, 3)
        self.numbers = np.frombuffer(content, "<u2", offset=words * samples).reshape(self.counts)
        if self.numbers.max() >= words:
            raise ValueError("a tile has a word that the codebook has not")

    def pixel(self, row, col, y, x):
        """RGB of one pixel: one number, three samples of a word."""
        place = tuple(np.floor_divide((row, col, y, x), self.tile))
        return self.codebook[self.numbers[place]][tuple(np.mod((row, col, y, x), self.tile))]

    def views(self):
        """All views, uint8 [row, col, y, x, RGB]."""
        tiles = self.codebook[self.numbers]  # counts, then tile, then RGB
        whole = tiles.transpose(0, 4, 1, 5, 2, 6, 3, 7, 8).reshape(*np.multiply(self.counts, self.tile), 3)
        return whole[tuple(slice(side) for side in self.shape)]


def _tiles_of(views, tile):
    """Tiles as rows of samples; sides that do not divide repeat their last samples."""
    padded = np.pad(views, [(0, -side % step) for side, step in zip(views.shape, tile)] + [(0, 0)], mode="edge")
    split = [part for side, step in zip(padded.shape, tile) for part in (side // step, step)]
    return padded.reshape(*split, 3).transpose(0, 2, 4, 6, 1, 3, 5, 7, 8).reshape(-1, 3 * int(np.prod(tile)))
