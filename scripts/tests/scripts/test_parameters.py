"""Tests that unknown names and invalid values in a scenario's parameters are reported before a run, which would replace earlier results."""
import zipfile
from pathlib import Path

import pytest

from build import inputs, player, projects
from build.console import Failure


def test_the_index_of_a_jar_contains_the_parameters_of_its_programs(tmp_path: Path) -> None:
    jar = tmp_path / "programs.jar"
    jar.write_bytes(b"not a jar")
    assert projects.parameters(jar) == {}
    with zipfile.ZipFile(jar, "w") as archive:
        archive.writestr("META-INF/collektive/programs/a.AKt",
                         "program\ta\\\\b\ta.SensorData\nparameter\twidth\t1\tWidth.\nprogram\tc\ta.SensorData\n")
    assert projects.parameters(jar) == {"a\\b": {"width": ["1", "Width."]}, "c": {}}


def test_a_damaged_jar_has_no_index(tmp_path: Path) -> None:
    jar = tmp_path / "programs.jar"
    with zipfile.ZipFile(jar, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("META-INF/collektive/programs/a.AKt", "program\ta\ta.SensorData\n" * 20)
        start = len(archive.infolist()[0].FileHeader())
    content = bytearray(jar.read_bytes())
    content[start] ^= 0xFF
    jar.write_bytes(content)
    assert projects.parameters(jar) == {}


@pytest.mark.parametrize("other", [
    '@org.collektive.api.Program("b")', '@[Program("b")]', '@Program("b" + "c")', '@Program("""b""")', "@Program(B)", '@Program(parameters = [], name = "b")',
    'typealias Behaviour = Program\n@Behaviour("b")', 'import org.collektive.api.Program as Behaviour\n@Behaviour("b")'])
def test_names_that_only_the_compiler_can_read_do_not_hide_others(other: str, tmp_path: Path) -> None:
    (tmp_path / "A.kt").write_text('import org.collektive.api.Program\n\n@Program("a", parameters = [])\nfun a() = 1\n@Program(name = "d")\nfun d() = 1\n')
    assert projects.program_names(inputs.programs(tmp_path)) == {"a", "d"}
    (tmp_path / "B.kt").write_text(f"{other}\nfun b() = 1\n")
    assert projects.program_names(inputs.programs(tmp_path)) is None


@pytest.mark.parametrize("parameters, message", [
    ({"hops": {"width": 1}}, "'parameters.hops': unknown program; the programs are: channel"),
    ({"channel": {"wide": 1}}, r"'parameters.channel.wide': unknown parameter; the program declares: kind, length, width"),
    ({"channel": {"width": "wide"}}, "'parameters.channel.width' is 'wide'; it must be a number like its default 1.0"),
    ({"channel": {"width": "0xZZ"}}, "'parameters.channel.width' is '0xZZ'; it must be a number like its default 1.0"),
    ({"channel": {"width": True}}, "'parameters.channel.width' is 'true'; it must be a number"),
    ({"channel": {"kind": "Blue"}}, "'parameters.channel.kind' is 'Blue'; it must be one of Red, Green"),
])
def test_invalid_parameters_are_rejected_before_the_run(parameters: dict[str, dict[str, object]], message: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(projects, "program_names", lambda part: None)
    monkeypatch.setattr(projects, "programs_jar", lambda *parts: Path("programs.jar"))
    known = {"width": ["1.0", ""], "length": ["long", ""], "kind": ["Red", "", "Red", "Green"]}
    monkeypatch.setattr(projects, "parameters", lambda jar: {"channel": known})
    parts = dict.fromkeys(("schema", "programs"))
    for file in [{"parameters": parameters}, {"scenario": {"parameters": parameters}, "parameters": {}}]:
        with pytest.raises(Failure, match=message):
            player.Plan({"file": file}, parts).programs_jar()  # type: ignore[arg-type]
    for width in (1, -2.5e-3, "1.", ".5f", "NaN", "-Infinity", " 7 ", "0x1p3"):
        plan = player.Plan({"file": {"parameters": {"channel": {"width": width, "length": "x", "kind": "Green"}}}}, parts)  # type: ignore[arg-type]
        assert plan.programs_jar() == Path("programs.jar")
