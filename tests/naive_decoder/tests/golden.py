"""What the program under test makes of a stream: views and errors."""

import re

from pictures import read_png
from program import CORRUPT, DONE


def outcome(result):
    """"ok", or the error's name, of a run of the program."""
    if result.returncode == DONE:
        return "ok"
    message = result.stderr.decode()
    found = re.search(r": (\w+) in |: (\w+): ", message)
    if result.returncode != CORRUPT or not found:
        raise AssertionError(f"status {result.returncode}: {message}")
    return found[1] or found[2]


class Golden:
    """The program's answers on one stream, asked for in the folder of a CliTest."""

    def __init__(self, test, name, data):
        self.test, self.file = test, test.folder / f"{name}.golden.hmlfc"
        self.file.write_bytes(data)

    def views(self, header):
        """{(row, col): samples, R, G, B pixel by pixel, or the error's name}; header: of the stream."""
        folder = self.file.with_suffix(".views")
        whole = outcome(self.test.run_hmlfc("decode", self.file, "-o", folder))
        views = {}
        for place in ((row, col) for row in range(header.rows) for col in range(header.cols)):
            error = whole
            if whole != "ok":
                view = "%d,%d" % place
                error = outcome(self.test.run_hmlfc("decode", self.file, "--view", view, "-o", folder))
            views[place] = error
            if error == "ok":
                shift = 16 - header.depth if header.depth > 8 else 0
                samples = read_png(folder / ("%02d_%02d.png" % place)).samples
                views[place] = [sample >> shift for sample in samples]
        errors = {views[place] for place in views if isinstance(views[place], str)}
        if whole not in (errors or {"ok"}):
            raise AssertionError(f"decode: {whole}, its views one by one: {errors}")
        return views

    def opens(self):
        """"ok", or the name of the error in opening the stream."""
        return outcome(self.test.run_hmlfc("info", self.file))
