"""What is asked of a light field, and what it costs where pictures are coded whole."""

from dataclasses import astuple, dataclass

BLOCK = 4  # pixels a side
PLACES = 4


@dataclass
class Cost:
    """bytes: read of the file; samples: computed; held: bytes kept for later requests, next to the file."""

    bytes: int
    samples: int
    held: int


def regions(field):
    """{name: pairs (cold, warm)}: requests are rectangles (row, col, x, y, width, height) of pixels of views. A cold request
    is the first after opening the file; the warm one follows it, one block or one view on. Pixels and blocks are asked for
    at PLACES x PLACES places of the middle view.

    A frame is that of a camera close to the scene: each view gives its own part of it."""
    row, col = field.rows // 2, field.cols // 2
    steps = [side // PLACES // BLOCK * BLOCK for side in (field.width, field.height)]
    places = [(steps[0] * i, steps[1] * j) for j in range(PLACES) for i in range(PLACES)]
    width, height = field.width // field.cols, field.height // field.rows

    def at_places(side):
        return [([(row, col, x, y, side, side)], [(row, col, x + BLOCK, y, side, side)]) for x, y in places]

    def frame(right):
        return [(r, c, min(c * width + right, field.width - width), r * height, width, height)
                for r in range(field.rows) for c in range(field.cols)]

    return {
        "pixel": at_places(1),
        "block": at_places(BLOCK),
        "view": [([(row, col, 0, 0, field.width, field.height)], [(row, col + 1, 0, 0, field.width, field.height)])],
        "frame": [(frame(0), frame(BLOCK))],
    }


def pixels(rectangles):
    """Places (row, col, y, x)."""
    for row, col, x, y, width, height in rectangles:
        for down in range(y, y + height):
            for right in range(x, x + width):
                yield row, col, down, right


def pairs(field, open_client):
    """{name: (Cost cold, Cost warm)}, means over the places of a region. open_client() gives a function from rectangles to
    the cost of a request."""
    costs = {}
    for name, asked in regions(field).items():
        clients = [(open_client(), both) for both in asked]
        costs[name] = means([[client(request) for request in both] for client, both in clients])
    return costs


def means(found):
    """(Cost cold, Cost warm) of pairs, rounded to integers."""
    return [Cost(*(round(sum(figures) / len(found)) for figures in zip(*map(astuple, costs)))) for costs in zip(*found)]


def whole_pictures(field, picture_bytes, order, alone):
    """A client of pictures that are coded whole, and kept decoded. picture_bytes: in coding order; order: the view of
    each. alone: a picture needs no other; else it is taken to need all before it. Which of those a video really needs is
    not looked up, and pictures that are coded ahead of their turn are not counted."""
    kept = set()
    place = {view: number for number, view in enumerate(order)}
    samples = 3 * field.width * field.height

    def request(rectangles):
        needed = {place[row * field.cols + col] for row, col, *_ in rectangles}
        if not alone:
            needed = set(range(1 + max(needed)))
        new = needed - kept
        kept.update(new)
        return Cost(sum(picture_bytes[picture] for picture in new), samples * len(new), samples * len(kept))

    return request
