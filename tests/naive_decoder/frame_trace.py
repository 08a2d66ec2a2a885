"""How one pixel of a frame comes about, number by number, with the clause of each."""

from frame import shot_of

COLOURS = "RGB"


def trace(data, camera_or_record, x, y, stop_level=0):
    """{"pixel", "stages", "sample"} of pixel (x, y) of the frame that `render` makes of the same arguments.

    A stage is {"stage", "values"}, with "view" where it is one of a view; a value {"name", "value", "clause"}.
    Its errors are those of `render`, of the blocks that the pixel needs. ValueError: the frame has no such pixel.
    """
    return trace_shot(shot_of(data, camera_or_record, stop_level), x, y)


def trace_shot(shot, x, y):
    """The same of a Shot."""
    if not (0 <= x < shot.record["frame_width"] and 0 <= y < shot.record["frame_height"]):
        raise ValueError("the frame has no such pixel")
    blend = shot.blend(x, y)
    shot.pixels.require_all()
    stages = [stage("record", "REC-2", shot.record)]
    if blend.cell:
        stages += cell_stages(blend.cell)
    stages.append(ray_stage("ray", blend.ray))
    if not blend.ray.outside:
        displaced = blend.cell is not None and blend.cell.displacement != 0
        stages += [part_stage(part, "SRF-2" if displaced else "RAY-4") for part in blend.parts]
        sums = {f"sum {colour}": total for colour, total in zip(COLOURS, blend.sum)}
        stages.append(stage("sum", "SMP-3", sums, dict(zip(COLOURS, blend.sample))))
    return {"pixel": {"x": x, "y": y}, "stages": stages, "sample": list(blend.sample)}


def values_of(clause, numbers):
    """Values of one clause from {name: number}."""
    return [{"name": name, "value": number, "clause": clause} for name, number in numbers.items()]


def stage(name, clause, *numbers):
    """A stage whose values are all of one clause."""
    return {"stage": name, "values": [value for part in numbers for value in values_of(clause, part)]}


def ray_stage(name, ray):
    """The numbers of a ray as far as they were computed."""
    values = values_of("RAY-1", {"a": ray.a, "b": ray.b, **{f"n.{axis}": n for axis, n in zip("xyz", ray.n)}})
    for clause, names in (("RAY-2", ("w", "sx", "sy")), ("RAY-3", ("U", "V")), ("RAY-4", ("xb", "yb"))):
        values += values_of(clause, {name: getattr(ray, name) for name in names if hasattr(ray, name)})
    if ray.outside:
        clause = "RAY-5" if hasattr(ray, "xb") else "RAY-3" if hasattr(ray, "U") else "RAY-2"
        values += values_of(clause, {"outside": 1})
    else:
        values += values_of("RAY-5", {"nearest view's row": ray.nearest[0], "nearest view's column": ray.nearest[1]})
    return {"stage": name, "values": values}


def cell_stages(cell):
    """The ray of a cell, the proposals of views, and what becomes of them."""
    stages = [ray_stage("cell ray", cell.ray)]
    if cell.ray.outside:
        return stages
    for proposal in cell.proposals:
        values = values_of("SMP-1", {"weight": proposal.weight})
        for step in proposal.steps:
            values += values_of("SRF-2", {"x(c, E)": step.x, "y(r, E)": step.y})
            values += values_of("GEO-2", {"D": step.disparity}) + values_of("GEO-6", {"confidence": step.confidence})
            values += values_of("SRF-3", {"E": step.displacement})
        stages.append({"stage": "proposal", "view": view_json(proposal.view), "values": values})
    last = stage("cell", "SRF-1", {"ci": cell.ci, "cj": cell.cj})
    last["values"] += values_of("SRF-3", {"median": cell.median, "E": cell.displacement})
    return [*stages, last]


def part_stage(part, clause):
    """The part of a view; `clause` is that of its place."""
    sampled = part.sampled
    values = values_of("SMP-1", {"weight": part.weight}) + values_of(clause, {"x": part.x, "y": part.y})
    values += values_of("SMP-2", {name: getattr(sampled, name) for name in ("xi", "fx", "yi", "fy")})
    for pixel in part.pixels:
        values += values_of("COL-2", {f"pixel {colour}": value for colour, value in zip(COLOURS, pixel)})
    values += values_of("SMP-2", {f"q {colour}": value for colour, value in zip(COLOURS, part.q)})
    return {"stage": "view", "view": view_json(part.view), "values": values}


def view_json(view):
    return {"row": view[0], "col": view[1]}
