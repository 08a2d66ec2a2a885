"""Frames: what a virtual camera takes of a light field (docs/rendering.md)."""

from types import SimpleNamespace

from camera import Camera
from frame_record import record_of, record_of_words
from opening import Stream
from ray import ray_of_pixel
from surface import Surface
from view_pixels import ViewPixels
from view_sample import ViewSample
from view_weights import view_weights


class Shot:
    """An opened stream and what is rendered of it: record, stop level, pixels of views, surface or None."""

    def __init__(self, stream, record, stop_level):
        header = stream.header
        sizes = [getattr(header, name) for name in ("cols", "rows", "width", "height")]
        if [record[name] for name in ("cols", "rows", "width", "height")] != sizes:
            raise ValueError("the record of another light field")
        if not 0 <= stop_level <= header.tree_height:
            raise ValueError("no such stop level")
        self.record = record
        self.pixels = ViewPixels(stream, stop_level)
        self.surface = Surface(stream, record) if record["geometry"] == 1 and stop_level == 0 else None

    def blend(self, i, j):
        """How pixel (i, j) comes about: its ray, and if that is inside the parts of views and their sum.

        With geometry the parts lie at displaced places (SRF-4). A part has view, weight, x, y, the ViewSample and q; `sum` is that of SMP-3 without 2^19.
        """
        blend = SimpleNamespace(parts=[], sum=[0, 0, 0], sample=(0, 0, 0))
        blend.ray = ray_of_pixel(self.record, i, j)
        blend.cell = self.surface.cell_of(i, j) if self.surface else None
        if blend.ray.outside:
            return blend
        displacement = blend.cell.displacement if blend.cell else 0
        for view, weight in view_weights(self.record, blend.ray).items():
            x, y = blend.ray.x(view[1], displacement), blend.ray.y(view[0], displacement)
            part = SimpleNamespace(view=view, weight=weight, x=x, y=y, sampled=ViewSample(self.record, x, y))
            part.pixels = [self.pixels.pixel(*view, column, row) for column, row, _ in part.sampled.taps]
            part.q = part.sampled.q(part.pixels)
            blend.parts.append(part)
        weights, colours = [part.weight for part in blend.parts], zip(*(part.q for part in blend.parts))
        blend.sum, blend.sample = zip(*(summed(weights, qs) for qs in colours))
        return blend


def summed(weights, qs):
    """The sum over all views of weight * q, and the sample that it makes (SMP-3)."""
    total = sum(weight * q for weight, q in zip(weights, qs))
    return total, (2**19 + total) >> 20


class Frame:
    """width, height, depth; samples, rows of pixels (R, G, B); record; counts.

    counts: blocks_needed (NED-1), disparities_looked_up (SRF-5), outside (pixels of RAY-6).
    """

    def __init__(self, shot, depth):
        record = self.record = shot.record
        self.width, self.height, self.depth = record["frame_width"], record["frame_height"], depth
        outside = 0
        self.samples = []
        for j in range(self.height):
            row = [shot.blend(i, j) for i in range(self.width)]
            outside += sum(blend.ray.outside for blend in row)
            self.samples.append([blend.sample for blend in row])
        self.counts = {
            "blocks_needed": len(shot.pixels.blocks),
            "disparities_looked_up": len(shot.surface.looked_up) if shot.surface else 0,
            "outside": outside,
        }


def shot_of(data, camera_or_record, stop_level=0):
    """A Shot of a stream, given as its bytes, with the arguments of `render`.

    The CRCs of sections are not checked (NED-2).
    """
    stream = Stream(data, whole=False)
    if isinstance(camera_or_record, Camera):
        return Shot(stream, record_of(camera_or_record, stream.header), camera_or_record.stop_level)
    return Shot(stream, record_of_words(camera_or_record), stop_level)


def render(data, camera_or_record, stop_level=0):
    """The Frame of a stream, given as its bytes, by a Camera, or by the 41 integers of a frame record and a stop level.

    Raises StreamError, with the place of the block where the frame needs one that does not decode (NED-2), and
    CameraError. ValueError: the record has another number of integers or is that of another light field, or
    there is no such stop level.
    """
    shot = shot_of(data, camera_or_record, stop_level)
    frame = Frame(shot, shot.pixels.header.depth)
    shot.pixels.require_all()
    return frame
