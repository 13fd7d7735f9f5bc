"""Manages the output folder of a run."""
import contextlib
import fcntl
import json
import os
import signal
import tempfile
from collections.abc import Iterator
from pathlib import Path

from build.console import Failure

PICTURES = ("start.png", "middle.png", "end.png")
RESULTS = ("manifest.json", "metrics.csv", "nodes.csv", "replay.html", "run.clkrec", "profile.jfr", *PICTURES)
# Values of the outcome in the player's manifests.
RUNNING, COMPLETE, WITHOUT_PICTURES = "running", "complete", "the pictures are missing"
# The player's exit code after it has printed a file error.
FILE_ERROR = 74
# The exit codes of a player that a signal interrupted.
SIGNALLED = (128 + signal.SIGINT, 128 + signal.SIGTERM)
UNFINISHED = (*(f"{name}.part" for name in RESULTS), "replay.tmp")
# The folder that stores the earlier results until a new run has begun.
BACKUP = "earlier.part"
# The file that marks the folder of a sweep, `MARKER` of collektive_experiments.
SWEEP = ".collektive-sweep"


@contextlib.contextmanager
def open_folder(folder: Path, overwrite: bool) -> Iterator[None]:
    """Creates the folder of a run, locks it until this process and its children end, and removes earlier results.

    If the run fails before it completes a tick, for example because of an invalid seed or JVM option, restores the earlier results. Raises `Failure` if the
    folder cannot be used, or if it has earlier results and `overwrite` is false.
    """
    for place in Path(os.path.realpath(folder)).parents:
        # A resumed sweep may delete the folders of its runs and its bundle, as in `deletable_above` of collektive_experiments.
        sweep = place.parent.parent if place.parent.name == "runs" else place.parent if place.name == "bundle" or place.suffix == ".part" else None
        if sweep and (place / SWEEP).exists() and (sweep / SWEEP).exists():
            raise Failure(f"'{place}' belongs to a sweep, which may delete it: name another folder with --out")
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
    if (folder / SWEEP).exists():
        # The sweep would replace or delete nodes.csv.
        raise Failure(f"'{folder}' is the folder of a sweep: name another folder with --out")
    try:
        # An earlier command may have been killed before it restored the results.
        _end(folder)
        earlier, unfinished = _existing(folder, RESULTS), _existing(folder, UNFINISHED)
        if earlier and not overwrite:
            raise Failure(f"'{folder}' has results of a run: {', '.join(earlier)}; name another folder with --out, or add --overwrite")
        if (earlier or unfinished) and not is_of_run(folder):
            raise Failure(f"'{folder}' has {', '.join(earlier + unfinished)}, but no manifest of a run: name another folder with --out, or move these files")
        for name in unfinished:
            (folder / name).unlink()
        with tempfile.TemporaryFile(dir=folder):
            pass
        if earlier:
            (folder / BACKUP).mkdir()
    except OSError as error:
        raise Failure(f"cannot write to the output folder '{folder}': {error.strerror}; name another folder with --out") from error
    try:
        for name in earlier:
            (folder / name).rename(folder / BACKUP / name)
        yield
        if not _is_open(folder, descriptor):
            raise Failure(f"'{folder}' was moved, deleted or replaced during the run")
    finally:
        if _is_open(folder, descriptor):
            _end(folder)


def _is_open(folder: Path, descriptor: int) -> bool:
    """Returns whether a folder is the one that was opened, and not another at the same path."""
    try:
        return os.path.samestat(os.stat(folder), os.fstat(descriptor))
    except OSError:
        return False


def _end(folder: Path) -> None:
    """Deletes the earlier results if a new run has begun, and restores them otherwise."""
    earlier = folder / BACKUP
    if earlier.is_symlink() or not earlier.is_dir():
        return
    manifest = folder / "manifest.json"
    if _failed_before_first_tick(manifest):
        # Deletes the manifest last, so that the next command continues if this one is killed.
        for name in reversed(_existing(folder, RESULTS)):
            (folder / name).unlink()
    if not manifest.exists():
        for name in _existing(folder, UNFINISHED):
            (folder / name).unlink()
        # Restores the manifest last, because it shows that a run has begun.
        for name in reversed(_existing(earlier, RESULTS)):
            (earlier / name).rename(folder / name)
    for name in _existing(earlier, RESULTS):
        (earlier / name).unlink()
    earlier.rmdir()


