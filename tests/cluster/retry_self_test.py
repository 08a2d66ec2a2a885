"""retry_test.py fails on each of these faults of tools/cluster/cluster.py. Argument: cluster.py."""

import subprocess
import sys
import tempfile
from pathlib import Path

FAULTS = {  # old text: new text, the test that finds it
    "LOST = {71, 74}": ("LOST = {71}", "lost_tasks_run_again_and_no_others"),
    'found["status"] in LOST or found["status"] < 0': ('found["status"] in LOST', "lost_tasks_run_again_and_no_others"),
    'None if found is None or found["status"]': ('found if found is None or found["status"]', "lost_tasks_run_again_and_no_others"),
    'options.attempt < job.fields["retries"]': ('options.attempt <= job.fields["retries"]', "a_task_without_a_status"),
    "job.submit(lost, options.attempt + 1)": ("job.submit(range(1, job.tasks + 1), options.attempt + 1)", "a_task_that_dies_whole_leaves_its_output"),
    "for index in range(1, self.tasks + 1) if self.status(index) is None": ("for index in range(1, self.tasks) if self.status(index) is None", "a_task_without_a_status"),
    "if job.kind in MERGES and not lost": ("if job.kind in MERGES", "what_stays_lost_is_named"),
    "5 if lost else 0": ("0", "a_task_without_a_status"),
    '"attempts": options.attempt + 1': ('"attempts": options.attempt', "lost_tasks_run_again_and_no_others"),
    "for left in (partial, job.output(index))": ("for left in (job.output(index),)", "a_task_that_dies_whole_leaves_its_output"),
    'found["status"] != 0]': ('found["status"] > 2]', "a_failure_is_no_loss"),
    "seed + (index - 1) * count": ("seed + (index - 1)", "tasks_share_neither_seeds_nor_folders"),
    '[*seeded("stress", a, i), "--out", o]': ('seeded("stress", a, i)', "tasks_share_neither_seeds_nor_folders"),
    'f"{i}/{n}"],\n}': ('f"1/{n}"],\n}', "tasks_share_neither_seeds_nor_folders"),
}


def main():
    cluster = Path(sys.argv[1])
    text = cluster.read_text()
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "tools/cluster/cluster.py"
        copy.parent.mkdir(parents=True)
        for old, (new, test) in FAULTS.items():
            assert text.count(old) == 1, old
            copy.write_text(text.replace(old, new))
            command = [sys.executable, Path(__file__).with_name("retry_test.py"), copy, f"Retry.test_{test}"]
            ran = subprocess.run(command, capture_output=True)
            if ran.returncode == 0:
                missed.append(f"{new!r} in place of {old!r} is not found")
    print(*missed, sep="\n")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
