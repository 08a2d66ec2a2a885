"""Stages of a block as records that compare with those of `hmlfc inspect --json`."""


def trace_block(decoder, row, col, plane, block_x, block_y):
    """One record for each level, from the first that is decoded: level, image, kind, state, stages."""
    geometry = decoder.stream.geometry
    return [
        level_record(geometry, stages) for stages in decoder.decode(row, col, plane, block_x, block_y)
    ]


def level_record(geometry, stages):
    """The record of one level. A stage that the block does not have is left out."""
    level, row, col = stages.image
    kind = "predictive"
    if geometry.is_key(stages.image):
        kind = "key"
    elif geometry.reference_of(stages.image) == stages.image:
        kind = "reference"
    names = ("parent", "reference", "prediction", "residual", "sample")
    return {
        "level": level,
        "image": {"row": row, "col": col},
        "kind": kind,
        "state": stages.state,
        "stages": {name: getattr(stages, name) for name in names if getattr(stages, name) is not None},
    }
