"""Tests that signals reach all processes of a command, and that no process is left when the command ends."""
import os
import signal
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from checkout import SETUP, Checkout

# Code that starts a child of the group's first process. The child writes its process id to a file.
CHILD = ("processes.call([sys.executable, '-c', 'import os, signal, sys, time; signal.signal(2, signal.SIG_DFL); "
         "open(sys.argv[1], \"w\").write(str(os.getpid())); {}', str(root / 'pid')])")
SLEEP = CHILD.format("time.sleep(600)")


def run_in_group(body: str) -> str:
    return f"sys.exit(processes.run_in_group(lambda: {body}))"


def wait_for(condition: Callable[[], object]) -> None:
    """Waits until a condition is true. Fails after a minute."""
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def child_of(checkout: Checkout) -> int:
    """Waits until the child runs, and returns its process id."""
    file = checkout.root / "pid"
    wait_for(lambda: file.exists() and file.read_text())
    return int(file.read_text())


def ends(pid: int) -> bool:
    """Returns whether a process ends within a time limit, even if its parent does not wait for it."""
    end = time.monotonic() + 20
    while time.monotonic() < end:
        status = Path(f"/proc/{pid}/stat")
        try:
            if status.read_text().rpartition(")")[2].split()[0] == "Z":
                return True
        except OSError:
            return True
        time.sleep(0.02)
    return False


@pytest.mark.parametrize("code", [0, 3])
def test_the_exit_code_is_that_of_the_command(checkout: Checkout, code: int) -> None:
    assert checkout.run(run_in_group(str(code))).returncode == code


