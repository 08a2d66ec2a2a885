"""Opening a stream: header, sections and their sizes (FIL-4, FIL-6, FIL-8, IDX-4, IDX-5, KEY-1, RIG-1)."""

from crc32c import crc32c
from geometry import Geometry
from header import number, read_header
from integers import ceil_div
from stream_error import require


class Stream:
    """An opened stream: header, geometry, the sections as bytes, the codestreams.

    Readers of parts leave the crc of sections unchecked (FIL-6): whole=False.
    """

    def __init__(self, data, whole=True):
        self.header = read_header(data)
        self.geometry = Geometry(self.header)
        sections = read_sections(self.header, data)
        self.top, self.root, self.group, self.tile = sections[-4:]
        groups = ceil_div(self.geometry.image_count() * self.geometry.tiles_of_image(), 64)
        require(len(self.root) == 16 * ceil_div(groups, 64), "bad_section_size")
        require(len(self.group) % 16 == 0, "bad_section_size")
        self.codestreams = read_top_table(self.geometry, self.top)
        for (_, crc, _, _), section in zip(self.header.sections, sections):
            require(not whole or crc32c(section) == crc, "bad_section_crc")


def read_sections(header, data):
    """The bytes of all sections, after the checks of FIL-4."""
    end = header.header_bytes
    kinds = ([5] if header.camera_rig else []) + [1, 2, 3, 4]
    for expected, (kind, _, offset, size) in zip(kinds, header.sections):
        require(kind == expected and offset == end, "bad_section_table")
        end = offset + size
    for _, _, offset, size in header.sections:
        require(offset + size <= len(data), "truncated")
    require(end == len(data), "trailing_bytes")
    return [data[offset : offset + size] for _, _, offset, size in header.sections]


def read_top_table(geometry, top):
    """{(key image, plane): (codestream, sample_crc)} (KEY-1)."""
    keys = [image for image in geometry.images() if geometry.is_key(image)]
    end = 16 * 3 * len(keys)
    require(end <= len(top), "bad_section_size")
    codestreams = {}
    for i, (image, plane) in enumerate((image, plane) for image in keys for plane in range(3)):
        offset, size, crc = number(top, 16 * i, 8), number(top, 16 * i + 8, 4), number(top, 16 * i + 12, 4)
        require(offset == end and offset + size <= len(top), "bad_top_entry")
        end = offset + size
        codestreams[image, plane] = top[offset:end], crc
    require(end == len(top), "bad_section_size")
    return codestreams
