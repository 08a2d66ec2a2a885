"""HMLFC light fields for Python: decode any part of any view, render, encode.

>>> import hmlfc
>>> lf = hmlfc.open("chess.hmlfc")
>>> lf.shape                     # rows and columns of views, height, width, channels
(9, 9, 512, 512, 3)
>>> view = lf[3, 4]              # (512, 512, 3), uint8; uint16 above 8 bits
>>> part = lf[3, 4, 10:40, 8:99] # decodes these blocks alone

Samples are exactly those of the specification. Arrays are row by row, the pixel in column x of row y at [y, x].
"""

try:
    from hmlfc._core import version as __version__
    from hmlfc.encoding import Views, encode, read_views
    from hmlfc.error import Error, Note
    from hmlfc.light_field import Block, LightField, Rig, open
except ModuleNotFoundError as missing:
    reason = {
        "numpy": "it needs NumPy: apt-get install python3-numpy, or pip install numpy",
        "hmlfc._core": "it was built for another Python; pip install it for this one",
    }.get(missing.name or "", str(missing))
    raise ModuleNotFoundError(f"hmlfc cannot be imported: {reason}", name=missing.name) from missing

__all__ = [
    "Block", "Error", "LightField", "Note", "Rig", "Views", "__version__", "encode", "open", "read_views"
]  # fmt: skip
