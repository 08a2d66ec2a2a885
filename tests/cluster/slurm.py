"""A Slurm of our own: a controller and nodes on this machine, with munge, in a folder."""

import os
import shutil
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "scancel", "squeue"]


def find(name):
    return shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")


def missing():
    return [name for name in PROGRAMS if find(name) is None]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Slurm:
    """Nodes n1, n2 ... with one processor each. `folder`: of this Slurm alone."""

    def __init__(self, folder: Path, nodes: int):
        self.folder = folder
        self.names = [f"n{i}" for i in range(1, nodes + 1)]
        self.processes = []
        for name in ("munge", "state", "spool"):
            (folder / name).mkdir(parents=True, mode=0o755)
        self.config = folder / "slurm.conf"
        self.config.write_text(self.config_text())
        version = subprocess.run([find("slurmd"), "-V"], stdout=subprocess.PIPE, text=True, check=True).stdout
        if int(version.split()[1].split(".")[0]) >= 23:  # older ones know no such plugin, and do without
            (folder / "cgroup.conf").write_text("CgroupPlugin=disabled\n")
        self.environment = {**os.environ, "SLURM_CONF": str(self.config)}

    def config_text(self):
        user = "root" if os.geteuid() == 0 else os.environ.get("USER", "nobody")
        host = socket.gethostname().split(".")[0]
        lines = [
            "ClusterName=test", f"SlurmctldHost={host}(127.0.0.1)", f"SlurmUser={user}", f"SlurmdUser={user}",
            f"SlurmctldPort={free_port()}", "AuthType=auth/munge", "CryptoType=crypto/munge",
            f"AuthInfo=socket={self.folder}/munge/socket", f"StateSaveLocation={self.folder}/state",
            f"SlurmdSpoolDir={self.folder}/spool/%n", f"SlurmctldPidFile={self.folder}/slurmctld.pid",
            f"SlurmdPidFile={self.folder}/slurmd-%n.pid", f"SlurmctldLogFile={self.folder}/slurmctld.log",
            f"SlurmdLogFile={self.folder}/slurmd-%n.log", "ProctrackType=proctrack/pgid", "TaskPlugin=task/none",
            "SelectType=select/cons_tres", "SelectTypeParameters=CR_CPU", "MpiDefault=none", "ReturnToService=2",
            "JobAcctGatherType=jobacct_gather/none", "AccountingStorageType=accounting_storage/none",
            "SchedulerParameters=sched_interval=1,sched_min_interval=0", "MinJobAge=3600", "SlurmdParameters=config_overrides",
        ]  # fmt: skip
        lines += [f"NodeName={name} NodeAddr=127.0.0.1 NodeHostname={host} Port={free_port()} CPUs=1 State=UNKNOWN" for name in self.names]
        lines += [f"PartitionName=all Nodes={','.join(self.names)} Default=YES MaxTime=INFINITE State=UP", ""]
        return "\n".join(lines)

    def __enter__(self):
        key = self.folder / "munge/key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        files = [f"--{name}={self.folder}/munge/{name.split('-')[0]}" for name in ("socket", "key-file", "log-file", "pid-file", "seed-file")]
        self.start("munged", "--foreground", "--force", "--num-threads=2", *files)
        self.wait("munged", lambda: (self.folder / "munge/socket").exists())
        self.start("slurmctld", "-D", "-f", self.config)
        for name in self.names:
            self.start("slurmd", "-D", "-N", name, "-f", self.config)
        self.wait("the nodes", lambda: self.run("sinfo", "-h", "-o", "%T %D") == f"idle {len(self.names)}")
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
        for process in reversed(self.processes):
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def start(self, name, *arguments):
        command = [find(name), *map(str, arguments)]
        with (self.folder / f"{name}-{len(self.processes)}.out").open("wb") as log:
            self.processes.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log))

    def run(self, *command):
        """Standard output; "" where the command fails."""
        ran = subprocess.run(command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
        return ran.stdout.strip() if ran.returncode == 0 else ""

    def wait(self, what, ready, seconds=240):
        end = time.monotonic() + seconds
        while not ready():
            if time.monotonic() > end:
                raise AssertionError(f"{what}: not ready after {seconds} s; {self.logs()}")
            time.sleep(0.2)

    def logs(self):
        return "\n".join(f"{file.name}: {file.read_text(errors='replace')[-800:]}" for file in self.folder.glob("*.*") if file.suffix in (".log", ".out"))
