"""The naive decoder in this process: its modules from sources that may be changed, asked as a conformance
run asks a decoder."""

import ast
import hashlib
import importlib
import sys
from functools import cache
from importlib.abc import Loader, MetaPathFinder
from importlib.util import spec_from_loader
from pathlib import Path

from changes import Source, function_of

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "tests/naive_decoder"
PLANES = ("Y", "Co", "Cg")
# The command line, traces, rigs and file formats are around the decoder, not in it.
AROUND = {"decode.py", "rig.py", "trace.py"}


def decoder_files():
    """The files that decode, relative to FOLDER."""
    files = sorted([*FOLDER.glob("*.py"), *FOLDER.glob("jpeg2000/*.py")])
    return [name for name in (file.relative_to(FOLDER).as_posix() for file in files) if name not in AROUND]


def module_name(file):
    """The name under which a file is imported."""
    return file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


@cache
def modules_of(name):
    """The modules of the decoder that a module needs, itself too."""
    file = next(file for file in decoder_files() if module_name(file) == name)
    package, needed = name.rpartition(".")[0], {name}
    for node in ast.walk(ast.parse((FOLDER / file).read_text())):
        if isinstance(node, ast.ImportFrom):
            imported = f"{package}.{node.module}" if node.level else node.module
            if imported in map(module_name, decoder_files()):
                needed |= modules_of(imported)
    return frozenset(needed)


class Modules(MetaPathFinder, Loader):
    """Imports the decoder from `codes`, a dictionary of file to code object or source; every call imports anew."""

    def __init__(self, codes, **names):
        self.codes, self.names = {module_name(file): code for file, code in codes.items()}, names

    def find_spec(self, name, path=None, target=None):
        if name not in self.codes:
            return None
        return spec_from_loader(name, self, is_package=name == "jpeg2000")

    def exec_module(self, module):
        vars(module).update(self.names)
        exec(self.codes[module.__name__], vars(module))  # pylint: disable=exec-used

    def load(self):
        """The modules by name."""
        for name in self.codes:
            sys.modules.pop(name, None)
        sys.meta_path.insert(0, self)
        try:
            return {name: importlib.import_module(name) for name in self.codes}
        finally:
            sys.meta_path.remove(self)


def plain(argument):
    """What an argument is known by: itself, or the bytes and numbers that an object has."""
    if isinstance(argument, (bytes, int)):
        return argument
    return tuple(value for value in vars(argument).values() if isinstance(value, (bytes, int)))


class Decoder:
    """Loaded modules. Checksums and planes of codestreams that do not need the file `changed` are taken from `known`;
    None: each is computed, and noted there."""

    def __init__(self, modules, known, changed):
        self.modules, self.known = modules, known
        self.StreamError = modules["stream_error"].StreamError
        for name in ("header", "opening", "key_images"):
            modules[name].crc32c = self._kept(modules["crc32c"].crc32c, changed)
        modules["key_images"].decode = self._kept(modules["jpeg2000.decoder"].decode, changed)

    def _kept(self, function, changed):
        CodestreamError = self.modules["key_images"].CodestreamError
        ours = changed is not None and module_name(changed) in modules_of(function.__module__)
        known = {} if ours else self.known

        def asked(*arguments):
            key = function.__name__, *map(plain, arguments)
            if changed is None or key not in known:
                try:
                    known[key] = function(*arguments)
                except CodestreamError as error:
                    known[key] = str(error)
            if isinstance(known[key], str):
                raise CodestreamError(known[key])
            return known[key]

        return asked

    def attempt(self, action, *arguments):
        """What the action returns, or the name of the error that ends it."""
        try:
            return action(*arguments)
        except self.StreamError as error:
            return error.name

    def open(self, data):
        """A decoder of blocks, or the name of an error."""
        return self.attempt(lambda: self.modules["block"].BlockDecoder(self.modules["opening"].Stream(data)))

    def places(self, blocks):
        """The views of an opened stream."""
        header = blocks.stream.header
        return [(row, col) for row in range(header.rows) for col in range(header.cols)]

    def raw_view(self, blocks, row, col):
        """The bytes of a view in the raw form."""
        view = self.modules["light_field"].decode_view(blocks, row, col)
        return self.modules["picture_files"].raw_bytes(view, blocks.stream.header.depth)

    def whole_views(self, data):
        """What decode.py makes of a file: the SHA-256 of all views, or the name of the first error."""

        def decode():
            blocks = self.modules["block"].BlockDecoder(self.modules["opening"].Stream(data))
            return [self.raw_view(blocks, *place) for place in self.places(blocks)]

        views = self.attempt(decode)
        return views if isinstance(views, str) else hashlib.sha256(b"".join(views)).digest()

    def view_errors(self, data):
        """The names of the errors of the views that fail."""
        blocks = self.open(data)
        if isinstance(blocks, str):
            return set()
        views = [self.attempt(self.raw_view, blocks, *place) for place in self.places(blocks)]
        return {view for view in views if isinstance(view, str)}

    def failing_blocks(self, blocks, expected):
        """The errors of the blocks that the manifest names."""
        return [
            self.attempt(
                blocks.decode, block["view_row"], block["view_col"], PLANES.index(block["plane"]),
                block["block_x"], block["block_y"],
            )
            for block in expected
        ]  # fmt: skip

    def block_sums(self, blocks):
        """The blocks file of an opened stream, each block asked for by itself."""
        geometry, lines = blocks.stream.geometry, []
        cols, rows = geometry.blocks(0)
        for place in self.places(blocks):
            sums = [self.block_sum(blocks, place, x, y) for y in range(rows) for x in range(cols)]
            lines.append(f"{place[0]} {place[1]}\n{' '.join(sums)}\n")
        return "".join(lines)

    def block_sum(self, blocks, place, block_x, block_y):
        """The CRC-32C of the pixels of a block, or dashes if a plane of it does not decode."""
        header, side = blocks.stream.header, blocks.stream.geometry.block
        shift = 1 if header.chroma_format == 0 else 0
        planes = [self.attempt(blocks.decode, *place, 0, block_x, block_y)]
        planes += [self.attempt(blocks.decode, *place, plane, block_x >> shift, block_y >> shift) for plane in (1, 2)]
        if any(isinstance(stages, str) for stages in planes):
            return "--------"
        luma, *chroma = (stages[-1].sample for stages in planes)
        width, height = (
            min(side, whole - side * block) for whole, block in ((header.width, block_x), (header.height, block_y))
        )
        left, top = ((side * block >> shift) % side for block in (block_x, block_y))
        pixels = [
            [
                self.modules["colour"].to_rgb(
                    luma[y][x], *(rows[top + (y >> shift)][left + (x >> shift)] for rows in chroma), header.depth
                )
                for x in range(width)
            ]
            for y in range(height)
        ]
        raw = self.modules["picture_files"].raw_bytes(pixels, header.depth)
        return f"{self.modules['crc32c'].crc32c(raw):08x}"


def counted(file, text):
    """The code of a file that notes each statement of a function before it is executed: HITS has the pairs of file
    and first line."""
    source = Source(file, text)
    for node in ast.walk(source.tree):
        for name in ("body", "orelse", "finalbody"):
            statements = getattr(node, name, None)
            if not isinstance(statements, list) or not statements or function_of(source, statements[0]) is None:
                continue
            marked = []
            for statement in statements:
                mark = ast.parse(f"HITS.add(({file!r}, {statement.lineno}))").body[0]
                marked += [ast.copy_location(mark, statement), statement]
            setattr(node, name, marked)
    return compile(ast.fix_missing_locations(source.tree), file, "exec")
