"""Bit strings (CNV-4): one big integer each."""

from integers import signed
from stream_error import require


class BitString:
    """The bits of some bytes; bit 0 is the least significant bit of the first byte."""

    def __init__(self, data):
        self.value = int.from_bytes(data, "little")
        self.length = 8 * len(data)

    def field(self, position, bits):
        """The unsigned field at a position. One that ends past the last byte is `tile_overrun`."""
        require(position + bits <= self.length, "tile_overrun")
        return (self.value >> position) % 2**bits


class Cursor:
    """Reads fields of a bit string one after another."""

    def __init__(self, bit_string, position=0):
        self.bit_string = bit_string
        self.position = position

    def take(self, bits):
        """The next field, unsigned."""
        field = self.bit_string.field(self.position, bits)
        self.position += bits
        return field

    def take_signed(self, bits):
        """The next field, in two's complement."""
        return signed(self.take(bits), bits)

    def skip(self, bits):
        """Goes past bits without reading them; returns where they begin."""
        begin = self.position
        self.position += bits
        return begin
