"""A Slurm cluster of its own on this machine: several nodes by configuration, each with its daemon, a key of its own, nothing outside one
folder. For tests. Needs Debian's slurm-wlm and munge, and root, as slurmd does."""

import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("slurmctld", "slurmd", "srun", "sinfo", "munged")
CONFIGURATION = """ClusterName=tegument
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdTimeout=10
MpiDefault=none
AccountingStorageType=accounting_storage/none
NodeName=n[1-{nodes}] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{first}-{last}] CPUs=1 RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """What this machine lacks; empty if a cluster can be made."""
    lacking = [name for name in PROGRAMS if shutil.which(name) is None]
    if lacking:
        return f"no {', '.join(lacking)}: apt-get install slurm-wlm munge"
    return "" if os.geteuid() == 0 else "slurmd needs root"


def free_ports(count):
    """`count` neighbouring ports that nobody listens on."""
    for first in range(21000, 31000, count):
        sockets = []
        try:
            for port in range(first, first + count):
                sockets.append(socket.socket())
                sockets[-1].bind(("127.0.0.1", port))
            return first
        except OSError:
            continue
        finally:
            for one in sockets:
                one.close()
    raise OSError("no free ports")


class Cluster:
    """with Cluster(folder, 4) as cluster: cluster.environment is for srun."""

    def __init__(self, folder, nodes):
        self.folder = pathlib.Path(folder).resolve()
        self.nodes = nodes
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))

    def __enter__(self):
        first = free_ports(self.nodes + 1)
        for name in ("state", *(f"spool/n{i + 1}" for i in range(self.nodes))):
            (self.folder / name).mkdir(parents=True)
        os.chmod(self.folder, 0o755)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname(), port=first, folder=self.folder, nodes=self.nodes, first=first + 1, last=first + self.nodes))
        try:
            self.run("munged", "--force", f"--key-file={key}", *(f"--{name}={self.folder}/{file}" for name, file in (
                ("socket", "munge.socket"), ("pid-file", "munged.pid"), ("log-file", "munged.log"), ("seed-file", "munge.seed"))))
            self.run("slurmctld", "-f", str(self.folder / "slurm.conf"))
            for i in range(self.nodes):
                self.run("slurmd", "-N", f"n{i + 1}", "-f", str(self.folder / "slurm.conf"))
            self.wait_for(lambda: self.run("sinfo", "--noheader", "--format=%D %t").split() == [str(self.nodes), "idle"])
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for pid in (*self.folder.glob("*.pid"),):
            try:
                os.kill(int(pid.read_text()), signal.SIGKILL)
            except (OSError, ValueError):
                pass
        for i in range(self.nodes):
            self.kill_processes(f"n{i + 1}")

    def run(self, *command):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False, timeout=60)
        if done.returncode != 0:
            raise OSError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
        return done.stdout

    @staticmethod
    def wait_for(holds, seconds=60):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end:
                raise TimeoutError
            time.sleep(0.2)

    def processes(self, node):
        """Of the node's jobs."""
        pids = []
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                environment = (process / "environ").read_bytes().split(b"\0")
            except OSError:
                continue
            if all(word.encode() in environment for word in (f"SLURM_CONF={self.folder}/slurm.conf", f"SLURMD_NODENAME={node}")):
                pids.append(int(process.name))
        return pids

    def runs(self, node, program):
        """Whether a job of the node is at work in this program."""
        return any(self.command(pid).startswith(os.fsencode(program) + b"\0") for pid in self.processes(node))

    def kill_processes(self, node):
        """What runs in the node's jobs, the step daemons first: they must not tell the controller."""
        pids = self.processes(node)
        parents = []
        for pid in pids:
            try:
                parents.append(int((pathlib.Path("/proc") / str(pid) / "stat").read_text().rsplit(")", 1)[1].split()[1]))
            except (OSError, ValueError):
                pass
        stepd = [pid for pid in parents if self.command(pid).startswith(b"slurmstepd")]
        for pid in (*stepd, *pids):
            try:
                os.kill(pid, signal.SIGKILL)
            except OSError:
                pass
        return len(pids)

    @staticmethod
    def command(pid):
        """Its words, each with a 0 behind; empty of a process that has ended."""
        try:
            return (pathlib.Path("/proc") / str(pid) / "cmdline").read_bytes()
        except OSError:
            return b""

    def kill_node(self, node):
        """As when its power goes: its daemon and all that it runs, at once. How many processes its jobs had."""
        os.kill(int((self.folder / f"{node}.pid").read_text()), signal.SIGKILL)
        return self.kill_processes(node)
