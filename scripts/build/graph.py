"""Builds targets of the build graph, which CMake describes and Ninja builds."""
import contextlib
import json
import os
import shutil
import stat
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from build import depfile, fetch, jdk, lock, processes
from build.console import Failure, run_logged
from build.places import GRAPH, ROOT
from build.system import NUNIT, setup_system

# The arguments with which CMake has configured the build tree.
STAMP = GRAPH / "arguments"
# The change times of all sources in nanoseconds. The file's time is the beginning of the last build.
BEGIN = GRAPH / "begin"
NINJA_LOG = GRAPH / ".ninja_log"
# Folders named `build` are omitted, except that of the scripts that steps run.
SOURCES = ("cmake", "jvm-host", "native-shim", "schema", "scripts", "scripts/build", "tools", "unity")


def build(*targets: str, tools: Sequence[str] = ()) -> None:
    """Brings targets up to date, fetches missing tools at the same time, and keeps a shared lock on the outputs.

    If nothing has changed, no exclusive lock is needed, so runs do not wait for each other.
    """
    setup_system()
    lock.shared()
    # Maven must not run twice at the same time, so its tools are fetched before the build.
    fetch.fetch(*fetch.BASE, *(tool for tool in tools if tool in fetch.MAVEN))

    def make() -> None:
        with ThreadPoolExecutor(1) as pool:
            fetched = pool.submit(fetch.fetch_missing, tools)
            if NINJA_LOG.exists() and NINJA_LOG.stat().st_mtime_ns > time.time_ns():
                # The clock was set back, so changed sources can be older than outputs. Without its log, Ninja builds everything.
                STAMP.unlink(missing_ok=True)
                NINJA_LOG.unlink()
            if not _is_configured():
                _configure()
            for source in _missed():
                if not _is_touchable(source):
                    # Without its log, Ninja builds everything.
                    NINJA_LOG.unlink(missing_ok=True)
                    continue
                with contextlib.suppress(FileNotFoundError):
                    os.utime(source)
            BEGIN.write_text(json.dumps({path: status.st_ctime_ns for path, status in _sources().items()}))
            if processes.call(["ninja", *targets], cwd=GRAPH, stdout=sys.stderr.fileno()) != 0:
                raise Failure("the build failed; the messages are above")
            fetched.result()

    lock.change(lambda: not fetch.missing(tools) and _is_configured() and not _missed() and is_up_to_date(GRAPH, *targets), make)


def is_up_to_date(tree: Path, *targets: str) -> bool:
    """Returns whether Ninja finds nothing to do for targets of a build tree."""
    dry = subprocess.run(["ninja", "-n", *targets], cwd=tree, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return dry.returncode == 0 and "no work to do" in dry.stdout


def _missed() -> list[str]:
    """Returns sources whose changes Ninja misses, because it only compares modification times, and not with the beginning of a build.

    They changed during the last build, or have earlier times than it, for example after `rsync -a` or if the clock was set back. Programs cannot set the
    change times of files. Sources with a time in the future are included if they can be touched, because Ninja would build them every time.
    """
    now = time.time_ns()
    known: dict[str, int] = {}
    folder_end, file_end = 0, 0
    with contextlib.suppress(OSError, ValueError):
        begin, log = BEGIN.stat(), NINJA_LOG.stat()
        # In a copy of a checkout, such as a container image, change times are the times of copying.
        if begin.st_ctime_ns == begin.st_mtime_ns:
            known, folder_end, file_end = json.loads(BEGIN.read_bytes()), begin.st_mtime_ns, log.st_mtime_ns
    found = []
    for path, status in _sources().items():
        is_future = status.st_mtime_ns > now and _is_touchable(path)
        end = folder_end if stat.S_ISDIR(status.st_mode) else file_end
        if is_future or (status.st_mtime_ns <= end and known.get(path) != status.st_ctime_ns):
            found.append(path)
    return found


def _is_touchable(path: str) -> bool:
    """Returns whether the build may change the time of a source: it does not belong to another user, and is not a link to a file outside."""
    return os.access(path, os.W_OK) and not os.path.islink(path)


def _sources() -> dict[str, os.stat_result]:
    paths = [str(ROOT / "CMakeLists.txt")]
    for place in SOURCES:
        for folder, folders, files in os.walk(ROOT / place):
            folders[:] = [name for name in folders if name not in depfile.IGNORED]
            paths += [folder, *(os.path.join(folder, name) for name in files)]
    found = {}
    for path in paths:
        # An editor may just remove its temporary file.
        with contextlib.suppress(FileNotFoundError):
            found[path] = os.stat(path)
    return found


def _arguments() -> list[str]:
    prefix_map = f'-ffile-prefix-map="{ROOT}"=.'
    return [
        "-G", "Ninja", "-S", str(ROOT), "-B", str(GRAPH),
        "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
        f"-DCMAKE_C_FLAGS={prefix_map}",
        f"-DCMAKE_CXX_FLAGS={prefix_map}",
        f"-DCOLLEKTIVE_JAVA_HOME={jdk.find_jdk()}",
        f"-DCOLLEKTIVE_TEST_JDKS={';'.join(map(str, jdk.test_jdks()))}",
        # The resolved path is the system's Python, even if the command runs in a virtual environment.
        f"-DCOLLEKTIVE_PYTHON={Path(sys.executable).resolve()}",
        f"-DCOLLEKTIVE_NUNIT={NUNIT if NUNIT.exists() else ''}",
    ]


def _is_configured() -> bool:
    return STAMP.exists() and STAMP.read_text() == "\n".join(_arguments())


def _configure() -> None:
    cache = GRAPH / "CMakeCache.txt"
    if not cache.exists() or f"CMAKE_HOME_DIRECTORY:INTERNAL={ROOT}\n" not in cache.read_text():
        # CMake refuses a build tree whose checkout was moved.
        shutil.rmtree(GRAPH, ignore_errors=True)
    # CMake stores its arguments even if it fails or is interrupted.
    STAMP.unlink(missing_ok=True)
    run_logged("configure", ["cmake", *_arguments()])
    STAMP.write_text("\n".join(_arguments()))
