"""Pictures without the program under test: PNG, PPM and colour."""

import math
import struct
import zlib


class Picture:
    """samples[(y * width + x) * 3 + channel]."""

    def __init__(self, width, height, samples):
        self.width, self.height, self.samples = width, height, samples

    def crop(self, x, y, width, height):
        rows = []
        for row in range(y, y + height):
            begin = (row * self.width + x) * 3
            rows += self.samples[begin : begin + width * 3]
        return Picture(width, height, rows)

    def pixel(self, x, y):
        begin = (y * self.width + x) * 3
        return self.samples[begin : begin + 3]

    def __eq__(self, other):
        return vars(self) == vars(other)

    def __repr__(self):
        return f"Picture({self.width}, {self.height}, ...)"


def _paeth(a, b, c):
    estimate = a + b - c
    distances = abs(estimate - a), abs(estimate - b), abs(estimate - c)
    return (a, b, c)[distances.index(min(distances))]


def _unfilter(kind, line, above, step):
    out = bytearray(line)
    for i, byte in enumerate(line):
        a = out[i - step] if i >= step else 0
        b = above[i]
        c = above[i - step] if i >= step else 0
        out[i] = (byte + (0, a, b, (a + b) // 2, _paeth(a, b, c))[kind]) & 255
    return out


def chunks_of(data):
    """(type, data) of each chunk of a PNG file; its checksums are right."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at = 8
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + size]
        assert struct.unpack_from(">I", data, at + 8 + size) == (zlib.crc32(kind + body),)
        yield kind.decode(), body
        at += size + 12


def without_sign(png):
    """The chunks of a PNG but for the one which says what command wrote it."""
    return [chunk for chunk in chunks_of(png) if chunk[0] != "tEXt"]


def read_png(path):
    """A PNG of 8 or 16 bits without interlacing; samples as stored, those of grey three times."""
    chunks = list(chunks_of(path.read_bytes()))
    width, height, bits, colour, _, _, interlace = struct.unpack(">IIBBBBB", dict(chunks)["IHDR"])
    assert colour in (0, 2) and interlace == 0 and bits in (8, 16), path
    channels = 3 if colour == 2 else 1
    raw = zlib.decompress(b"".join(body for kind, body in chunks if kind == "IDAT"))
    step = channels * bits // 8
    stride = width * step
    above, samples = bytes(stride), []
    for y in range(height):
        begin = y * (stride + 1)
        above = _unfilter(raw[begin], raw[begin + 1 : begin + 1 + stride], above, step)
        samples += above if bits == 8 else struct.unpack(f">{width * channels}H", bytes(above))
    return Picture(width, height, [sample for sample in samples for _ in range(3 // channels)])


def write_ppm(path, picture, maximum=255):
    code = "B" if maximum < 256 else "H"
    body = struct.pack(f">{len(picture.samples)}{code}", *picture.samples)
    path.write_bytes(b"P6 %d %d %d\n" % (picture.width, picture.height, maximum) + body)


def write_png(path, picture, bits=8, alpha=False):
    """Without filters. With `alpha`, each pixel has a fourth sample."""
    stride = picture.width * (4 if alpha else 3)
    lines = (picture.samples[at : at + stride] for at in range(0, len(picture.samples), stride))
    code = f">{stride}{'H' if bits == 16 else 'B'}"
    packed = zlib.compress(b"".join(b"\0" + struct.pack(code, *line) for line in lines))
    colour = 6 if alpha else 2
    header = struct.pack(">IIBBBBB", picture.width, picture.height, bits, colour, 0, 0, 0)
    data = b"\x89PNG\r\n\x1a\n"
    for kind, body in (b"IHDR", header), (b"IDAT", packed), (b"IEND", b""):
        check = zlib.crc32(kind + body)
        data += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", check)
    path.write_bytes(data)


def errors(a, b):
    """Squares of the differences over R, G and B and over Y, and the greatest difference."""
    rgb = luma = greatest = 0
    for at in range(0, len(a.samples), 3):
        p, q = a.samples[at : at + 3], b.samples[at : at + 3]
        differences = [abs(i - j) for i, j in zip(p, q)]
        rgb += sum(d * d for d in differences)
        luma += (ycocg(p)[0] - ycocg(q)[0]) ** 2
        greatest = max(greatest, *differences)
    return rgb, luma, greatest


def psnr(squares, count, peak=255):
    return 10 * math.log10(peak * peak * count / squares) if squares else "inf"


def ycocg(pixel):
    """(Y, Co, Cg) of YCoCg-R, specification COL-1."""
    red, green, blue = pixel
    co = red - blue
    t = blue + (co >> 1)
    cg = green - t
    return t + (cg >> 1), co, cg
