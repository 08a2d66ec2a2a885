"""What the quantities of the width tables reached, merged from several runs."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "common"))

from result_file import table  # noqa: E402


class Reached:
    """Rows as the programs report them, keyed by quantity, depth and plane."""

    def __init__(self):
        self.rows = {}

    def add(self, rows):
        for row in rows:
            key = (row["quantity"], row["depth"], row["plane"])
            known = self.rows.setdefault(key, {**row, "reached": None, "by": None})
            if "reached" not in row:
                continue
            if known["reached"] is None:
                known["reached"], known["by"] = list(row["reached"]), list(row["by"])
                continue
            for end, beyond in ((0, int.__lt__), (1, int.__gt__)):
                if beyond(row["reached"][end], known["reached"][end]):
                    known["reached"][end] = row["reached"][end]
                    known["by"][end] = row["by"][end]

    def gaps(self):
        """The rows whose proved interval is not reached at both ends."""
        return [row for row in self.rows.values() if not is_reached(row)]

    def table(self):
        """A Markdown table: a row for each quantity and plane, at its largest depth."""
        rows = [
            table_row([row for row in self.rows.values() if (row["quantity"], row["plane"]) == key])
            for key in dict.fromkeys((quantity, plane) for quantity, _, plane in self.rows)
        ]
        return table(("quantity", "clause", "plane", "n", "proved", "reached", "by"), rows)


def is_reached(row):
    if row["reached"] is None:
        return False
    one_value = row["proved"][0] == row["proved"][1]
    return row["reached"][1] == row["proved"][1] and (
        one_value or row["reached"][0] == row["proved"][0]
    )


def shown(interval):
    if interval is None:
        return "-"
    lo, hi = interval
    return str(hi) if lo == hi else f"[{lo}, {hi}]"


def table_row(rows):
    """The cells for all depths of one quantity and plane: the largest, unless another has a gap."""
    open_rows = [row for row in rows if not is_reached(row)]
    row = (open_rows or rows)[-1]
    depths = [r["depth"] for r in rows]
    if row["depth"] is None:
        depth = ""
    elif open_rows and len(open_rows) < len(rows):
        at = ", ".join(str(r["depth"]) for r in rows if is_reached(r))
        depth = f"{row['depth']} (reached at {at})"
    else:
        depth = f"{row['depth']} of {depths[0]} to {depths[-1]}"
    reached = "the same" if is_reached(row) else shown(row["reached"])
    by = " / ".join(dict.fromkeys(short(name) for name in row["by"] or []))
    cells = [row["quantity"], row["clause"], row["plane"] or "", depth]
    return [*cells, shown(row["proved"]), reached, by]


def short(name):
    """The name of a stream, without its recipe if a search made it."""
    return name.split(" {")[0]
