"""Other public contact solvers, run in environments of their own on the same levels as ours.

Each is driven by an adapter, a script that reads a request and writes an answer (.npz); it runs under the Python of the
peer's environment, which does not know this package. What a peer leaves as residual is computed here, from its
pressures alone.
"""

import subprocess
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from viscorough import __version__
from viscorough.contact.halfspace import Halfspace
from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import timing


@dataclass(frozen=True)
class Peer:
    """A solver: its name, the Python of its environment, and its adapter."""

    name: str
    python: Path
    adapter: Path

    @property
    def present(self):
        """Whether its environment is there."""
        return self.python.is_file()


@dataclass(frozen=True)
class PeerAnswer:
    """What a peer found at every level, for one tolerance; arrays of shape (levels,).

    depth, force : u and F/G of its pressures; residual : largest |gap in contact| or penetration over depth,
        computed anew; iterations : -1 where it does not tell
    wall_s, processor_s : for all levels, without its set-up; memory : of its process [bytes]; version : of the peer
    """

    version: str
    depth: np.ndarray
    force: np.ndarray
    residual: np.ndarray
    iterations: np.ndarray
    wall_s: float
    processor_s: float
    memory: float


def padded_size(elements):
    """Smallest size of a grid with a factor of 8 and no prime factor above 11: a good length of transforms."""
    size = -(-elements // 8) * 8
    while _largest_factor(size) > 11:
        size += 8
    return size


def _largest_factor(number):
    factor = 2
    while factor * factor <= number:
        if number % factor:
            factor += 1
        else:
            number //= factor
    return number


def ask(peer, indenter, depths, forces, tolerances, *, threads=1, longest=60.0):
    """Answers of a peer at the given levels, started from each other: a PeerAnswer per tolerance, None where it failed.

    depths, forces : u and F/G of the levels, in the indenter's unit of length; a peer takes one or the other
    longest : seconds after which a tolerance is given up

    Warns, with its last line, if the peer's process fails.
    """
    spacing = indenter.spacing
    gap = indenter.initial_gap / spacing
    with tempfile.TemporaryDirectory() as folder:
        request, answer = Path(folder) / "request.npz", Path(folder) / "answer.npz"
        np.savez(
            request,
            gap=gap,
            depths=np.asarray(depths) / spacing,
            forces=np.asarray(forces) / spacing**2,
            tolerances=np.asarray(tolerances, dtype=float),
            padding=padded_size(max(gap.shape)),
            threads=threads,
            repeats=1,
            maximum_seconds=longest,
        )
        command = [peer.python, peer.adapter, request, answer]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=longest * len(tolerances) + 60)
        except subprocess.TimeoutExpired:
            warnings.warn(f"{peer.name}: no answer in {longest:g} s for each tolerance", stacklevel=2)
            return [None] * len(tolerances)
        if done.returncode or not answer.is_file():
            reason = (done.stderr.strip() or "no answer").splitlines()[-1]
            warnings.warn(f"{peer.name}: {reason}", stacklevel=2)
            return [None] * len(tolerances)
        with np.load(answer) as found:
            found = {name: found[name] for name in found.files}
    answers = []
    for i in range(len(tolerances)):
        if not np.isfinite(found["wall"][i]).all():
            answers.append(None)
            continue
        pressures = found["pressures"][i]
        # Peers at given force find the depth; those at given depth keep it.
        residual = np.array([residual_of(gap, *each) for each in zip(pressures, found["depth"][i], strict=True)])
        answers.append(
            PeerAnswer(
                version=str(found["version"]),
                depth=found["depth"][i] * spacing,
                force=pressures.sum(axis=(1, 2)) * spacing**2,
                residual=residual,
                iterations=found["iterations"][i],
                wall_s=float(np.median(found["wall"][i])),
                processor_s=float(np.median(found["cpu"][i])),
                memory=float(found["memory_mb"]) * 1e6,
            )
        )
    return answers


def residual_of(gap, pressure, depth):
    """Largest |gap between the surfaces| where there is pressure, or penetration where there is none, over the depth.

    gap : to the highest point, nan outside the indenter; pressure : p/G; lengths in element sides
    """
    rows, columns = gap.shape
    halfspace = Halfspace(rows, columns)
    halfspace.load[:, :columns] = pressure / (4 * np.pi)
    opening = halfspace.apply()[:, :columns] - depth + gap
    inside = np.isfinite(gap)
    contact = inside & (pressure > 0)
    pressed_outside = np.abs(pressure[~inside]).max(initial=0.0) > 0
    if pressed_outside or not contact.any():
        return np.inf
    return max(np.abs(opening[contact]).max(), -opening[inside].min(), 0.0) / depth


