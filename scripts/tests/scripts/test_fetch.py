"""Tests that a fetched folder is filled once for each key, and filled again after an interruption or an error."""
import hashlib
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from checkout import Checkout

from build import fetch
from build.places import ROOT

NOT_DONE = "try: fetch.fill_once('thing', '1', lambda folder: run_logged('broken', ['false']))\nexcept Failure as failure: sys.exit(f'collektive: {failure}')"


def once(key: str) -> str:
    return f"lock.shared(); fetch.fill_once('thing', '{key}', make)"


def test_a_folder_is_filled_once_per_key(checkout: Checkout) -> None:
    for key in ["1", "1", "2", "2"]:
        assert checkout.run(once(key)).returncode == 0
    assert checkout.log_lines() == ["made, 0 files there"] * 2


def test_an_error_ends_the_step_and_names_the_log(checkout: Checkout) -> None:
    for _ in range(2):
        result = checkout.run(NOT_DONE)
        assert result.returncode == 1
        assert f"broken failed; the full log is {checkout.root}/build/log/broken.log" in result.stderr
    assert checkout.run(once("1")).returncode == 0
    assert checkout.log_lines() == ["made, 0 files there"]


def test_a_killed_step_starts_over(checkout: Checkout) -> None:
    assert checkout.run(once("1")).returncode == 0
    checkout.close_gate()
    process = checkout.start(once("2"))
    with open(checkout.root / "gate", "w"):  # opening the gate for writing waits until the process reads it
        checkout.kill(process)
    assert (checkout.root / "build/thing/half").exists()
    checkout.open_gate()
    # The folder now contains half of the content for "2", and nothing of the content for "1".
    assert checkout.run(once("1")).returncode == 0
    assert checkout.run(once("1")).returncode == 0
    assert checkout.log_lines() == ["made, 0 files there"] * 3


def test_a_new_environment_of_experiments_gets_its_additions_again(checkout: Checkout) -> None:
    requirements = checkout.root / "experiments/requirements.txt"
    (checkout.root / "experiments/requirements-test.txt").touch()
    pip = "fetch._install = lambda requirements, folder: (folder / requirements.name).touch(); fetch.run_logged = lambda *words: None; lock.shared(); "
    # The second environment has no additions. The third environment has the same key as the first one, but must get its additions again.
    for tool, content in [("experiments-tests", "1"), ("experiments", "2"), ("experiments-tests", "1")]:
        requirements.write_text(content)
        result = checkout.run(f"{pip}fetch.fetch('{tool}')")
        assert result.returncode == 0, result.stderr
    assert (checkout.root / "build/experiments/requirements-test.txt").exists()


def test_an_environment_and_its_addition_are_each_fetched_once(checkout: Checkout) -> None:
    for name in ("requirements.txt", "requirements-test.txt"):
        (checkout.root / "experiments" / name).touch()
    install = "fetch._install = lambda requirements, folder: print(requirements.name); fetch.run_logged = lambda *words: None; lock.shared(); "
    result = checkout.run(f"{install}fetch.fetch('experiments', 'experiments-tests')")
    assert result.stdout == "requirements.txt\nrequirements-test.txt\n", result.stderr


def test_a_second_command_waits_for_the_first_and_skips_the_step(checkout: Checkout) -> None:
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
    assert checkout.log_lines() == ["made, 0 files there"]


def test_a_key_depends_on_contents_and_relative_paths(checkout: Checkout) -> None:
    def current() -> str:
        return checkout.run("print(fetch.key_of([root / 'data', '1.2']))").stdout

    file = checkout.root / "data/part/a file"
    file.parent.mkdir(parents=True)
    file.write_text("one")
    keys = [current()]
    checkout.root = checkout.root.rename(checkout.root.with_name("moved"))
    assert current() == keys[0]
    (checkout.root / "data/part/a file").rename(checkout.root / "data/a file")
    keys.append(current())
    (checkout.root / "data/a file").write_text("two")
    keys.append(current())
    assert len(set(keys)) == 3


def test_a_damaged_download_is_fetched_again(checkout: Checkout) -> None:
    client = "read -r stored <stored 2>/dev/null || stored=whole; echo $stored; test $stored = whole"
    (checkout.root / "stored").write_text("damaged\n")
    result = checkout.run(f"fetch._downloaded('crate', ['sh', '-c', {client!r}], (root / 'stored').unlink, cwd=root)")
    assert result.returncode == 0, result.stderr
    assert "crate failed: retrying without cached downloads" in result.stderr


def test_a_persistent_error_ends_the_command(checkout: Checkout) -> None:
    result = checkout.run("fetch._downloaded('crate', ['false'], lambda: None)")
    assert "Failure: crate failed" in result.stderr


