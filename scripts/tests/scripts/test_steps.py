"""The steps of the build: done once, started over after they were killed, ended by their first error, and locked."""
import os
import shutil
import signal
import subprocess

import pytest
from places import ROOT

STEPS = """
make_thing() { echo "made${INTERRUPTED:+ again}" >>"$ROOT/made"; cat "$ROOT/gate"; }
thing() { once thing "$1" make_thing; }
broken() { false; echo "went on"; }
try_broken() { if once broken key broken; then echo "was right"; fi; }
"""


class Checkout:
    """The scripts in a folder of their own, with some steps more, and a space in its name."""

    def __init__(self, folder):
        self.root = folder / "a b"
        shutil.copytree(os.path.join(ROOT, "scripts"), self.root / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        for path in ["collektive", "jvm-host/pom.xml", "unity/Runtime/Bridge/csc.rsp"]:
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(os.path.join(ROOT, path), self.root / path)
        with open(self.root / "scripts/test.sh", "a") as file:
            file.write(STEPS)
        self.open_gate()

    def open_gate(self):
        (self.root / "gate").unlink(missing_ok=True)
        (self.root / "gate").touch()

    def close_gate(self):
        """Lets make_thing wait until something is written to the gate."""
        (self.root / "gate").unlink()
        os.mkfifo(self.root / "gate")

    def start(self, *words):
        # A group of its own, so that it can be killed with all that it started.
        return subprocess.Popen([self.root / "collektive", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)

    def step(self, *words):
        return subprocess.run([self.root / "collektive", "step", *words], capture_output=True, text=True)

    def made(self):
        return (self.root / "made").read_text().splitlines()


@pytest.fixture
def checkout(tmp_path):
    return Checkout(tmp_path)


def test_a_step_is_done_once_for_what_it_depends_on(checkout):
    for key in ["1", "1", "2", "2"]:
        assert checkout.step("thing", key).returncode == 0
    assert checkout.made() == ["made", "made"]


def test_a_step_ends_at_its_first_error_and_is_not_done(checkout):
    for _ in range(2):
        result = checkout.step("try_broken")
        assert result.returncode == 1
        assert f"broken failed; the whole log is {checkout.root}/build/log/broken.log" in result.stderr
        assert "went on" not in result.stdout + result.stderr + (checkout.root / "build/log/broken.log").read_text()


def test_a_step_that_was_killed_starts_over_and_knows_it(checkout):
    assert checkout.step("thing", "1").returncode == 0
    checkout.close_gate()
    process = checkout.start("step", "thing", "2")
    with open(checkout.root / "gate", "w"):  # returns when the step waits at the gate
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    checkout.open_gate()
    # The outputs are those of a half-done "2" now: even "1" is not done any more.
    assert checkout.step("thing", "1").returncode == 0
    assert checkout.step("thing", "1").returncode == 0
    assert checkout.made() == ["made", "made", "made again"]


def test_a_second_command_waits_for_the_first_that_changes_the_build_and_says_so(checkout):
    checkout.close_gate()
    first = checkout.start("step", "thing", "1")
    with open(checkout.root / "gate", "w"):
        second = checkout.start("step", "thing", "1")
        line = second.stderr.readline()
        assert "waiting for another collektive command" in line
        assert second.poll() is None
    assert first.wait() == 0
    out, error = second.communicate()
    assert (second.returncode, out, error) == (0, "", "")
    assert checkout.made() == ["made"]


def test_commands_that_change_nothing_run_at_once(checkout):
    checkout.close_gate()
    checkout.step("true")
    first = checkout.start("step", "cat", str(checkout.root / "gate"))
    with open(checkout.root / "gate", "w"):
        assert checkout.step("true").stderr == ""
    assert first.wait() == 0


def test_clean_waits_for_a_command_that_uses_the_build(checkout):
    checkout.close_gate()
    (checkout.root / "build").mkdir()
    first = checkout.start("step", "cat", str(checkout.root / "gate"))
    with open(checkout.root / "gate", "w"):
        second = checkout.start("clean")
        assert "waiting for another collektive command" in second.stderr.readline()
        assert (checkout.root / "build").exists()
    assert (first.wait(), second.wait()) == (0, 0)
    assert not (checkout.root / "build").exists()


def test_a_fingerprint_is_of_contents_and_of_places_in_the_folder(checkout, tmp_path):
    def fingerprint():
        return checkout.step("fingerprint", str(checkout.root / "data")).stdout

    (checkout.root / "data").mkdir()
    (checkout.root / "data/a file").write_text("one")
    prints = [fingerprint()]
    checkout.root = checkout.root.rename(tmp_path / "moved")
    assert fingerprint() == prints[0]
    (checkout.root / "data/a file").rename(checkout.root / "data/another file")
    prints.append(fingerprint())
    (checkout.root / "data/another file").write_text("two")
    prints.append(fingerprint())
    assert len(set(prints)) == 3
