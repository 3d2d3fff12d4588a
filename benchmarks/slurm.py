"""Run the workflow through Slurm, while jobs are lost, and compare its results with a local run.

    python benchmarks/slurm.py --output results/slurm.json

The script needs root rights and Debian's packages slurm-wlm and munge. It starts a cluster of this machine on the
loopback interface, with files in a temporary folder and without the machine's own settings. The small settings are then
run twice, each time in a copy of the project: locally, and through Slurm with the profile `slurm`, while a job is
cancelled, and the node is drained and then lost. The files must equal the local run's to the last byte. Logs and
benchmarks, which contain times, must only have the same names.
"""

import contextlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click
import psutil
from measuring import output_option, save

SNAKEMAKE = [sys.executable, "-m", "snakemake", "--cores", "2", "--nocolor", "--configfile", "config/test.yaml"]
HANGS = 3600  # seconds after which a run counts as hanging, even on a busy machine
ROOT = Path(__file__).resolve().parents[1]
# Of the folders called results, only the results of runs are left out of a copy of the project.
NOT_COPIED = shutil.ignore_patterns(".git", ".venv*", ".snakemake", ".pytest_cache", ".hypothesis")
# Files in results/ that hold measured times differ from run to run: all files of these folders, and tables and figures
# of these names with any suffix.
TIMED_FOLDERS = {"logs", "benchmarks"}
TIMED = {
    "methods",
    "one_surface",
    "mean_accuracy",
    "sufficient_models",
    "speed",
    "index",
}
NODE = socket.gethostname().split(".")[0]
# The cluster has no accounting, jobs take seconds, and no other user queries their states.
QUICK = ("--slurm-status-command", "squeue", "--slurm-init-seconds-before-status-checks", "3")
THROUGH_SLURM = ("--profile", "profiles/slurm", *QUICK)

MUNGED = "munged --foreground --force --num-threads 2 --socket {0}/munge.socket --key-file {0}/munge.key \
--pid-file {0}/munged.pid --log-file {0}/munged.log --seed-file {0}/munged.seed"

# Inside a job, the executor removes SLURM_CONF from the environment of srun, which would then look in /etc/slurm.
SRUN = '#!/bin/sh\nSLURM_CONF={conf} exec {srun} "$@"\n'

SLURM_CONF = """\
ClusterName=test
SlurmctldHost={node}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
NodeName={node} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory} State=UNKNOWN
PartitionName=test Nodes={node} Default=YES MaxTime=INFINITE State=UP
"""


def copy_project(folder):
    """Copy the project into a folder, without the results of runs."""

    def not_copied(parent, names):
        return NOT_COPIED(parent, names) | ({"results"} if Path(parent) == ROOT else set())

    shutil.copytree(ROOT, folder, ignore=not_copied, dirs_exist_ok=True)


def holds_times(path):
    """Return True if a file, by its path below the folder of results, holds measured times."""
    return path.parts[0] in TIMED_FOLDERS or path.stem in TIMED


def remove_results(folder):
    for name in ("results", ".snakemake"):
        shutil.rmtree(folder / name, ignore_errors=True)


def wait_for(condition, what, seconds=120):
    """Wait until the condition is true, and return its value."""
    end = time.monotonic() + seconds
    while not (value := condition()):
        if time.monotonic() > end:
            raise click.ClickException(f"{what} does not happen within {seconds} s")
        time.sleep(0.2)
    return value


def run_to_end(folder, *arguments, disturb=None):
    """Return the seconds of a run that may be disturbed and must end without an error; its output goes to a log."""
    start = time.perf_counter()
    with (folder / "run.log").open("w") as log:
        streams = {"stdout": log, "stderr": log, "start_new_session": True}
        variables = os.environ | {"PYTHONPATH": str(folder / "src")}  # the packages of the copy
        run = subprocess.Popen([*SNAKEMAKE, *arguments], cwd=folder, env=variables, **streams)
    try:
        if disturb:
            disturb()
        if code := run.wait(HANGS):
            raise click.ClickException(f"{folder.name} ends with {code}:\n{log_tail(folder)}")
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(run.pid, signal.SIGKILL)
        run.wait()
    return time.perf_counter() - start


def log_tail(folder):
    return "\n".join((folder / "run.log").read_text().splitlines()[-20:])


def contents(folder):
    """Return {name: bytes} of all files in results/, without the bytes of files that hold times."""
    results = folder / "results"
    names = sorted(path.relative_to(results) for path in results.rglob("*") if path.is_file())
    return {str(name): b"" if holds_times(name) else (results / name).read_bytes() for name in names}


def compare(folder, expected):
    """Return one line for each file in results/ that differs from the expected contents."""
    actual = contents(folder)
    lines = [f"{name}: is missing or left over" for name in sorted(actual.keys() ^ expected.keys())]
    return lines + [f"{name}: differs" for name in expected if actual.get(name, expected[name]) != expected[name]]