@pytest.mark.parametrize("number, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)])
def test_a_signal_ends_all_processes_and_is_the_exit_code(checkout: Checkout, number: signal.Signals, code: int) -> None:
    process = checkout.start(run_in_group(SLEEP))
    child = child_of(checkout)
    process.send_signal(number)
    assert process.wait(20) == code
    assert ends(child)


def test_nohup_protects_a_command_from_the_end_of_its_terminal(checkout: Checkout) -> None:
    process = checkout.start(f"signal.signal(signal.SIGHUP, signal.SIG_IGN); {run_in_group(CHILD.format('time.sleep(3)'))}")
    child_of(checkout)
    process.send_signal(signal.SIGHUP)
    assert process.wait(20) == 0


def test_an_interrupted_step_does_not_print_its_log(checkout: Checkout) -> None:
    # The message and the error come from the tool, which receives the signal, too.
    tool = "import signal, time; print('a message of the tool', flush=True); signal.signal(2, lambda *_: exit(1)); time.sleep(600)"
    # Fetching runs its steps in other threads.
    body = f"threading.Thread(target=run_logged, args=('tool', [sys.executable, '-c', {tool!r}])).start() or time.sleep(600)"
    process = checkout.start(f"import threading, time; {run_in_group(body)}")
    log = checkout.root / "build/log/tool.log"
    wait_for(lambda: log.exists() and log.read_text())
    process.send_signal(signal.SIGINT)
    output, error = process.communicate(timeout=20)
    assert "a message of the tool" not in output + error


def test_a_signal_that_ended_a_process_is_the_exit_code(checkout: Checkout) -> None:
    assert checkout.run(run_in_group("__import__('os').kill(__import__('os').getpid(), 9)")).returncode == 137


def test_a_command_ends_without_an_init_process_that_reaps_orphans(checkout: Checkout) -> None:
    # This parent does not reap orphans. In a container, the first process often does not reap them either.
    parent_without_reaping = ("import ctypes; ctypes.CDLL(None).prctl(36, 1, 0, 0, 0); "
                              "sys.exit(__import__('subprocess').run([sys.executable, '-c', {!r}, root]).returncode)")
    orphan = run_in_group("__import__('subprocess').Popen(['sleep', '0.5']) and 0")
    assert checkout.run(parent_without_reaping.format(SETUP + orphan)).returncode == 0


@pytest.mark.parametrize("kill", [os.kill, os.killpg])
def test_a_command_that_is_killed_leaves_no_process(checkout: Checkout, kill: Callable[[int, int], None]) -> None:
    process = checkout.start(run_in_group(SLEEP))
    child = child_of(checkout)
    kill(process.pid, signal.SIGKILL)
    process.wait()
    assert ends(child)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_stopped_processes(checkout: Checkout, number: signal.Signals) -> None:
    process = checkout.start(run_in_group(SLEEP))
    child = child_of(checkout)
    os.killpg(os.getpgid(child), signal.SIGSTOP)
    process.send_signal(number)
    assert process.wait(20) == 128 + number
    assert ends(child)


@pytest.mark.parametrize("body, code", [("print('text', flush=True)", 0), ("sys.stdin.read()", 1)])
def test_a_terminal_does_not_stop_a_command(checkout: Checkout, body: str, code: int) -> None:
    program = f"""import os, pty, termios
pid, terminal = pty.fork()
if pid == 0:
    settings = termios.tcgetattr(0)
    settings[3] |= termios.TOSTOP
    termios.tcsetattr(0, termios.TCSANOW, settings)
    {run_in_group(body)}
sys.exit(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
"""
    assert checkout.start(program).wait(20) == code


def test_an_interrupt_lets_the_running_program_end_normally(checkout: Checkout) -> None:
    body = CHILD.format("import signal; signal.signal(signal.SIGINT, lambda *_: (time.sleep(0.5), os._exit(0))); time.sleep(600)")
    process = checkout.start(run_in_group(body))
    child = child_of(checkout)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    assert process.wait(20) == 0
    assert ends(child)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_command_cleans_up_after_a_signal(checkout: Checkout, number: signal.Signals) -> None:
    process = checkout.start(f"def main():\n    try:\n        return {SLEEP}\n    finally:\n        (root / 'end').touch()\n" + run_in_group("main()"))
    child = child_of(checkout)
    process.send_signal(number)
    assert process.wait(20) == 128 + number
    assert ends(child)
    assert (checkout.root / "end").exists()


def test_a_signal_at_the_start_ends_all_processes(checkout: Checkout) -> None:
    fork = """import os, time
fork = os.fork
def fork_and_end():
    pid = fork()
    if pid > 0 and not (root / 'pid').exists():
        (root / 'pid').write_text(str(pid))
        os.kill(os.getpid(), signal.SIGTERM)
    return pid
os.fork = fork_and_end
"""
    process = checkout.start(fork + run_in_group("time.sleep(600)"))
    assert process.wait(20) == 128 + signal.SIGTERM
    assert ends(child_of(checkout))


def test_a_signal_that_arrives_twice_does_not_interrupt_the_cleanup(checkout: Checkout) -> None:
    main = """def main():
    try:
        wait_for('begun')
    finally:
        wait_for('cleaning')
        (root / 'end').touch()
def wait_for(name):
    (root / name).touch()
    while not (root / f'{name}.done').exists():
        time.sleep(0.01)
"""
    process = checkout.start("import time\n" + main + run_in_group("main()"))
    for name in ["begun", "cleaning"]:
        wait_for((checkout.root / name).exists)
        process.send_signal(signal.SIGTERM)
    time.sleep(0.1)
    (checkout.root / "cleaning.done").touch()
    assert process.wait(20) == 128 + signal.SIGTERM
    assert (checkout.root / "end").exists()


def test_orphans_of_a_program_end_in_any_process_group(checkout: Checkout) -> None:
    program = """processes.call(['sh', '-c', 'setsid sleep 600 & echo $! > "$0"', str(root / 'pid')])"""
    began = time.monotonic()
    assert checkout.run(run_in_group(f"{program} or processes.end_orphans() or 0")).returncode == 0
    assert time.monotonic() - began < 10
    assert ends(child_of(checkout))


def test_a_detached_program_outlives_the_command(checkout: Checkout) -> None:
    """Tests a program that starts another one and ends, as xdg-open does with the user's browser."""
    # Python ignores exceptions in __del__, including KeyboardInterrupt. If __del__ is called before the end, it is so slow that the signal arrives inside it.
    main = """import subprocess, time
subprocess.Popen.__del__ = lambda *_: time.sleep(1)
def main():
    try:
        processes.start_detached(['sh', '-c', 'sleep 600 & echo $! > "$0"', str(root / 'pid')])
        while True:
            time.sleep(0.05)
    finally:
        processes.end_orphans()
"""
    process = checkout.start(main + run_in_group("main()"))
    child = child_of(checkout)
    process.send_signal(signal.SIGINT)
    assert process.wait(20) == 128 + signal.SIGINT
    # The signal fails if the program has ended.
    os.kill(child, signal.SIGKILL)


def test_a_command_ends_after_the_last_of_its_processes(checkout: Checkout) -> None:
    began = time.monotonic()
    assert checkout.run(run_in_group("__import__('subprocess').Popen(['sleep', '2']) and 0")).returncode == 0
    assert time.monotonic() - began >= 2