def _failed_before_first_tick(manifest: Path) -> bool:
    """Returns whether a run ended before it completed its first tick, unless a script ended it with code 0."""
    try:
        run = json.loads(manifest.read_bytes())
        return bool(run["ticks"] == 0 and run["outcome"] not in (COMPLETE, WITHOUT_PICTURES))
    except (OSError, ValueError, KeyError, TypeError):
        return False


def is_of_run(folder: Path) -> bool:
    """Returns whether a run wrote the folder's manifest. The file may also be unrelated to runs."""
    manifest = folder / "manifest.json"
    try:
        # Reading a pipe would wait for its writer.
        return manifest.is_file() and b'"outcome":' in manifest.read_bytes()
    except OSError:
        return False


def _existing(folder: Path, names: tuple[str, ...]) -> list[str]:
    return [name for name in names if os.path.lexists(folder / name)]


def require_replaceable(file: str, beginning: bytes, option: str) -> None:
    """Raises `Failure` if a file exists that does not begin like the results that would replace it, or that has another name, which would change too.

    Also raises `Failure` for a pipe, a device or a folder.
    """
    if not os.path.exists(file):
        return
    if not os.path.isfile(file):
        # A writer would wait for the reader of a pipe, and a recording would replace a device.
        raise Failure(f"{option} '{file}' is not a regular file: name another file")
    if os.stat(file).st_nlink > 1:
        raise Failure(f"'{file}' is a hard link: {option} would also overwrite its other names; name another file, or remove it")
    with open(file, "rb") as existing:
        if existing.read(len(beginning)) not in (b"", beginning):
            raise Failure(f"'{file}' exists and was not written by {option}: name another file, or remove it")


def require(folder: Path, outcome: str, code: int) -> None:
    """Raises `Failure` if the manifest of a run contradicts the player's exit code.

    After code 0, the manifest must exist and contain the given outcome. After another code, its outcome must not be `RUNNING`, unless SIGINT or SIGTERM
    ended the player. After SIGKILL, it must exist. Raises `Failure` without a message if the player has printed a file error.
    """
    try:
        found = json.loads((folder / "manifest.json").read_text())["outcome"]
    except (OSError, ValueError, KeyError) as error:
        if code == 0:
            raise Failure(f"the run wrote no usable manifest to '{folder}': {error}") from error
        found = None
    if code == FILE_ERROR and found not in (COMPLETE, WITHOUT_PICTURES):
        raise Failure("", 1)
    if found in (None, RUNNING) and code == 128 + signal.SIGKILL:
        raise Failure("the player was killed during the run. A usual cause is that the memory is full", code)
    if found == RUNNING and code not in SIGNALLED:
        raise Failure(f"the player exited with code {code} during the run. Usual causes: infinite recursion in a script, a script that ends the process, "
                      "a JVM crash", max(code, 1))
    if found != outcome and code == 0:
        raise Failure(f"the run is not complete: {found}")


def complete(folder: Path) -> None:
    """Marks a run as complete when its pictures are on the disk."""
    manifest, part = folder / "manifest.json", folder / "manifest.json.part"
    # Replaces only the text, because parsing and writing the JSON could change the digits of numbers.
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
    """Returns the lines of a complete run's summary: metrics at the start and the end, times and files."""
    run = json.loads((folder / "manifest.json").read_text())
    runtime = run["scenario"]["runtime"]
    return [
        f"{run['nodes']} nodes, {run['ticks']} ticks, {run['shim_calls']} calls into the JVM, seed {run['scenario']['seed']}, digest {run['digest']}"
        + ("" if runtime == "BuiltIn" else f" (runtime {runtime})"),
        *(f"  {name.replace('_', ' ')}: {float(run['start'][name]):.2f} -> {float(run['end'][name]):.2f}" for name in run["end"]),
        f"  bridge and rounds {run['step_ms_median']:.2f} ms per tick (median), whole tick {run['tick_ms_median']:.2f} ms (median), "
        f"{run['tick_ms_p99']:.2f} ms (p99)",
        f"  {run['ticks'] / max(run['wall_seconds'], 1e-9):.0f} ticks/s; {run['errors']} errors",
        *(str(folder / name) for name in sorted(os.listdir(folder))),
    ]
