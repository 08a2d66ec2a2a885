"""retry_test.py fails on each of these faults of tools/cluster/cluster.py. Argument: cluster.py."""

import subprocess
import sys
import tempfile
from pathlib import Path

FAULTS = {
    "LOST = {71, 74}": "LOST = {71}",
    'found["status"] in LOST or found["status"] < 0': 'found["status"] in LOST',
    'None if found is None or found["status"]': 'found if found is None or found["status"]',
    'options.attempt < job.fields["retries"]': 'options.attempt <= job.fields["retries"]',
    "job.submit(lost, options.attempt + 1)": "job.submit(range(1, job.tasks + 1), options.attempt + 1)",
    "for index in range(1, self.tasks + 1) if self.status(index) is None": "for index in range(1, self.tasks) if self.status(index) is None",
    "if job.kind in MERGES and not lost": "if job.kind in MERGES",
    "5 if lost else 0": "0",
    '"attempts": options.attempt + 1': '"attempts": options.attempt',
    "for left in (partial, job.output(index))": "for left in (job.output(index),)",
    'found["status"] != 0]': 'found["status"] > 2]',
    "seed + (index - 1) * count": "seed + (index - 1)",
}


def main():
    cluster = Path(sys.argv[1])
    text = cluster.read_text()
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "tools/cluster/cluster.py"
        copy.parent.mkdir(parents=True)
        for old, new in FAULTS.items():
            assert text.count(old) == 1, old
            copy.write_text(text.replace(old, new))
            ran = subprocess.run([sys.executable, Path(__file__).with_name("retry_test.py"), copy], capture_output=True)
            if ran.returncode == 0:
                missed.append(f"{new!r} in place of {old!r} is not found")
    print(*missed, sep="\n")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
