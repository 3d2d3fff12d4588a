"""Run the workflow through Slurm, undisturbed and disturbed, and compare its results with those of a local run.

    python benchmarks/slurm.py --output results/slurm.json

As root on Debian: slurm-wlm and munge are installed unless they are present, and a cluster of this one machine is
started on the loopback interface, with its files in a temporary folder and without the machine's own settings. The
small settings are then run three times, each in a copy of the project: locally, through Slurm with profiles/slurm, and
through Slurm while a job is cancelled, the node is drained and then lost. The files must be those of the local run,
equal to the last byte; of logs and benchmarks, which contain times, only names must agree.
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
from chaos import HANGS, compare, contents, copy_project, jobs_done, remove_results, started, wait_for
from measuring import output_option, save

NODE = socket.gethostname().split(".")[0]
# There is no accounting, jobs take seconds, and no other user queries their states.
QUICK = ("--slurm-status-command", "squeue", "--slurm-init-seconds-before-status-checks", "3")
THROUGH_SLURM = ("--profile", "profiles/slurm", *QUICK)
COMMANDS = 3  # the most times the command is run until it succeeds; with the retries of the profile, once should do
HELD = 10  # seconds during which a drained node must not start a job
PACKAGES = ("slurm-wlm", "munge")

MUNGED = "munged --foreground --force --num-threads 2 --socket {0}/munge.socket --key-file {0}/munge.key \
--pid-file {0}/munged.pid --log-file {0}/munged.log --seed-file {0}/munged.seed"

# Inside a job, the executor removes SLURM_CONF from the environment of srun, which would then look in /etc/slurm.
SRUN = '#!/bin/sh\nSLURM_CONF={conf} exec {srun} "$@"\n'

SLURM_CONF = """\
ClusterName=test
SlurmctldHost={node}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
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


def install():
    """Install the packages of Debian, unless the programs are present."""
    if os.geteuid():
        raise click.ClickException("root is needed to start daemons that run jobs")
    if all(shutil.which(name) for name in ("munged", "slurmctld", "slurmd", "sbatch")):
        return
    if not shutil.which("apt-get"):
        raise click.ClickException(f"there is no apt-get to install {' and '.join(PACKAGES)} with")
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    for arguments in (("update",), ("install", "--yes", "--no-install-recommends", *PACKAGES)):
        subprocess.run(["apt-get", "--quiet", *arguments], env=environment, check=True)


def printed(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


# ---- a cluster of one machine


def free_ports():
    """Two free ports."""
    with socket.create_server(("127.0.0.1", 0)) as first, socket.create_server(("127.0.0.1", 0)) as second:
        return first.getsockname()[1], second.getsockname()[1]


@contextlib.contextmanager
def cluster(folder):
    """The daemons of Munge and Slurm, which are stopped at the end in any case."""
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
    os.environ["SLURM_CONF"] = str(conf)  # for the daemons, every command and, passed on by it, every job
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
    """Processes with this cluster's settings in their environment: daemons, jobs and the processes that run them."""
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
    """State of the node, such as idle; None while the daemons are not running."""
    done = subprocess.run(["sinfo", "--noheader", "--format", "%T"], capture_output=True, text=True, check=False)
    return done.stdout.strip() or None


def set_state(value):
    printed("scontrol", "update", f"nodename={NODE}", f"state={value}", "reason=test")


def jobs(state):
    """Slurm's numbers of the jobs in a state, RUNNING or PENDING."""
    return printed("squeue", "--noheader", "--array", "--states", state, "--format", "%i").split()


# ---- runs


def run_project(folder, *arguments, disturb=None):
    """Run a copy to its end, repeating the command if it fails; seconds and number of commands."""
    begin = time.perf_counter()
    for command in range(1, COMMANDS + 1):
        with started(folder, *arguments, log="slurm.log", mode="a") as run:
            if disturb and command == 1:
                disturb(run)
            if run.wait(HANGS) == 0:
                return {"seconds": round(time.perf_counter() - begin, 1), "commands": command}
    tail = (folder / "slurm.log").read_text().splitlines()[-30:]
    raise click.ClickException("\n".join([f"{folder.name} fails {COMMANDS} times:", *tail]))


def disturbances(log):
    """Function that disturbs a run and appends every disturbance and its time to `log`."""

    def note(run, what):
        log.append({"after_s": round(time.time() - psutil.Process(run.pid).create_time(), 1), "what": what})
        click.echo(f"after {log[-1]['after_s']:.0f} s: {what}")

    def under_way(run, besides=()):
        def started_jobs():
            if run.poll() is not None:
                raise click.ClickException(f"the run ends before it is disturbed: {log}")
            return [job for job in jobs("RUNNING") if job not in besides]

        return wait_for(started_jobs, "start of a job")

    def disturb(run):
        victim = under_way(run)[0]
        printed("scancel", victim)
        note(run, f"job {victim} cancelled")
        under_way(run, [victim])
        set_state("drain")
        note(run, "node drained")
        wait_for(lambda: state() == "drained", "end of the jobs on the drained node")
        wait_for(lambda: jobs("PENDING"), "submission of a job to the drained node")
        time.sleep(HELD)
        if jobs("RUNNING"):
            raise click.ClickException("the drained node gets jobs")
        set_state("resume")
        note(run, "node resumed")
        lost = under_way(run)
        set_state("down")
        note(run, f"node lost with {len(lost)} jobs")
        time.sleep(3)
        set_state("resume")
        note(run, "node resumed")

    return disturb


def compare_runs(folder):
    """All three runs, as a dictionary for the file."""
    local, undisturbed, disturbed = (folder / name for name in ("local", "undisturbed", "disturbed"))
    local.mkdir()
    copy_project(local)
    remove_results(local)
    result = {"local": run_project(local)}
    wanted = contents(local)
    click.echo(f"local: {result['local']['seconds']:.0f} s, {jobs_done(local)} jobs, {len(wanted)} files")
    daemons, log = folder / "cluster", []
    daemons.mkdir()
    with cluster(daemons):
        for copy, disturb in ((undisturbed, None), (disturbed, disturbances(log))):
            shutil.copytree(local, copy)  # with what the local run has compiled
            remove_results(copy)
            outcome = run_project(copy, *THROUGH_SLURM, disturb=disturb)
            outcome["differences"] = compare(contents(copy), wanted)
            result[copy.name] = outcome
            click.echo("\n".join([f"{copy.name}: {outcome['seconds']:.0f} s", *outcome["differences"]]))
        result["slurm"] = printed("sinfo", "--version")
    return result | {"jobs": jobs_done(local), "files_compared": len(wanted), "disturbances": log}


@click.command(help=__doc__.splitlines()[0])
@output_option
def main(output):
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # as an exception, so that the daemons are ended
    install()
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)  # munged requires that all users can reach its socket
        result = compare_runs(Path(folder).resolve())
    save(result, output)
    sys.exit(any(result[name]["differences"] for name in ("undisturbed", "disturbed")))


if __name__ == "__main__":
    main()
