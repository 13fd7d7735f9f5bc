"""The folder that a run writes to: prepared before the run, summarized after it."""
import fcntl
import json
import os
import signal
import tempfile
from pathlib import Path

from build.console import Failure

PICTURES = ("start.png", "middle.png", "end.png")
RESULTS = ("manifest.json", "metrics.csv", "nodes.csv", "replay.html", "run.clkrec", *PICTURES)
# Outcomes in the player's manifests.
RUNNING, COMPLETE, WITHOUT_PICTURES = "running", "complete", "the pictures are missing"
# Exit codes of a player that was interrupted or killed.
SIGNALLED = (128 + signal.SIGINT, 128 + signal.SIGTERM, 128 + signal.SIGKILL)
UNFINISHED = (*(f"{name}.part" for name in RESULTS), "replay.tmp")


def prepare(folder: Path, overwrite: bool) -> None:
    """Makes the folder and locks it until this process and its children end.

    Results of an earlier run in it are refused, or removed with `overwrite`: its contents afterwards come from one run.
    Raises `Failure` if the folder cannot be used.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Failure(f"cannot create the output folder '{folder}': {error.strerror}; name another folder with --out") from error
    descriptor = os.open(folder, os.O_RDONLY)
    os.set_inheritable(descriptor, True)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise Failure(f"another run writes to '{folder}': name another folder with --out") from error
    try:
        earlier = [name for name in RESULTS if os.path.lexists(folder / name)]
        if earlier and not overwrite:
            raise Failure(f"'{folder}' has results of a run: {', '.join(earlier)}; name another folder with --out, or add --overwrite")
        for name in [*earlier, *UNFINISHED]:
            (folder / name).unlink(missing_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise Failure(f"cannot write to the output folder '{folder}': {error.strerror}; name another folder with --out") from error


def require(folder: Path, outcome: str, code: int) -> None:
    """Raises `Failure` unless a player that ended with the code 0 left a manifest with the outcome, or one that failed says why."""
    try:
        found = json.loads((folder / "manifest.json").read_text())["outcome"]
    except (OSError, ValueError, KeyError) as error:
        if code != 0:
            return
        raise Failure(f"the run wrote no usable manifest to '{folder}': {error}") from error
    if found == RUNNING and code not in SIGNALLED:
        raise Failure(f"the player ended with code {code} before its run did. Usual causes: endless recursion in a script, a script that ends the process, "
                      "a crash of the JVM", max(code, 1))
    if found != outcome and code == 0:
        raise Failure(f"the run is not complete: {found}")


def complete(folder: Path) -> None:
    """Declares a run complete whose pictures were missing, after these are on disk."""
    manifest, part = folder / "manifest.json", folder / "manifest.json.part"
    # A replacement in the text: other writers of JSON write other digits.
    part.write_text(manifest.read_text().replace(json.dumps(WITHOUT_PICTURES), json.dumps(COMPLETE), 1))
    for path in (*(folder / name for name in PICTURES), part):
        _sync(path)
    part.replace(manifest)
    _sync(folder)


def _sync(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def summary(folder: Path) -> list[str]:
    """Describes what a complete run has written to its folder: how it began and ended, its times, its files."""
    ran = json.loads((folder / "manifest.json").read_text())
    runtime = ran["scenario"]["runtime"]
    return [
        f"{ran['nodes']} nodes, {ran['ticks']} ticks, {ran['shim_calls']} calls into the JVM, seed {ran['scenario']['seed']}, digest {ran['digest']}"
        + ("" if runtime == "BuiltIn" else f" (runtime {runtime})"),
        *(f"  {name.replace('_', ' ')}: {ran['start'][name]:.2f} -> {ran['end'][name]:.2f}" for name in ran["end"]),
        f"  bridge and rounds {ran['step_ms_median']:.2f} ms a tick (median), whole tick {ran['tick_ms_median']:.2f} ms (median), "
        f"{ran['tick_ms_p99']:.2f} ms (p99)",
        f"  {ran['ticks'] / max(ran['wall_seconds'], 1e-9):.0f} ticks/s; {ran['errors']} errors",
        *(str(folder / name) for name in sorted(os.listdir(folder))),
    ]
