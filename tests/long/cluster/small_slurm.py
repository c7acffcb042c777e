"""Slurm with several nodes on this machine, for tests: a controller, a daemon for each node, and munge, all with files
and ports of their own."""
import os
import signal
import socket
import subprocess
import time
from pathlib import Path

CONFIGURATION = """ClusterName=test
SlurmctldHost=localhost
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
ReturnToService=0
SlurmdTimeout=10
JobRequeue=1
MpiDefault=none
SwitchType=switch/none
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def processes_of(node, configuration):
    """Those that watch jobs there, then the jobs: whoever sees a job end tells the controller."""
    watchers, jobs = set(), set()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = set((folder / "environ").read_bytes().split(b"\0"))
            if {f"SLURMD_NODENAME={node}".encode(), f"SLURM_CONF={configuration}".encode()} <= words:
                parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
                if Path(f"/proc/{parent}/comm").read_text().startswith("slurmstepd"):
                    watchers.add(parent)
                jobs.add(int(folder.name))
        except (OSError, ValueError):  # it has ended
            pass
    return [*watchers, *(jobs - watchers)]


def end(process):
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        pass


class Cluster:
    def __init__(self, folder, nodes):
        self.folder, self.nodes, self.daemons = Path(folder), [f"n{i}" for i in range(nodes)], {}
        for name in ["state"] + [f"spool-{node}" for node in self.nodes]:
            (self.folder / name).mkdir(parents=True)
        text = CONFIGURATION.format(folder=self.folder, port=free_port())
        for node in self.nodes:
            text += f"NodeName={node} NodeHostname=localhost Port={free_port()} CPUs=2 RealMemory=1500\n"
        text += "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n"
        (self.folder / "slurm.conf").write_text(text)
        os.environ["SLURM_CONF"] = str(self.folder / "slurm.conf")

    def begin(self):
        """Whoever makes a cluster calls stop(), whether this succeeds or not."""
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self.start("munged", "munged", "--foreground", "--force", f"--key-file={key}",
                   f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munged.seed")
        self.wait(lambda: (self.folder / "munge.socket").exists())
        self.start("slurmctld", "slurmctld", "-D", "-c")
        for node in self.nodes:
            self.start(node, "slurmd", "-D", "-N", node)
        self.wait(lambda: all(self.state(node) == "idle" for node in self.nodes))

    def start(self, name, *words):
        with open(self.folder / f"{name}.out", "w") as log:
            self.daemons[name] = subprocess.Popen(words, stdout=log, stderr=log)

    @staticmethod
    def wait(condition, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise AssertionError("Slurm does not start")
            time.sleep(0.2)

    @staticmethod
    def ask(*words):
        return subprocess.run(words, capture_output=True, text=True).stdout

    def state(self, node):
        return self.ask("sinfo", "-h", "-n", node, "-o", "%T").strip()

    def jobs(self):
        """Of each task its id, name, node and state."""
        return [line.split("|") for line in self.ask("squeue", "-h", "-r", "-o", "%i|%j|%N|%T").splitlines()]

    def node_of(self, name):
        return next(node for _, job, node, state in self.jobs() if job == name and state == "RUNNING")

    def start_at_once(self):
        """Slurm lets tasks that it has queued again wait for two minutes."""
        for task, _, _, state in self.jobs():
            if state == "PENDING":
                self.ask("scontrol", "update", f"JobId={task}", "StartTime=now")

    def kill(self, node):
        """The daemon and all that runs there, as a power cut does."""
        daemon = self.daemons.pop(node)
        daemon.kill()
        daemon.wait()
        for process in processes_of(node, self.folder / "slurm.conf"):
            end(process)

    def stop(self):
        for name, daemon in reversed(list(self.daemons.items())):
            daemon.kill()
            daemon.wait()
            for process in processes_of(name, self.folder / "slurm.conf"):
                end(process)
