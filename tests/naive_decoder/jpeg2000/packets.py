"""Packets: which coding passes each layer holds of each code-block (T.800 B.9 to B.12)."""

from .codestream_error import demand

PROGRESSIONS = ("LRCP", "RLCP", "RPCL", "PCRL", "CPRL")
BYPASS, TERMINATE_ALL = 1, 4  # code-block styles
FIRST_BYPASS_PASS = 10


class HeaderBits:
    """The bits of a packet header: after a byte FF follow 7 bits, the first of 8 being a stuffed 0."""

    def __init__(self, data, position):
        self.data, self.position = data, position
        self.byte, self.left = 0, 0

    def bit(self):
        """The next bit."""
        if self.left == 0:
            self.left = 7 if self.byte == 0xFF else 8
            demand(self.position < len(self.data), "a packet header ends too early")
            self.byte = self.data[self.position]
            self.position += 1
        self.left -= 1
        return self.byte >> self.left & 1

    def number(self, bits):
        """The next bits as a number, the first being the greatest."""
        value = 0
        for _ in range(bits):
            value = 2 * value + self.bit()
        return value

    def end(self):
        """The position of the first byte after the header."""
        if self.byte == 0xFF:
            demand(self.position < len(self.data), "a packet header ends too early")
            self.position += 1
        return self.position


def number_of_passes(header):
    """The number of coding passes (T.800 table B.4)."""
    if header.bit() == 0:
        return 1
    if header.bit() == 0:
        return 2
    for bits, escape, base in ((2, 3, 3), (5, 31, 6)):
        value = header.number(bits)
        if value != escape:
            return base + value
    return 37 + header.number(7)


def passes_until_end(first_pass, style):
    """How many passes a codeword segment takes that begins with this pass (T.800 table D.9)."""
    if style & TERMINATE_ALL:
        return 1
    if style & BYPASS:
        if first_pass < FIRST_BYPASS_PASS:
            return FIRST_BYPASS_PASS - first_pass
        return 1 if first_pass % 3 == 0 else 2 - (first_pass - FIRST_BYPASS_PASS) % 3
    return 1000


def split_passes(block, new_passes, style):
    """How many of the new passes fall to the block's last codeword segment, the next one, and so on."""
    while new_passes > 0:
        room = passes_until_end(block.passes, style)
        taken = min(room, new_passes)
        starts = not block.segments or block.segments[-1][2]
        if starts:
            block.segments.append([0, b"", False])
        block.segments[-1][0] += taken
        block.segments[-1][2] = taken == room
        block.passes += taken
        new_passes -= taken
        yield block.segments[-1], taken


def read_block_header(header, part, number, layer, style):
    """Lengths [(segment, bytes)] that a packet adds to a code-block."""
    block = part.blocks[number]
    x, y = number % part.cols, number // part.cols
    if block.included:
        if header.bit() == 0:
            return []
    else:
        if not part.inclusion.at_most(x, y, layer, header.bit):
            return []
        block.included = True
        block.missing_planes = part.zero_planes.value(x, y, header.bit)
        demand(block.missing_planes <= part.planes, "more missing bit-planes than there are")
    passes = number_of_passes(header)
    while header.bit():
        block.length_bits += 1
    return [
        (segment, header.number(block.length_bits + taken.bit_length() - 1))
        for segment, taken in split_passes(block, passes, style)
    ]


def read_packet(codestream, position, parts, layer):
    """Reads one packet, of a precinct with these parts of subbands; returns where it ends."""
    data = codestream.packets
    if codestream.has_sop and data[position : position + 2] == b"\xff\x91":
        position += 6
    header = HeaderBits(data, position)
    lengths = []
    if header.bit():
        for part in parts:
            for number in range(len(part.blocks)):
                lengths += read_block_header(header, part, number, layer, codestream.block_style)
    position = header.end()
    if codestream.has_eph:
        demand(data[position : position + 2] == b"\xff\x92", "EPH is missing")
        position += 2
    for segment, length in lengths:
        demand(position + length <= len(data), "a packet ends too early")
        segment[1] += data[position : position + length]
        position += length
    return position


def packet_order(codestream, resolutions):
    """(layer, resolution, precinct) of all packets (T.800 B.12).

    The place of a precinct is that of its upper left corner on the grid of samples.
    """
    packets = [
        (layer, level, *precinct)
        for level, resolution in enumerate(resolutions)
        for precinct in resolution.precincts
        for layer in range(codestream.layers)
    ]

    def place(level, row, col):
        return row << codestream.decompositions - level, col << codestream.decompositions - level

    def key(packet):
        layer, level, *precinct = packet
        return {
            "LRCP": (layer, level, *precinct),
            "RLCP": (level, layer, *precinct),
            "RPCL": (level, *precinct, layer),
            "PCRL": (*place(level, *precinct), level, layer),
            "CPRL": (*place(level, *precinct), level, layer),
        }[PROGRESSIONS[codestream.progression]]

    return sorted(packets, key=key)


def read_packets(codestream, resolutions):
    """Reads all packets into the code-blocks of the resolutions' subbands."""
    position = 0
    for layer, level, row, col in packet_order(codestream, resolutions):
        position = read_packet(codestream, position, resolutions[level].precincts[row, col], layer)
