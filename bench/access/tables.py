"""The tables of docs/results/access.md."""

from result_file import table

LABELS = {
    "extended": "HMLFC extended", "main": "HMLFC main", "rlfc": "RLFC", "mc": "MC", "vq": "vector quantisation",
    "extended-as-vq": "HMLFC extended, at that PSNR",
    "haar": "4D Haar wavelet", "x265-intra": "x265 all-intra", "x265-inter": "x265 inter", "jpeg": "JPEG of each view",
    "jpeg2000": "JPEG 2000 of each view", "pleno": "JPEG Pleno",
}
REGIONS = ("pixel", "block", "view", "frame")
# JPEG Pleno Part 2 reference software (JPLM), 4D transform mode, measured once by hand on whole light fields and not by
# this bench: light field, its blocks, bpp, PSNR over RGB in dB, bpp of HMLFC extended and its PSNR.
QUOTED = (
    ("Antinous 9x9", "9x9 views of 64x64", 0.0184, 39.48, 0.0118, 39.5),
    ("Antinous 9x9", "3x3 views of 64x64", 0.0553, 39.73, 0.0118, 39.5),
    ("Antinous 9x9", "1 view of 64x64", 0.200, 39.12, 0.0118, 39.5),
    ("Chess 16x16", "16x16 views of 64x64", 0.0690, 39.24, 0.0712, 39),
    ("Lego Knights 17x17", "17x17 views of 64x64", 0.245, 36.12, 0.434, 36.5),
    ("a lenslet light field 9x9", "all views", 0.0926, 39.6, 0.186, 39.6),
    ("a 17x17 light field with refraction", "all views", 0.705, 31.5, 0.379, 31.6),
)
NOTES = (
    "*Rate*: of each method the fewest bits that reach the PSNR of the heading, or the highest PSNR that it reaches; `8x8 views` are "
    "the middle of the light field, so headers and key images weigh more than in a whole one. CPU seconds are "
    "those of all threads; vector quantisation and the wavelet are prototypes in Python, whose seconds compare with nothing.",
    "*Cold* is the first request after opening the file, whose head is not counted; *warm* the next one, a block, a view or a step "
    "of the camera further. Pixels and blocks are means over 16 places. *Bytes* are read of the file; *%* is the random-access "
    "ratio, bits needed cold of those of the file; *samples* are computed, key images whole, blocks of HMLFC one by one; "
    "*held* is kept for later requests, beside the file. A *frame* is that of a camera close to the scene, which takes its own part of "
    "each view.",
    "Vector quantisation undoes its entropy coding first and holds the layer below. The wavelet holds the nodes read. "
    "x265 inter is taken to need all views up to the one asked for, in their order.",
)


def tables(results):
    """Pairs (what a table shows, its lines)."""
    made = [("What the columns say", ["\n\n".join(NOTES)])]
    for field in results["light_fields"]:
        title = f"{field['name']}, {field['rows']}x{field['cols']} views of {field['width']}x{field['height']}, {field['target']:g} dB"
        made += [(f"Rate: {title}", rates(field)), (f"Cost of access: {title}", accesses(field))]
    return [*made, ("JPEG Pleno, quoted", [
        "Measured once with its reference software in 4D transform mode on whole light fields, beside an earlier encoder "
        "of HMLFC, not by this bench. A 4D block decodes as a whole: with blocks of all views, one view takes the whole file. "
        "`--pleno` runs it here where it is installed.", "", *quoted()])]


def rates(field):
    pixels = field["rows"] * field["cols"] * field["width"] * field["height"]
    rows = [(LABELS[name], f"{8 * row['bytes'] / pixels:.4f}", f"{row['psnr']:.2f}", row["bytes"], f"{row['encode']:.1f}",
             "-" if row["decode"] is None else f"{row['decode']:.2f}") for name, row in field["methods"].items()]
    return table(("method", "bpp", "PSNR RGB", "file bytes", "encode CPU s", "decode CPU s"), rows)


def accesses(field):
    rows = []
    for region in REGIONS:
        for name, row in field["methods"].items():
            if region in row["regions"]:
                cold, warm = row["regions"][region]
                rows.append((region, LABELS[name], cold["bytes"], f"{100 * cold['bytes'] / row['bytes']:.1f}", cold["samples"],
                             warm["bytes"], warm["samples"], f"{warm['held'] / 1024:.1f}"))
    head = ("region", "method", "cold bytes", "%", "cold samples", "warm bytes", "warm samples", "held KiB")
    return table(head, rows)


def quoted():
    head = ("light field (quoted)", "4D block", "JPEG Pleno, bpp at dB", "HMLFC extended, bpp at dB")
    return table(head, [(name, block, f"{bpp:.4f} at {db:.2f}", f"{ours:.4f} at {ours_db:.1f}")
                        for name, block, bpp, db, ours, ours_db in QUOTED])
