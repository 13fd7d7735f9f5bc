"""Tests the lock on build outputs. Commands that change the outputs must wait for other commands, and print a message."""
import argparse
import importlib
import os
import select
import subprocess
import time
from unittest.mock import MagicMock

import pytest
from checkout import Checkout

WAITING = "waiting for another collektive command"
USE = "lock.shared(); wait_at_gate()"
CHANGE = "lock.exclusive(); wait_at_gate(); print('done')"


def read_error(process: subprocess.Popen[str]) -> str:
    assert process.stderr is not None
    return str(process.stderr.readline())


def test_a_command_reports_that_it_waits_for_one_that_changes_outputs(checkout: Checkout) -> None:
    checkout.close_gate()
    first = checkout.start(CHANGE)
    with open(checkout.root / "gate", "w"):  # opening the gate for writing waits until the first process reads it
        second = checkout.start("lock.exclusive(); print('done')")
        assert WAITING in read_error(second)
        assert second.poll() is None
    assert first.wait() == 0
    output, errors = second.communicate()
    assert (second.returncode, output, errors) == (0, "done\n", "")


def test_commands_that_only_use_outputs_run_concurrently(checkout: Checkout) -> None:
    checkout.close_gate()
    first = checkout.start(USE)
    with open(checkout.root / "gate", "w"):
        assert checkout.run("lock.shared()").stderr == ""
    assert first.wait() == 0


def test_a_command_that_changes_outputs_releases_the_lock_when_it_only_uses_them(checkout: Checkout) -> None:
    checkout.close_gate()
    first = checkout.start("lock.exclusive(); lock.shared(); wait_at_gate()")
    with open(checkout.root / "gate", "w"):
        assert checkout.run("lock.shared()").stderr == ""
    assert first.wait() == 0


def test_the_second_of_two_simultaneous_commands_waits_only_for_the_build(checkout: Checkout) -> None:
    os.mkfifo(checkout.root / "start")
    runs = [checkout.start("lock.shared(); open(root / 'start').read(); fetch.fill_once('thing', '1', make); print('runs', flush=True); signal.pause()")
            for _ in range(2)]
    try:
        with open(checkout.root / "start", "w"):
            time.sleep(1)  # gives the other process time to open the file, too
        for run in runs:
            assert run.stdout is not None
            assert select.select([run.stdout], [], [], 20)[0], "the run must not wait for the other run"
            assert run.stdout.readline() == "runs\n"
        assert len(checkout.log_lines()) == 1
    finally:
        for run in runs:
            checkout.kill(run)


def test_clean_waits_for_a_command_that_uses_the_outputs(checkout: Checkout) -> None:
    checkout.close_gate()
    (checkout.root / "build").mkdir()
    first = checkout.start(USE)
    with open(checkout.root / "gate", "w"):
        second = checkout.start_command("clean")
        assert WAITING in read_error(second)
        assert (checkout.root / "build").exists()
    assert (first.wait(), second.wait()) == (0, 0)
    assert not (checkout.root / "build").exists()


def test_a_run_keeps_the_lock_of_a_command_that_was_killed(checkout: Checkout) -> None:
    checkout.close_gate()
    first = checkout.start("lock.shared(); processes.call([sys.executable, '-c', f'open({str(root / \"gate\")!r}).read()'])")
    with open(checkout.root / "gate", "w"):
        first.kill()
        first.wait()
        second = checkout.start("lock.exclusive()")
        assert WAITING in read_error(second)
    assert second.wait() == 0


def test_a_released_lock_is_free(checkout: Checkout) -> None:
    checkout.close_gate()
    first = checkout.start("lock.exclusive(); lock.release(); wait_at_gate()")
    with open(checkout.root / "gate", "w"):
        assert checkout.run("lock.exclusive()").stderr == ""
    assert first.wait() == 0


@pytest.mark.parametrize(("command", "waits"), [("plot", True), ("sweep", False)])
def test_only_commands_that_use_copies_of_the_outputs_release_the_lock(command: str, waits: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    release = MagicMock()
    monkeypatch.setattr("build.lock.release", release)
    for name in ("lock.shared", "system.setup_system", "fetch.fetch", "processes.end_orphans"):
        monkeypatch.setattr(f"build.{name}", MagicMock())
    monkeypatch.setattr("signal.pthread_sigmask", MagicMock())
    monkeypatch.setattr("build.processes.call", MagicMock(return_value=0))
    assert importlib.import_module(f"commands.{command}").run(argparse.Namespace(ray=None)) == 0
    assert release.call_count == (0 if waits else 1)
