"""CRC-32C, bit by bit (FIL-5)."""

REFLECTED_POLYNOMIAL = int(f"{0x1EDC6F41:032b}"[::-1], 2)


def crc32c(data):
    """The CRC-32C of a bytes object: crc32c(b"123456789") = 0xE3069283."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc // 2 ^ (REFLECTED_POLYNOMIAL if crc % 2 else 0)
    return crc ^ 0xFFFFFFFF
