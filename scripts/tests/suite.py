"""Runs a suite: `suite.py RESULTS [--lock] -- COMMAND...`.

Creates the folder RESULTS. With --lock, locks the build outputs for use until the suite ends. The command runs in a separate process group, which ends when
CTest kills this process after the time limit.
"""
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import lock, processes


def main(words: list[str]) -> int:
    """Runs the command of the suite and returns its exit code."""
    options, command = words[1:words.index("--")], words[words.index("--") + 1:]
    Path(words[0]).mkdir(parents=True, exist_ok=True)
    # A `python3` on the path may be a slow shim of pyenv.
    os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    if "--lock" in options:
        lock.shared()
    return processes.run_in_group(lambda: processes.call(command))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
