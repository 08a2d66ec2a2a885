"""Random streams with every tool of both profiles, written from the specification.

The key images are those of a donor, an opened stream whose images are all key images.
"""

from types import SimpleNamespace

from bit_writer import BitWriter
from crc32c import crc32c
from geometry import Geometry
from header import FIELDS, FLAGS, MAGIC
from integers import ceil_div
from random_records import disparity_record, motion_record, residual_record


def random_header(rng, donor):
    """Header fields by name; the shape of a view is the donor's."""
    header = SimpleNamespace(
        rows=rng.randint(1, 5), cols=rng.randint(1, 5), block_log2=rng.randint(1, 3),
        window=rng.choice([0, 1, 2, 7, 30, 127]), cluster_rows=rng.randint(1, 3),
        cluster_cols=rng.randint(2, 3), tree_height=rng.randint(0, 2), profile=rng.choice([0, 1, 1, 1]),
    )
    for name in ("width", "height", "depth", "chroma_format"):
        setattr(header, name, getattr(donor.header, name))
    random_tools(rng, header)
    header.levels = {
        level: (rng.randint(1, 5), rng.randint(1, 5),
                rng.randint(0, 1) if header.level_keys and level < header.tree_height else 0)
        for level in range(header.tree_height + 1)
    }
    return header


def random_tools(rng, header):
    """Flags and their fields (EXT-1, EXT-2)."""
    for name, _ in FLAGS:
        setattr(header, name, header.profile == 1 and rng.random() < 0.6)
    header.lossy_keys = False
    for name, needed in FLAGS:
        if needed and not getattr(header, needed):
            setattr(header, name, False)
    header.vector_precision = rng.randint(1, 3) if header.subpel_vectors else 0
    header.disparity_precision = rng.randint(header.vector_precision, 5) if header.shared_disparity else 0
    header.motion_tile_log2 = rng.randint(5, 7) if header.motion_tiles else 0
    header.disparity_grid_log2 = rng.randint(2, 5) if header.shared_disparity else 0
    header.row_scale = rng.choice([16, -16, rng.randint(-127, 127)]) if header.shared_disparity else 0


def header_bytes(header, sections):
    """The header (FIL-1) of a stream with these four sections."""
    size = 44 + 4 * len(header.levels) + 100
    flags = sum(2**bit for bit, (name, _) in enumerate(FLAGS) if getattr(header, name))
    parts = [MAGIC, bytes([1, header.profile]), size.to_bytes(2, "little"), flags.to_bytes(4, "little")]
    parts += [getattr(header, name).to_bytes(width, "little") for name, _, width, _, _ in FIELDS]
    parts += [bytes([header.vector_precision, header.disparity_precision, header.motion_tile_log2,
                     header.disparity_grid_log2, header.row_scale % 256, 0, 0, 0, 0])]
    parts += [bytes([*header.levels[level], 0]) for level in sorted(header.levels, reverse=True)]
    offset = size
    for kind, section in enumerate(sections, 1):
        parts += [kind.to_bytes(4, "little"), crc32c(section).to_bytes(4, "little"),
                  offset.to_bytes(8, "little"), len(section).to_bytes(8, "little")]
        offset += len(section)
    head = b"".join(parts)
    return head + crc32c(head).to_bytes(4, "little")


def top_section(rng, geometry, donor):
    """KEY-1, with codestreams of the donor."""
    planes = [[entry for (_, plane), entry in donor.codestreams.items() if plane == p] for p in range(3)]
    keys = [image for image in geometry.images() if geometry.is_key(image)]
    chosen = [rng.choice(planes[p]) for _ in keys for p in range(3)]
    offset, table = 16 * len(chosen), b""
    for codestream, crc in chosen:
        table += offset.to_bytes(8, "little") + len(codestream).to_bytes(4, "little")
        table += crc.to_bytes(4, "little")
        offset += len(codestream)
    return table + b"".join(codestream for codestream, _ in chosen)


def random_record(rng, geometry, image, plane, tile):
    """A record for a tile."""
    predictive = geometry.reference_of(image) != image
    if plane < 3:
        return residual_record(rng, geometry, plane, tile, predictive)
    if predictive:
        return motion_record(rng, geometry, plane, tile, image[0])
    return disparity_record(rng, geometry, plane, tile) if geometry.header.shared_disparity else b"\0"


def tile_records(rng, geometry, density):
    """{tile number: record} of the tiles that are not empty."""
    records = {}
    for image in geometry.images():
        for plane in geometry.planes:
            cols, rows = geometry.tiles(plane)
            for tile in ((x, y) for y in range(rows) for x in range(cols)):
                if rng.random() < density:
                    number = geometry.tile_number(image, plane, *tile)
                    records[number] = random_record(rng, geometry, image, plane, tile)
    return records


def index_sections(rng, records, groups):
    """(ROOT, GROUP, TILE) that lead to the records (IDX-4 to IDX-6)."""
    root, group_section, tile_section = b"", b"", b""
    for first_group in range(0, groups, 64):
        mask, first = 0, len(group_section) // 16
        for group in range(first_group, min(first_group + 64, groups)):
            tiles = [tile for tile in range(64 * group, 64 * group + 64) if tile in records]
            if not tiles:
                continue
            mask += 1 << group % 64
            ends = [sum(len(records[tile]) for tile in tiles[: i + 1]) for i in range(len(tiles))]
            bits = rng.randint(max(1, ends[-1].bit_length()), 32)
            writer = BitWriter()
            for end in ends:
                writer.put(end, bits)
            place = len(tile_section) + (bits << 48)
            tile_mask = sum(1 << tile % 64 for tile in tiles)
            group_section += tile_mask.to_bytes(8, "little") + place.to_bytes(8, "little")
            tile_section += writer.bytes() + b"".join(records[tile] for tile in tiles)
        root += mask.to_bytes(8, "little") + first.to_bytes(8, "little")
    return root, group_section, tile_section


def random_stream(rng, donor):
    """The bytes of a stream. Views have the donor's shape."""
    header = random_header(rng, donor)
    geometry = Geometry(header)
    records = tile_records(rng, geometry, rng.choice([0.1, 0.7, 1]))
    groups = ceil_div(geometry.image_count() * geometry.tiles_of_image(), 64)
    sections = [top_section(rng, geometry, donor), *index_sections(rng, records, groups)]
    return header_bytes(header, sections) + b"".join(sections)
