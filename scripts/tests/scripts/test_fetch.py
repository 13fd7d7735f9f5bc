"""Fetched folders: filled once for what they depend on, started over after an interruption or an error."""
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


def test_a_key_is_of_contents_and_names(checkout: Checkout) -> None:
    def key() -> str:
        return checkout.run("print(fetch.key_of([root / 'data', '1.2']))").stdout

    (checkout.root / "data").mkdir()
    (checkout.root / "data/a file").write_text("one")
    keys = [key()]
    checkout.root = checkout.root.rename(checkout.root.with_name("moved"))
    assert key() == keys[0]
    (checkout.root / "data/a file").rename(checkout.root / "data/another file")
    keys.append(key())
    (checkout.root / "data/another file").write_text("two")
    keys.append(key())
    assert len(set(keys)) == 3


def test_the_fingerprint_of_a_project_is_of_contents_and_of_places_in_the_folder(checkout: Checkout) -> None:
    def fingerprint() -> str:
        return checkout.run("from build import projects; print(projects.fingerprint(root / 'data'))").stdout

    (checkout.root / "data/part").mkdir(parents=True)
    (checkout.root / "data/part/a file").write_text("one")
    prints = [fingerprint()]
    checkout.root = checkout.root.rename(checkout.root.with_name("moved"))
    assert fingerprint() == prints[0]
    (checkout.root / "data/part/a file").rename(checkout.root / "data/a file")
    prints.append(fingerprint())
    (checkout.root / "data/a file").write_text("two")
    prints.append(fingerprint())
    assert len(set(prints)) == 3
