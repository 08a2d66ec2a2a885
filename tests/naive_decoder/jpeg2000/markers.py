"""Marker segments of a codestream of one component, one tile and one tile-part (T.800 annex A)."""

from .codestream_error import demand

SOC, SIZ, COD, QCD, COM = 0xFF4F, 0xFF51, 0xFF52, 0xFF5C, 0xFF64
SOT, SOD, EOC = 0xFF90, 0xFF93, 0xFFD9
REVERSIBLE_5_3 = 1
NO_QUANTIZATION = 0


class Codestream:
    """The parameters by name, and `packets`, the bytes between SOD and EOC.

    Raises CodestreamError where the markers are not those that KEY-2 asks for, for a plane of this shape.
    """

    def __init__(self, data, width, height, depth, signed):
        self.data = data
        self.position = 0
        self.width, self.height, self.depth, self.signed = width, height, depth, signed
        self.has_siz = False
        self.layers = self.exponents = None
        self._expect(SOC)
        readers = {SIZ: self._siz, COD: self._cod, QCD: self._qcd, COM: lambda segment: None}
        marker = self._take(2)
        demand(marker == SIZ, "SIZ does not follow SOC")
        while marker != SOT:
            demand(marker in readers, f"marker {marker:04X} in the main header")
            segment = self._segment()
            readers[marker](segment)
            marker = self._take(2)
        demand(None not in (self.layers, self.exponents), "COD or QCD is missing")
        demand(len(self.exponents) == 3 * self.decompositions + 1, "QCD does not fit the decompositions")
        self._tile_part(self.position - 2)

    def _take(self, size):
        demand(self.position + size <= len(self.data), "the codestream ends too early")
        self.position += size
        return int.from_bytes(self.data[self.position - size : self.position], "big")

    def _expect(self, marker):
        demand(self._take(2) == marker, f"marker {marker:04X} expected")

    def _segment(self):
        length = self._take(2)
        demand(length >= 2 and self.position + length - 2 <= len(self.data), "a marker segment is too long")
        self.position += length - 2
        return self.data[self.position - length + 2 : self.position]

    def _siz(self, segment):
        demand(not self.has_siz and len(segment) == 39, "SIZ is not that of one component")
        self.has_siz = True
        demand(segment[0] < 64, "extensions or high throughput in Rsiz")
        sizes = [int.from_bytes(segment[2 + 4 * i : 6 + 4 * i], "big") for i in range(8)]
        demand(sizes[:2] == [self.width, self.height], "another size")
        demand(sizes[2:4] == sizes[6:] == [0, 0], "not at the origin")
        demand(self.width <= sizes[4] and self.height <= sizes[5], "not one tile")
        demand(max(sizes[4:6]) < 2**31, "a tile is too large")
        demand(segment[34:36] == b"\0\1", "not one component")
        precision, step_x, step_y = segment[36:]
        demand(precision == self.depth - 1 + (128 if self.signed else 0), "another precision")
        demand(step_x == step_y == 1, "the component is subsampled")

    def _cod(self, segment):
        demand(self.layers is None and len(segment) >= 10, "COD is too short")
        style, self.progression = segment[0], segment[1]
        demand(style < 8, "Scod is out of range")
        self.has_sop, self.has_eph = style >> 1 & 1 == 1, style >> 2 & 1 == 1
        self.layers = int.from_bytes(segment[2:4], "big")
        demand(self.progression <= 4 and self.layers >= 1, "COD is out of range")
        demand(segment[4] == 0, "component transformation")
        self.decompositions = segment[5]
        width_log2, height_log2 = segment[6] + 2, segment[7] + 2
        self.block_width, self.block_height = 2**width_log2, 2**height_log2
        demand(max(width_log2, height_log2) <= 10 and width_log2 + height_log2 <= 12, "code-block size")
        self.block_style = segment[8]
        demand(self.decompositions <= (32 if self.progression < 2 else 15), "too many decompositions")
        demand(self.block_style < 64, "code-block style")
        demand(segment[9] == REVERSIBLE_5_3, "not the reversible 5/3 transform")
        greatest = bytes([255] * (self.decompositions + 1)) if style & 1 else b""
        demand(segment[10:] == greatest, "precincts are not of the greatest size")

    def _qcd(self, segment):
        demand(self.exponents is None and len(segment) >= 1, "QCD is too short")
        demand(segment[0] % 32 == NO_QUANTIZATION, "quantized")
        demand(all(byte % 8 == 0 for byte in segment[1:]), "reserved bits of an exponent")
        self.guard_bits = segment[0] // 32
        self.exponents = [byte // 8 for byte in segment[1:]]

    def _tile_part(self, begin):
        segment = self._segment()
        demand(len(segment) == 8, "SOT has another length")
        tile, length = int.from_bytes(segment[:2], "big"), int.from_bytes(segment[2:6], "big")
        demand(tile == 0 and segment[6] == 0 and segment[7] <= 1, "not one tile-part")
        self._expect(SOD)
        end = len(self.data) - 2
        demand(end >= self.position and self.data[end:] == EOC.to_bytes(2, "big"), "EOC is not at the end")
        demand(length in (0, end - begin), "Psot")
        self.packets = self.data[self.position : end]
