"""Runs a sweep as an array job of Slurm. The tasks of the job share the sweep's folder."""
import fcntl
import json
import os
import shlex
import sys
import time

from . import files
from .experiment import Run
from .positions import ExperimentError
from .store import Store
from .sweep import Task
from .worker import Worker

MAX_TASKS = 1000
"""The maximum number of tasks. Slurm's usual limit for the size of an array is 1001."""
SCRIPT = """#!/usr/bin/env bash
# Executes {count} runs of a sweep. Submit with: sbatch {path}
# Afterwards, write the tables and complete missing runs with: ./collektive sweep EXPERIMENT --out {folder} --resume
#SBATCH --job-name={name}
#SBATCH --array=0-{last}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={threads}
#SBATCH --output={logs}/slurm-%a.txt
set -euo pipefail
export PYTHONPATH={package}
exec {python} -P -s -m collektive_experiments task {folder} "${{SLURM_ARRAY_TASK_ID:?run this with sbatch}}"
"""


def write_job(store: Store, todo: list[Task], threads: int, limit: float, trust: bool) -> str:
    """Writes `tasks.json` and `slurm.sh` to the sweep's folder. Returns the path of the script."""
    folder = os.path.abspath(store.folder)
    # After a line break, the rest of a comment would be a command. After a backslash, Slurm does not replace %a in the path.
    if any(character in folder for character in "\n\r\\"):
        raise ExperimentError(f"'{folder}' contains a line break or backslash, which jobs of Slurm do not support: name another folder with --out")
    size = -(-len(todo) // MAX_TASKS)
    chunks = [todo[start:start + size] for start in range(0, len(todo), size)]
    tasks = {"limit": limit, "trust": trust,
             "tasks": [[{"name": run.name, "values": run.values, "settings": run.settings, "repeated": is_repeated} for run, is_repeated in chunk]
                       for chunk in chunks]}
    files.write(os.path.join(folder, "tasks.json"), json.dumps(tasks) + "\n")
    path = os.path.join(folder, "slurm.sh")
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    files.write(path, SCRIPT.format(
        count=len(todo), path=shlex.quote(path), folder=shlex.quote(folder),
        # Slurm replaces %j and other codes in the path.
        logs=shlex.quote(f"{folder}/logs".replace("%", "%%")), name="collektive-" + "".join(c for c in os.path.basename(folder) if c.isalnum()),
        last=len(chunks) - 1, threads=threads, package=shlex.quote(package), python=shlex.quote(sys.executable)))
    os.chmod(path, 0o755)
    return path


def run_task(folder: str, index: int) -> int:
    """Executes the incomplete runs of a task. Returns the exit code."""
    log = os.path.join(folder, f"logs/task-{index}.txt")
    with Store(folder) as store, files.open_log(log) as own:
        store.lock(shared=True)
        try:
            fcntl.flock(own, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise ExperimentError(f"task {index} of '{folder}' is already running: wait for its job to end") from error
        with open(os.path.join(folder, "tasks.json"), encoding="utf-8") as file:
            job = json.load(file)
        if not 0 <= index < len(job["tasks"]):
            raise ExperimentError(f"the job has no task {index}: submit '{os.path.join(folder, 'slurm.sh')}' without --array")
        worker = Worker(store.bundle, log, job["trust"])
        failed = False
        try:
            for task in job["tasks"][index]:
                run = Run(task["name"], task["values"], task["settings"])
                if store.is_complete(run):
                    continue
                began = time.monotonic()
                outcome = worker.run(run.settings, run.process, store.begin(run), job["limit"], task["repeated"])
                store.finish(run, outcome, time.monotonic() - began)
                if outcome.status != "complete":
                    failed = True
                    print(f"{run.name}: {outcome.status}: {outcome.message}", file=sys.stderr)
        finally:
            worker.stop()
    return 1 if failed else 0
