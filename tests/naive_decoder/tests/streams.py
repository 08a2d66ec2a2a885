"""The streams that the naive decoder and the program under test are compared on."""

# Scene, grid, size, depth, and the options of hmlfc encode.
ENCODED = [
    ("cards", "4x4", "24x20", 8, "--profile main --height 1 --window 7"),
    ("knights", "3x5", "13x18", 9,
     "--profile main --height 3 --cluster 1x2 --references 2x2 --block 2 --chroma 444"),
    ("glass", "5x2", "17x9", 12, "--profile main --method mc --references 3x3 --window 127 --quality 80"),
    ("noise", "2x3", "9x7", 10, "--profile main --method rlfc --height 1 --block 8"),
    ("cards", "1x1", "11x5", 8, "--lossless"),
    ("cards", "3x3", "40x24", 8, "--quality 40"),
    ("knights", "1x6", "12x36", 11, "--references 1x3 --chroma 420 --quality 70 --preset slow"),
    ("glass", "4x3", "16x16", 8, "--height 1 --block 2 --quality 80 --preset fast"),
    ("noise", "3x1", "1x1", 8, "--quality 100"),
    ("flat", "2x2", "7x33", 12, "--chroma 444 --block 8 --quality 20"),
]


def render(test, name, scene, grid, size, depth):
    """Renders views into the folder `name` of a CliTest."""
    test.hmlfc("synth", "--scene", scene, "--grid", grid, "--size", size, "--depth", depth, "-o", name)


def encoded_streams(test):
    """{name: bytes} of ENCODED, made by the program under test in the folder of a CliTest."""
    streams = {}
    for number, (scene, grid, size, depth, options) in enumerate(ENCODED):
        name = f"encoded{number}"
        render(test, name, scene, grid, size, depth)
        test.hmlfc("encode", name, "-o", f"{name}.hmlfc", *options.split())
        streams[name] = (test.folder / f"{name}.hmlfc").read_bytes()
    return streams