def test_a_jar_that_differs_from_its_checksum_is_removed(checkout: Checkout, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = checkout.root / "repository"
    (repository / "org/it").mkdir(parents=True)
    for name in "whole", "damaged", "local", "unverified":
        (repository / f"org/it/{name}.jar").write_text(name)
    monkeypatch.setenv("MAVEN_OPTS", "-Xmx1g -Dmaven.repo.local=repository")
    (repository / "org/it/whole.jar.sha1").write_text(hashlib.sha1(b"whole").hexdigest())
    (repository / "org/it/unverified.jar.sha1").touch()
    (repository / "org/it/damaged.jar.sha1").write_text(hashlib.sha1(b"as it was").hexdigest() + "  damaged.jar")
    repair = "import os; os.chdir(root); from build import maven_repository; print(maven_repository.repair())"
    assert checkout.run(repair).stdout == "True\n"
    assert sorted(path.name for path in repository.rglob("*.jar")) == ["local.jar", "unverified.jar", "whole.jar"]
    assert checkout.run(repair).stdout == "False\n"


def test_a_jar_that_the_user_installed_over_a_download_is_kept(checkout: Checkout, monkeypatch: pytest.MonkeyPatch) -> None:
    jar = checkout.root / "repository/org/it/1/it-1.jar"
    jar.parent.mkdir(parents=True)
    jar.write_text("own")
    # Maven keeps the checksum of the download, and adds the second line.
    jar.with_name("it-1.jar.sha1").write_text(hashlib.sha1(b"downloaded").hexdigest())
    jar.with_name("_remote.repositories").write_text("#Mon Nov 30 12:50:28 UTC 2026\nit-1.jar>central=\nit-1.jar>=\n")
    monkeypatch.setenv("MAVEN_OPTS", "-Dmaven.repo.local=repository")
    result = checkout.run("import os; os.chdir(root); from build import maven_repository; print(maven_repository.repair())")
    assert (result.stdout, jar.exists()) == ("False\n", True)


def test_a_repository_in_a_comment_of_mavens_settings_is_ignored(checkout: Checkout, monkeypatch: pytest.MonkeyPatch) -> None:
    settings = checkout.root / ".m2/settings.xml"
    settings.parent.mkdir()
    # Maven's template contains this comment.
    settings.write_text("<settings><!-- Default:\n<localRepository>/path/to/local/repo</localRepository>\n--></settings>")
    monkeypatch.setenv("HOME", str(checkout.root))
    monkeypatch.delenv("MAVEN_OPTS", raising=False)
    assert checkout.run("from build import maven_repository; print(maven_repository._location())").stdout == f"{checkout.root}/.m2/repository\n"


def test_only_the_pinned_version_of_a_crate_is_discarded(checkout: Checkout, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    cache, sources = tmp_path / "registry/cache/index", tmp_path / "registry/src/index"
    cache.mkdir(parents=True)
    for version in "0.30.1", "0.40.0":
        (cache / f"libsqlite3-sys-{version}.crate").touch()
        (sources / f"libsqlite3-sys-{version}").mkdir(parents=True)
    (checkout.root / "tools/sqlite").mkdir(parents=True)
    shutil.copy(ROOT / "tools/sqlite/Cargo.lock", checkout.root / "tools/sqlite")
    monkeypatch.setenv("CARGO_HOME", str(tmp_path))
    result = checkout.run("fetch._discard_crate('sqlite', 'libsqlite3-sys')")
    assert result.returncode == 0, result.stderr
    # Other projects of the user may need the other versions without a network.
    assert [path.name for path in (*cache.iterdir(), *sources.iterdir())] == ["libsqlite3-sys-0.30.1.crate", "libsqlite3-sys-0.30.1"]


@pytest.mark.parametrize(("tool", "files"), [
    ("_physx", ["sources/core", "LICENSE", "physx/LICENSE.md", "physx/physx/include/Px.h", "physx/physx/source/Px.cpp"]),
    ("_flatbuffers", ["flatbuffers/net/FlatBuffers/ByteBuffer.cs"])])
def test_sources_of_a_crate_are_newer_than_outputs_of_another_version(tool: str, files: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Ninja builds only newer files. Files that a patch changed in the other version must be built, too."""
    crate, folder = tmp_path / "crate", tmp_path / "folder"
    for file in files:
        (crate / file).parent.mkdir(parents=True, exist_ok=True)
        (crate / file).touch()
    for path in [crate, *crate.rglob("*")]:
        os.utime(path, (0, 0))
    monkeypatch.setattr(fetch, "_crate", lambda *_: crate)
    monkeypatch.setattr(fetch, "_patch", lambda *_: None)
    folder.mkdir()
    began = folder.stat().st_mtime_ns
    getattr(fetch, tool)(folder)
    assert [path for path in [folder, *folder.rglob("*")] if path.stat().st_mtime_ns < began] == []


def test_maven_rejects_a_file_that_differs_from_its_checksum(tmp_path: Path) -> None:
    """Resolves the parent of a POM, because this needs no plugin."""
    shutil.copytree(ROOT / ".mvn", tmp_path / ".mvn")
    parent = tmp_path / "repository/a/b/1/b-1.pom"
    parent.parent.mkdir(parents=True)
    head = "<project><modelVersion>4.0.0</modelVersion>"
    parent.write_text(f"{head}<groupId>a</groupId><artifactId>b</artifactId><version>1</version><packaging>pom</packaging></project>")
    (tmp_path / "pom.xml").write_text(f"{head}<parent><groupId>a</groupId><artifactId>b</artifactId><version>1</version><relativePath/></parent>"
                                      "<artifactId>c</artifactId><packaging>pom</packaging><repositories><repository><id>r</id>"
                                      f"<url>file://{tmp_path}/repository</url></repository></repositories></project>")
    checksum = hashlib.sha1(parent.read_bytes(), usedforsecurity=False).hexdigest()
    for stored, is_valid in (("0" * 40, False), (checksum, True)):
        (parent.parent / "b-1.pom.sha1").write_text(stored)
        command = ["mvn", "-B", "-U", f"-Dmaven.repo.local={tmp_path}/local", "-f", str(tmp_path / "pom.xml"), "validate"]
        result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        assert (result.returncode == 0) == is_valid, result.stdout
        assert ("Checksum validation failed" in result.stdout) != is_valid


@pytest.mark.parametrize("requirements", sorted([*ROOT.glob("tools/*/requirements.txt"), *ROOT.glob("experiments/requirements*.txt")]))
def test_each_requirement_has_hashes(requirements: Path) -> None:
    for line in requirements.read_text().splitlines():
        assert re.fullmatch(r"#.*|[\w.-]+==[\w.]+(?: --hash=sha256:[0-9a-f]{64})+", line), line
