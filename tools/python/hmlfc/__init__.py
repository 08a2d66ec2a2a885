"""HMLFC light fields for Python: decode any part of any view, render, encode.

>>> import hmlfc
>>> lf = hmlfc.open("chess.hmlfc")
>>> lf.shape                     # rows and columns of views, height, width, channels
(9, 9, 512, 512, 3)
>>> view = lf[3, 4]              # (512, 512, 3), uint8; uint16 above 8 bits
>>> part = lf[3, 4, 10:40, 8:99] # decodes these blocks alone

Samples are exactly those of the specification. Arrays are row by row, the pixel in column x of row y at [y, x].
"""

from hmlfc._core import version as __version__
from hmlfc.encoding import Views, encode, read_views
from hmlfc.error import Error
from hmlfc.light_field import Block, LightField, Rig, open

__all__ = ["Block", "Error", "LightField", "Rig", "Views", "__version__", "encode", "open", "read_views"]
