"""Where the surfaces are that the rays of a frame meet (section 9 of docs/rendering.md)."""

from types import SimpleNamespace

from disparity_map import block_of_map
from integers import clamp
from ray import Ray
from stream_error import StreamError
from view_weights import view_weights

CELL = 4  # pixels along the side of a cell (SRF-1)
STEPS = 2
HALF, MOST = 32768, 40960  # weights of the median and of its support (SRF-3)
REACH = 2**11


class Surface:
    """Displacements of the cells of a frame with geometry.

    `looked_up` has the disparities looked up so far (SRF-5): {(row, col, block_x, block_y): (D, confidence)}.
    """

    def __init__(self, stream, record):
        self.stream, self.record = stream, record
        self.looked_up, self.cells = {}, {}

    def cell_of(self, i, j):
        """The cell of pixel (i, j): its ray; if that is inside, proposals and median; displacement E."""
        place = i // CELL, j // CELL
        if place not in self.cells:
            self.cells[place] = self._cell(*place)
        return self.cells[place]

    def _cell(self, ci, cj):
        width, height = self.record["frame_width"], self.record["frame_height"]
        ray = Ray(self.record, min(8 * ci + 4 - width, width - 1), min(8 * cj + 4 - height, height - 1))
        cell = SimpleNamespace(ci=ci, cj=cj, ray=ray, displacement=0)
        if not ray.outside:
            weights = view_weights(self.record, ray)
            cell.proposals = [self._proposal(ray, view, weight) for view, weight in weights.items()]
            cell.median, cell.displacement = agreed(cell.proposals)
        return cell

    def _proposal(self, ray, view, weight):
        """The proposal of a view, with its steps (SRF-3)."""
        proposal = SimpleNamespace(view=view, weight=weight, steps=[], displacement=0)
        for _ in range(STEPS):
            x, y = ray.x(view[1], proposal.displacement), ray.y(view[0], proposal.displacement)
            disparity, confidence = self._disparity(view, x, y)
            proposal.displacement = displacement_of(disparity, confidence, self.record["fine"], self.record["focus"])
            step = SimpleNamespace(x=x, y=y, disparity=disparity, confidence=confidence)
            step.displacement = proposal.displacement
            proposal.steps.append(step)
        return proposal

    def _disparity(self, view, x, y):
        """(D, confidence) of the block at a place of a view; (0, 0) where it has an error."""
        side, record = self.stream.geometry.block, self.record
        pixel_x = (clamp(x, 0, (record["width"] - 1) * 2**12) + 2**11) >> 12
        pixel_y = (clamp(y, 0, (record["height"] - 1) * 2**12) + 2**11) >> 12
        block = *view, pixel_x // side, pixel_y // side
        if block not in self.looked_up:
            try:
                self.looked_up[block] = block_of_map(self.stream, *block)
            except StreamError:
                self.looked_up[block] = 0, 0
        return self.looked_up[block]


def displacement_of(disparity, confidence, fine, focus):
    """The displacement to which a block moves a proposal (SRF-3)."""
    counted = 0 if abs(disparity) < fine else disparity
    return clamp(counted - focus, -(2**15), 2**15 - 1) if confidence > 0 else 0


def agreed(proposals):
    """(median, E) of proposals with `displacement` and `weight` above 0, whose sum is 65536 (SRF-3)."""
    median = median_of(proposals)
    near = sum(p.weight for p in proposals if abs(p.displacement - median) <= REACH)
    return median, median if near >= MOST else 0


def median_of(proposals):
    """The least proposal such that the views which propose it or less have at least half of the weight."""
    weight = 0
    for proposal in sorted(proposals, key=lambda proposal: proposal.displacement):
        weight += proposal.weight
        if weight >= HALF:
            return proposal.displacement
    raise AssertionError("the weights do not sum to 65536")
