"""Fetched folders: filled once for what they depend on, started over after an interruption or an error."""
import pytest
from checkout import Checkout

NOT_DONE = "try: fetch.once('thing', '1', lambda folder: logged('broken', ['false']))\nexcept Failure as failure: sys.exit(f'collektive: {failure}')"


def once(key: str) -> str:
    return f"lock.shared(); fetch.once('thing', '{key}', make)"


def test_a_folder_is_filled_once_for_what_it_depends_on(checkout: Checkout) -> None:
    for key in ["1", "1", "2", "2"]:
        assert checkout.run(once(key)).returncode == 0
    assert checkout.made() == ["made, 0 files there"] * 2


def test_an_error_ends_it_and_names_the_log(checkout: Checkout) -> None:
    for _ in range(2):
        result = checkout.run(NOT_DONE)
        assert result.returncode == 1
        assert f"broken failed; the whole log is {checkout.root}/build/log/broken.log" in result.stderr
    assert checkout.run(once("1")).returncode == 0
    assert checkout.made() == ["made, 0 files there"]


def test_one_that_was_killed_starts_over(checkout: Checkout) -> None:
    assert checkout.run(once("1")).returncode == 0
    checkout.close_gate()
    process = checkout.start(once("2"))
    with open(checkout.root / "gate", "w"):  # returns when it waits at the gate
        checkout.kill(process)
    assert (checkout.root / "build/thing/half").exists()
    checkout.open_gate()
    # The folder contains half of "2" now: not even "1" is there any more.
    assert checkout.run(once("1")).returncode == 0
    assert checkout.run(once("1")).returncode == 0
    assert checkout.made() == ["made, 0 files there"] * 3


def test_a_second_command_waits_and_finds_it_done(checkout: Checkout) -> None:
    checkout.close_gate()
    first = checkout.start(once("1"))
    with open(checkout.root / "gate", "w"):
        second = checkout.start(once("1"))
        assert second.stderr is not None
        assert "waiting for another collektive command" in second.stderr.readline()
        assert second.poll() is None
    assert first.wait() == 0
    output, errors = second.communicate()
    assert (second.returncode, output, errors) == (0, "", "")
    assert checkout.made() == ["made, 0 files there"]


@pytest.mark.parametrize(("key", "file", "renamed"), [
    ("fetch.key_of([root / 'data', '1.2'])", "data/a file", "data/another file"),
    ("projects.fingerprint(root / 'data')", "data/part/a file", "data/a file"),
])
def test_a_key_depends_on_contents_and_relative_paths(checkout: Checkout, key: str, file: str, renamed: str) -> None:
    def current() -> str:
        return checkout.run(f"from build import projects; print({key})").stdout

    (checkout.root / file).parent.mkdir(parents=True)
    (checkout.root / file).write_text("one")
    keys = [current()]
    checkout.root = checkout.root.rename(checkout.root.with_name("moved"))
    assert current() == keys[0]
    (checkout.root / file).rename(checkout.root / renamed)
    keys.append(current())
    (checkout.root / renamed).write_text("two")
    keys.append(current())
    assert len(set(keys)) == 3