# Tolerances of peers, over the residual asked for, from loose to tight: each peer means by them what it does.
SWEEP = (30, 10, 3, 1, 1 / 3, 1 / 10, 1 / 30, 1 / 100)
SLOWEST = 20.0  # what takes more seconds is not repeated
COLUMNS = {
    "task": ("what is computed", ""),
    "hurst": ("Hurst exponent of the disc", "1"),
    "elements": ("elements across the disc", "1"),
    "levels": ("levels", "1"),
    "solver": ("solver", ""),
    "version": ("version of the solver", ""),
    "threads": ("threads", "1"),
    "tolerance": ("its loosest tolerance that meets the residual asked for, else its best", "1"),
    "residual": ("largest residual of any level, from the pressures", "1"),
    "met": ("1 if that is within the residual asked for", "1"),
    "force_error": ("largest relative error of the force at any level", "1"),
    "wall_s": ("wall time, median of interleaved repeats", "s"),
    "processor_s": ("processor time, median of interleaved repeats", "s"),
    "ratio": ("wall time over that of the path on one thread", "1"),
    "iterations": ("iterations of a peer (-1: not told), operators of the path", "1"),
    "memory": ("memory of a peer's process; of the path, its arrays", "bytes"),
}


def race(task, hurst, elements, fractions, target, peers, *, threads, repeats, seed, longest, report=lambda text: None):
    """The path against peers: levels at given contact fractions of a disc, to one residual, each as fast as it can.

    The path's time is for everything, exact stiffness at every level included; a peer's is without its set-up and
    without stiffness. Peers start every level from the one before.

    fractions : contact fractions; target : residual asked for; longest : seconds after which a peer is given up

    Returns a pandas.DataFrame with the columns of `COLUMNS`; a row per solver that is present, and number of threads.
    """
    disc = self_affine_disc(hurst, elements, seed=seed)
    coarse = indent(disc, tolerance=1e-2, until_fraction=min(1.0, 1.2 * max(fractions)))
    depths = np.interp(fractions, coarse.contact_fraction, coarse.depth)
    exact = indent(disc, tolerance=1e-10, depths=depths)

    def path():
        return indent(disc, tolerance=target, depths=depths)

    about = {"task": task, "hurst": hurst, "elements": elements, "levels": len(depths)}
    curve, memory = timing.with_memory(path)
    rows, chosen, known = [], {}, {}
    ours = about | {"solver": "viscorough", "version": __version__, "threads": 1, "tolerance": target, "memory": memory}
    ours |= {"residual": curve.residual.max(), "iterations": curve.operator_applications}
    rows.append(ours | {"force_error": np.abs(curve.force / exact.force - 1).max()})
    for peer in peers:
        report(f"{task}, H = {hurst:g}: {peer.name}, looking for its tolerance")
        found = _loosest(peer, disc, depths, exact.force, target, longest)
        if found is None:
            continue
        tolerance, answer = found
        for number in threads:
            chosen[peer, number] = tolerance
            known[peer] = {1: (answer.wall_s, answer.processor_s)}
            row = about | {"solver": peer.name, "version": answer.version, "threads": number, "tolerance": tolerance}
            row |= {"residual": answer.residual.max(), "iterations": answer.iterations.sum(), "memory": answer.memory}
            rows.append(row | {"force_error": np.abs(answer.force / exact.force - 1).max()})
    times = [[] for _ in rows]
    for repeat in range(repeats):
        report(f"{task}, H = {hurst:g}: repeat {repeat + 1} of {repeats}")
        times[0].append(timing.interleaved({"path": path}, 1)["path"])
        for (peer, number), each in zip(chosen, times[1:], strict=True):
            if number not in known[peer] or known[peer][number][0] < SLOWEST:
                tolerances = [chosen[peer, number]]
                (answer,) = ask(peer, disc, depths, exact.force, tolerances, threads=number, longest=longest)
                known[peer][number] = (answer.wall_s, answer.processor_s) if answer else (np.nan, np.nan)
            each.append(known[peer][number])
    for row, each in zip(rows, times, strict=True):
        row["wall_s"], row["processor_s"] = np.median(each, axis=0)
        row["ratio"] = row["wall_s"] / rows[0]["wall_s"]
        row["met"] = int(row["residual"] <= target)
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _loosest(peer, disc, depths, forces, target, longest):
    """The loosest tolerance of SWEEP with which a peer meets the residual, else the best, and its answer; or None."""
    found = {}

    def residual(i):
        (found[i],) = ask(peer, disc, depths, forces, [SWEEP[i] * target], longest=longest)
        return np.inf if found[i] is None else found[i].residual.max()

    i = SWEEP.index(3)
    if residual(i) <= target:
        while i > 0 and residual(i - 1) <= target:
            i -= 1
    else:
        while i + 1 < len(SWEEP) and found[i] is not None:
            i += 1
            if residual(i) <= target:
                break
    answered = {j: answer.residual.max() for j, answer in found.items() if answer is not None}
    if not answered:
        return None
    best = min((j for j, left in answered.items() if left <= target), default=min(answered, key=answered.get))
    return SWEEP[best] * target, found[best]
