"""Writes bit strings (CNV-4)."""


class BitWriter:
    """Appends fields; `bytes()` pads with 0 bits to a whole byte."""

    def __init__(self):
        self.value, self.length = 0, 0

    def put(self, field, bits):
        """Appends the lowest bits of a field; a negative one in two's complement."""
        self.value += field % 2**bits << self.length
        self.length += bits

    def bytes(self):
        """The bit string."""
        return self.value.to_bytes((self.length + 7) // 8, "little")
