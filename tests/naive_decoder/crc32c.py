"""CRC-32C, byte by byte (FIL-5)."""

REFLECTED_POLYNOMIAL = int(f"{0x1EDC6F41:032b}"[::-1], 2)


def divided(byte):
    """Returns the CRC of one byte, computed bit by bit."""
    for _ in range(8):
        byte = byte // 2 ^ (REFLECTED_POLYNOMIAL if byte % 2 else 0)
    return byte


REMAINDERS = [divided(byte) for byte in range(256)]


def crc32c(data):
    """The CRC-32C of a bytes object: crc32c(b"123456789") = 0xE3069283."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc = crc >> 8 ^ REMAINDERS[crc & 0xFF ^ byte]
    return crc ^ 0xFFFFFFFF
