"""What all benchmarks with results share: options, files of a run, the recorded run, the page in docs/results."""

import argparse
import json
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import result_file
import store
from process import ROOT, machine, say
from result_file import table


@dataclass
class Report:
    """A benchmark, bench/NAME.

    measure(options, work): its results (store.py), made with files in the folder `work`; tables(results): pairs (what a
    table shows, its lines); draw(results, folder, prefix): writes pictures; keys: the values of a row that tell which
    measurement it is; title: of docs/results/NAME.md, or none where nothing is recorded; add_options(parser)."""

    name: str
    about: str
    quick: str
    measure: Callable
    tables: Callable
    keys: tuple = ()
    title: str = ""
    draw: Callable = lambda results, folder, prefix: None
    add_options: Callable = lambda parser: None

    def main(self):
        """Returns the exit status: 0 done, 1 a value is not the recorded one, or the group `failed` has rows."""
        options = self._parse()
        if self.title and (options.check or options.update):
            return self._settle(options)
        with tempfile.TemporaryDirectory() as work:
            results = {"machine": machine(), **self.measure(options, Path(work))}
        self._write(results, options)
        if results.get("failed"):
            return 1
        if not self.title or options.quick and not options.record:
            return 0
        recorded = store.read(options.recorded) if options.recorded.exists() else {}
        if options.record:
            store.write(store.merged(recorded, results, self.keys), options.recorded)
            return 0
        found = store.differences(recorded, results, self.keys)
        for difference in found:
            say(f"differs from the recorded run: {difference}")
        return 1 if found else 0

    def _parse(self):
        parser = argparse.ArgumentParser(
            prog=f"./run bench {self.name}", description=self.about,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        self.add_options(parser)
        add = parser.add_argument
        add("--quick", action="store_true", help=self.quick)
        add("--json", action="store_true", help="print the results as JSON")
        add("-o", "--output", type=Path, default=ROOT / "out" / self.name, metavar="FOLDER",
            help=f"of results.json, a CSV of each group of results, and pictures (default out/{self.name})")
        if self.title:
            add("--record", action="store_true", help="take the results into the recorded run")
            add("--recorded", type=Path, default=ROOT / "bench" / self.name / "recorded.json", metavar="FILE",
                help=f"default bench/{self.name}/recorded.json")
            result_file.add_arguments(parser)
        return parser.parse_args()

    def _settle(self, options):
        recorded = store.read(options.recorded)
        if options.update:
            self.draw(recorded, options.results.parent / "images", f"{self.name}_")
        text = result_file.result_text(self.title, f"./run bench {self.name} --update", self.tables(recorded))
        return result_file.settle(options.results / f"{self.name}.md", text, options.update)

    def _write(self, results, options):
        options.output.mkdir(parents=True, exist_ok=True)
        store.write(results, options.output / "results.json")
        store.write_csv(results, options.output)
        self.draw(results, options.output, "")
        if options.json:
            print(json.dumps(results, indent=2))
        else:
            for title, lines in self.tables(results):
                print("\n".join(["", title, "", *lines]))


def columns(rows, *wanted):
    """The lines of a table with a line for each row. wanted: pairs (title, format), a format string with names of the
    row's values, or a function of the row."""
    cells = [[made(row) if callable(made) else made.format(**row) for _, made in wanted] for row in rows]
    return table([title for title, _ in wanted], cells)
