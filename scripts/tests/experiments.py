"""Runs tests of the package collektive_experiments: `experiments.py WORD...`, with arguments of pytest."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import experiments, processes
from build.places import EXPERIMENTS_PYTHON, ROOT

if __name__ == "__main__":
    sys.exit(processes.call([EXPERIMENTS_PYTHON, "-m", "pytest", "-c", ROOT / "scripts/tests/pytest.ini", *sys.argv[1:]], env=experiments.environment()))