def printed(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


# ---- a cluster of one machine


def free_ports():
    """Return two free ports."""
    with socket.create_server(("127.0.0.1", 0)) as first, socket.create_server(("127.0.0.1", 0)) as second:
        return first.getsockname()[1], second.getsockname()[1]


@contextlib.contextmanager
def cluster(folder):
    """Start the daemons of Munge and Slurm, and stop them at the end in any case."""
    conf = folder / "slurm.conf"
    for name in ("state", "spool", "bin"):
        (folder / name).mkdir()
    (folder / "munge.key").write_bytes(os.urandom(128))
    (folder / "munge.key").chmod(0o600)
    memory = psutil.virtual_memory().total // 2**20 * 3 // 4
    settings = {"node": NODE, "folder": folder, "ports": free_ports(), "cpus": os.cpu_count(), "memory": memory}
    conf.write_text(SLURM_CONF.format(**settings))
    (folder / "bin" / "srun").write_text(SRUN.format(conf=conf, srun=shutil.which("srun")))
    (folder / "bin" / "srun").chmod(0o755)
    os.environ["PATH"] = f"{folder / 'bin'}:{os.environ['PATH']}"
    os.environ["SLURM_CONF"] = str(conf)  # read by the daemons and every command, which passes it on to every job
    try:
        start(folder, MUNGED.format(folder).split())
        wait_for((folder / "munge.socket").exists, "start of munged")
        start(folder, ["slurmctld", "-D", "-c"])
        start(folder, ["slurmd", "-D", "-N", NODE])
        wait_for(lambda: state() == "idle", "start of the node")
        yield
    finally:
        with contextlib.suppress(click.ClickException, subprocess.SubprocessError, OSError):
            printed("scancel", "--quiet", "--user", "root")
            wait_for(lambda: not printed("squeue", "--noheader"), "end of the remaining jobs", 60)
        stop(str(conf))


def start(folder, command):
    with (folder / f"{command[0]}.out").open("w") as log:
        subprocess.Popen(command, stdout=log, stderr=log, start_new_session=True)


def processes(conf):
    """Yield processes with this cluster's settings in their environment: daemons, jobs and their parents."""
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            if process.pid != os.getpid() and process.environ().get("SLURM_CONF") == conf:
                yield process


def stop(conf):
    """End all processes of the cluster; processes started in the meantime are ended in the next round."""
    for end in ("terminate", "kill", "kill"):
        own = list(processes(conf))
        for process in own:
            with contextlib.suppress(psutil.NoSuchProcess):
                getattr(process, end)()
        psutil.wait_procs(own, timeout=20)


def state():
    """Return the state of the node, such as idle; None while the daemons are not running."""
    done = subprocess.run(["sinfo", "--noheader", "--format", "%T"], capture_output=True, text=True, check=False)
    return done.stdout.strip() or None


def set_state(value):
    printed("scontrol", "update", f"nodename={NODE}", f"state={value}", "reason=test")


def jobs(state):
    """Return Slurm's numbers of the jobs in a state, RUNNING or PENDING."""
    return printed("squeue", "--noheader", "--array", "--states", state, "--format", "%i").split()


# ---- runs


def disturb():
    """Cancel a job of the run, drain the node, and lose it with its jobs."""
    (victim, *_) = wait_for(lambda: jobs("RUNNING"), "start of a job")
    printed("scancel", victim)
    wait_for(lambda: set(jobs("RUNNING")) - {victim}, "start of another job")
    set_state("drain")
    wait_for(lambda: state() == "drained", "end of the jobs on the drained node")
    wait_for(lambda: jobs("PENDING"), "submission of a job to the drained node")
    time.sleep(10)  # a drained node must not start a job in this time
    if jobs("RUNNING"):
        raise click.ClickException("the drained node gets jobs")
    set_state("resume")
    wait_for(lambda: jobs("RUNNING"), "start of a job on the resumed node")
    set_state("down")
    time.sleep(3)
    set_state("resume")
    click.echo("a job cancelled, the node drained, resumed, lost and resumed")


def compare_runs(folder):
    """Return both runs, as a dictionary for the file."""
    local, through, daemons = folder / "local", folder / "through", folder / "cluster"
    copy_project(local)
    seconds = {"local": run_to_end(local)}
    expected = contents(local)
    click.echo(f"local: {seconds['local']:.0f} s, {len(expected)} files")
    shutil.copytree(local, through)  # keep code that the local run has compiled
    remove_results(through)
    daemons.mkdir()
    with cluster(daemons):
        seconds["slurm"] = run_to_end(through, *THROUGH_SLURM, disturb=disturb)
        version = printed("sinfo", "--version")
    differences = compare(through, expected)
    click.echo("\n".join([f"through Slurm: {seconds['slurm']:.0f} s", *differences]))
    return {"slurm": version, "seconds": seconds, "files_compared": len(expected), "differences": differences}


@click.command(help=__doc__.splitlines()[0])
@output_option
def main(output):
    if os.geteuid() or not all(map(shutil.which, ("munged", "slurmctld", "slurmd", "sbatch"))):
        raise click.ClickException("root is needed, and Slurm: apt-get install slurm-wlm munge")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # raise an exception, so that the daemons are ended
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)  # all users must be able to reach the socket of munged
        result = compare_runs(Path(folder).resolve())
    save(result, output)
    sys.exit(bool(result["differences"]))


if __name__ == "__main__":
    main()
