"""One block of one plane of one image, and all that it needs (section 8, MOT-10)."""

from functools import cache
from types import SimpleNamespace

from disparity import disparity_of
from index import find_record
from integers import clamp
from interpolation import eighths, interpolate, predict
from key_images import decode_key_plane
from motion import EXPLICIT_VECTOR, NO_MOTION, motion_of, place_of
from references import references_of, vector_to
from residual import read_residual
from tile_head import TileHead
from tile_mask import block_number
from vector import read_vector


class BlockDecoder:
    """Decodes blocks of an opened stream; keeps what it has decoded."""

    def __init__(self, stream):
        self.stream = stream
        self.key_plane = cache(lambda image, plane: decode_key_plane(stream, image, plane))
        self.tile_head = cache(lambda *arguments: TileHead(stream, *arguments))
        self.entry = cache(self._entry)
        self.decode_image_block = cache(self._decode_image_block)

    def decode(self, row, col, plane, block_x, block_y, level=0):
        """The stages of the block of view (row, col) at each level from the first down to `level` (DEC-1, EXT-5)."""
        geometry = self.stream.geometry
        first = level
        while first < geometry.top and not geometry.is_key(geometry.ancestor(first, row, col)):
            first += 1
        images = [geometry.ancestor(l, row, col) for l in range(first, level - 1, -1)]
        return [
            self.decode_image_block(tuple(images[: i + 1]), plane, block_x, block_y)
            for i in range(len(images))
        ]

    def _decode_image_block(self, images, plane, block_x, block_y):
        """The block of the last of `images`, whose parent is the one before; none: P is 0 (DEC-3, DEC-6).

        Stages that the block does not have are None.
        """
        geometry = self.stream.geometry
        image, side = images[-1], geometry.block
        stages = SimpleNamespace(image=image, parent=None, reference=None, prediction=None, residual=None)
        if geometry.is_key(image):
            stages.sample = self._key_block(image, plane, block_x, block_y)
            return stages
        stages.parent = [[0] * side for _ in range(side)]
        if len(images) > 1:
            stages.parent = self.decode_image_block(images[:-1], plane, block_x, block_y).sample
        entry = self.entry(image, plane, block_x, block_y)
        if entry.parts and geometry.is_keyed(image[0]):
            stages.parent = [[0] * side for _ in range(side)]  # EXT-5
        stages.residual = entry.residual
        lo, hi = geometry.interval(plane)
        stages.prediction = stages.parent
        if entry.parts:
            stages.reference = self._reference(entry.parts, plane, block_x, block_y)
            stages.prediction = [
                [clamp(p + entry.sign * r, lo, hi) for p, r in zip(*rows)]
                for rows in zip(stages.parent, stages.reference)
            ]
        stages.sample = stages.prediction
        if entry.residual:
            stages.sample = [
                [clamp(a + r, lo, hi) for a, r in zip(*rows)]
                for rows in zip(stages.prediction, entry.residual)
            ]
        return stages

    def _key_block(self, image, plane, block_x, block_y):
        """DEC-2; 0 where the block reaches past the plane."""
        rows, side = self.key_plane(image, plane), self.stream.geometry.block
        padded = [row[block_x * side :][:side] for row in rows[block_y * side :][:side]]
        padded = [row + [0] * (side - len(row)) for row in padded]
        return padded + [[0] * side for _ in range(side - len(padded))]

    def _entry(self, image, plane, block_x, block_y):
        """Sign, residual and parts of a block that is not one of a key image (TIL-5, MOT-5).

        parts: (reference image, vector in eighths of a sample) of each reference, none without motion;
        residual is None without one.
        """
        stream, geometry = self.stream, self.stream.geometry
        predictive = geometry.reference_of(image) != image
        entry = SimpleNamespace(sign=1, residual=None, parts=[])
        if predictive and stream.header.motion_tiles:
            entry.sign, entry.parts = self._tiled_motion(image, plane, block_x, block_y)
        tile = block_x // 8, block_y // 8
        block = block_number(block_x % 8, block_y % 8)
        record = find_record(stream, geometry.tile_number(image, plane, *tile))
        if record is not None:
            head = self.tile_head(record, predictive and not stream.header.motion_tiles, plane, tile)
            if head.motion_mask >> block & 1:
                entry.sign, vector = read_vector(head, stream.header.window, block)
                entry.parts = [(geometry.reference_of(image), tuple(8 * component for component in vector))]
            if head.residual_mask >> block & 1:
                entry.residual = read_residual(stream, head, plane, block)
        return entry

    def _tiled_motion(self, image, plane, block_x, block_y):
        """(sign, parts) by the block's motion tile (MOT-4 to MOT-9)."""
        stream, header = self.stream, self.stream.header
        motion_plane, x, y, doubled = place_of(stream, plane, block_x, block_y)
        motion = motion_of(stream, image, motion_plane, x, y)
        if motion.choice == NO_MOTION:
            return motion.sign, []
        disparity = None
        if motion.choice != EXPLICIT_VECTOR:
            disparity = disparity_of(stream, image, motion_plane, motion, x, y)
        parts = []
        for reference in references_of(stream.geometry, image, motion):
            vector = vector_to(header, image, reference, motion, disparity)
            parts.append((reference, tuple(eighths(v, header.vector_precision, doubled) for v in vector)))
        return motion.sign, parts

    def _reference(self, parts, plane, block_x, block_y):
        """Rows of R(x, y) of a block (MOT-9); ref(x + dx, y + dy) of DEC-3 where vectors are whole.

        The blocks of each reference that are touched are read first, row by row (DEC-7, MOT-10).
        """
        geometry = self.stream.geometry
        side = geometry.block
        width, height = geometry.plane_size(plane)
        columns = range(block_x * side, min((block_x + 1) * side, width))
        rows = range(block_y * side, min((block_y + 1) * side, height))
        reference = [[0] * side for _ in range(side)]
        for image, vector in parts:
            self._read_touched(image, plane, [(x, y, *vector) for y in rows for x in columns])
        for y in rows:
            for x in columns:
                interpolated = [
                    interpolate(lambda a, b, of=image: self._ref(of, plane, a, b), x, y, *vector)
                    for image, vector in parts
                ]
                reference[y - rows[0]][x - columns[0]] = predict(interpolated)
        return reference

    def _read_touched(self, image, plane, places):
        """Reads the key plane, or the blocks that ref touches at the places (x, y, ux, uy), row by row."""
        geometry = self.stream.geometry
        if geometry.is_key(image):
            self.key_plane(image, plane)
            return
        width, height = geometry.plane_size(plane)
        touched = set()

        def touch(x, y):
            inside = clamp(x, 0, width - 1), clamp(y, 0, height - 1)
            touched.add((inside[1] // geometry.block, inside[0] // geometry.block))
            return 0

        for place in places:
            interpolate(touch, *place)
        for block_y, block_x in sorted(touched):
            self.entry(image, plane, block_x, block_y)

    def _ref(self, image, plane, x, y):
        """ref(x, y) (DEC-4, DEC-5): a sample of a key image, or a residual."""
        geometry = self.stream.geometry
        width, height = geometry.plane_size(plane)
        x, y = clamp(x, 0, width - 1), clamp(y, 0, height - 1)
        if geometry.is_key(image):
            return self.key_plane(image, plane)[y][x]
        side = geometry.block
        residual = self.entry(image, plane, x // side, y // side).residual
        return residual[y % side][x % side] if residual else 0
