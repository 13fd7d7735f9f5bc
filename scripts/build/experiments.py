"""Runs the package collektive_experiments in a Python environment with packages from PyPI."""
import os
import re
import runpy
import signal
import sys
from collections.abc import Callable, Mapping
from typing import Any

from build import fetch, lock, processes, system
from build.jdk import find_jdk
from build.places import COLLEKTIVE, EXPERIMENTS_PYTHON, ROOT

EXPERIMENTS = ROOT / "experiments"


def option(name: str) -> Callable[..., Any]:
    """Returns a function of the package's module `options`. Unlike the other modules, this one can be loaded without the package's environment."""
    function: Callable[..., Any] = runpy.run_path(str(EXPERIMENTS / "collektive_experiments/options.py"))[name]
    return function


def environment() -> Mapping[str, str]:
    """Returns the environment variables for running the package."""
    # Settings of the user's Python and Matplotlib, which a notebook passes to its commands, can prevent the start.
    inherited = {name: value for name, value in os.environ.items() if not re.match("PYTHON|MPLBACKEND$|SOURCE_DATE_EPOCH$", name)}
    return {**inherited, "COLLEKTIVE_JAVA_HOME": str(find_jdk()), "COLLEKTIVE": str(COLLEKTIVE), "PYTHONPATH": str(EXPERIMENTS),
            "PYTHONDONTWRITEBYTECODE": "1"}


def run(*tools: str, is_sweep: bool = True) -> int:
    """Fetches `tools`, and then runs the package with the command line of this process."""
    system.setup_system()
    variables = environment()
    lock.shared()
    fetch.fetch("experiments", *tools)
    if is_sweep:
        # It runs copies of the build outputs, so other commands can build during the sweep.
        lock.release()
    # Ctrl-C waits until the package is imported, and handles it.
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    code = processes.call([EXPERIMENTS_PYTHON, "-P", "-s", "-m", "collektive_experiments", *sys.argv[1:]], env=variables)
    processes.end_orphans()
    return code
