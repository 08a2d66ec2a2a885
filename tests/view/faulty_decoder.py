#!/usr/bin/env python3
"""A decoder with a known fault, for the page: R of pixel X, Y of view 0,1 is 5 off; and in traces of the block
there, in plane Y, the residual and the sample of that place are one more.

    faulty_decoder.py lines             behind the line protocol
    faulty_decoder.py HMLFC FILE OUTPUT as a command line around the program HMLFC
    faulty_decoder.py dies              a program that ends at the first question about a view
"""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "examples"), str(ROOT / "tests" / "naive_decoder")]

X, Y, OFF = 9, 13, 5


def off(red):
    return red + OFF if red + OFF < 256 else red - OFF


def server():
    import line_decoder

    class Server(line_decoder.Server):
        def view(self, row, col):
            if sys.argv[1] == "dies":
                sys.exit("no view today")
            text = super().view(row, col)
            header = self.decoder.stream.header
            if (row, col) != ("0", "1"):
                return text
            at = 12 * (Y * header.width + X)
            return text[:at] + f"{off(int(text[at : at + 4], 16)):04x}" + text[at + 4 :]

        def trace(self, *place):
            count, *lines = super().trace(*place).split("\n")
            records = [json.loads(line) for line in lines]
            side = self.decoder.stream.geometry.block
            at = [X // side, Y // side]
            for record in records:
                own = record["record"] == "stage" and record["level"] == 0 and record["image"] == [0, 1]
                if own and record["plane"] == "Y" and record["block"] == at and record["stage"] in ("residual", "sample"):
                    record["values"][side * (Y % side) + X % side] += 1
            return "\n".join([count, *map(json.dumps, records)])

    line_decoder.serve(Server())


def command(program, file, output):
    from PIL import Image

    subprocess.run([program, "decode", file, "-o", output], check=True, stdout=subprocess.DEVNULL)
    for path in Path(output).glob("*00_01.png"):
        with Image.open(path) as picture:
            wrong = picture.convert("RGB")
        x, y = min(X, wrong.width - 1), min(Y, wrong.height - 1)
        red, green, blue = wrong.getpixel((x, y))
        wrong.putpixel((x, y), (off(red), green, blue))
        wrong.save(path)


if __name__ == "__main__":
    command(*sys.argv[1:]) if len(sys.argv) == 4 else server()
