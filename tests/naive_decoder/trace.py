"""Stages of a block (TRC-1) as the records of a trace file: one JSON object a line."""

PLANE_NAMES = ("Y", "Co", "Cg")
STAGES = ("parent", "reference", "prediction", "residual", "sample")


def trace_block(decoder, row, col, plane, block_x, block_y, stop_level=0):
    """A record that names the block, then one for each stage of each level, from the first that is decoded.

    Values are those of the B * B positions of the block, row by row.
    """
    stages_of_levels = decoder.decode(row, col, plane, block_x, block_y, stop_level)
    place = {"plane": PLANE_NAMES[plane], "block": [block_x, block_y]}
    records = [{"record": "block", "view": [row, col], **place}]
    for stages in stages_of_levels:
        level, *image = stages.image
        for name in STAGES:
            rows = getattr(stages, name)
            if rows is not None:
                clause = clause_of(decoder.stream, stages, name)
                head = {"record": "stage", "level": level, "image": image, **place}
                values = [value for line in rows for value in line]
                records.append({**head, "stage": name, "clause": clause, "values": values})
    return records


def clause_of(stream, stages, name):
    """The clause that defines a stage of an image."""
    if name == "reference":
        return "MOT-9" if stream.header.motion_tiles else "DEC-4"
    if name == "residual":
        return "STP-3" if stream.header.residual_step else "TIL-10"
    return "DEC-2" if stream.geometry.is_key(stages.image) else "DEC-3"
