"""Tests that runs of a sweep are independent, and that a sweep changes only its own results."""
import errno
import gc
import hashlib
import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import time
import zipfile
from pathlib import Path

import pandas as pd
import pytest
from conftest import COLLEKTIVE, EIGHT, Project, processes

from collektive_experiments import ExperimentError, files, read, tables
from collektive_experiments.__main__ import main
from collektive_experiments.experiment import Run
from collektive_experiments.programs import can_leave_state
from collektive_experiments.store import Store
from collektive_experiments.worker import TIMES, Outcome, Worker, _table_difference

TWO = {"vary": {"seed": "1-2"}}


def change_scene(project: Project, build: str = "", declared: str = "", measure: str = "", names: str | None = None) -> None:
    """Adds C# to the scene: `build` at the beginning of Build, `declared` before the class, and `measure` at the end of Measure."""
    scene = project.folder / "project/scene/Lamps.cs"
    text = scene.read_text().replace("for (var i = 0; i < lamps; i++)\n", build + "\n            for (var i = 0; i < lamps; i++)\n", 1)
    text = text.replace("public sealed class LampScene", declared + "\n    public sealed class LampScene")
    end = "                values[1] += answer.SeenLength;\n            }"
    text = text.replace(end, end + measure)
    if names:
        text = text.replace('{ "agreeing", "seen" }', names)
    scene.write_text(text)


STATE = [
    ("lamps += Kept<int>.Count++;", "internal static class Kept<T> { public static int Count; }"),
    ('if (System.IO.File.Exists("lamps.txt")) lamps++; System.IO.File.WriteAllText("lamps.txt", "");', ""),
]
# More examples of the same kinds of state.
MORE_STATE = [
    ('if (System.Globalization.CultureInfo.CurrentCulture.Name == "de-DE") lamps++;'
     'System.Globalization.CultureInfo.CurrentCulture = new System.Globalization.CultureInfo("de-DE");', ""),
    ('if (System.Environment.GetEnvironmentVariable("LAMPS") != null) lamps++; System.Environment.SetEnvironmentVariable("LAMPS", "1");', ""),
    ('var cube = GameObject.CreatePrimitive(PrimitiveType.Cube); var mesh = cube.GetComponent<MeshFilter>().sharedMesh;'
     'if (mesh.bounds.size.x > 1) lamps++; mesh.bounds = new Bounds(Vector3.zero, 2 * Vector3.one);', ""),
    ("lamps += Kept.Next();", "internal static class Kept { internal static readonly System.Func<int> Next = "
     "((System.Func<System.Func<int>>)(() => { var count = 0; return () => count++; }))(); }"),
    ("lamps += Kept.List.Count; Kept.List.Add(1);", "internal static class Kept { public static readonly List<int> List = new List<int>(); }"),
    ("lamps += Kept.Next();", "internal struct Counter { private int count; internal int Next() => count++; }"
     "internal static class Kept { internal static readonly System.Func<int> Next = new Counter().Next; }"),
    ("lamps += (int)Kept.Network.delay++;", "internal static class Kept { "
     "internal static readonly Collektive.Bridge.NetworkModel Network = new Collektive.Bridge.NetworkModel(); }"),
    ("lamps += Kept.Last.Count++;", "internal struct Kept { internal static Kept Last; internal int Count;"
     "public override bool Equals(object other) => other is Kept; public override int GetHashCode() => 0; }"),
    ("if (1 / Kept.Zero < 0) lamps++; Kept.Zero = -0f;", "internal static class Kept { internal static float Zero; }"),
    ('if (System.IO.Directory.GetCurrentDirectory() == "/") lamps++; System.IO.Directory.SetCurrentDirectory("/");', ""),
    ('var cube = GameObject.CreatePrimitive(PrimitiveType.Cube); var material = cube.GetComponent<MeshRenderer>().sharedMaterial;'
     'if (material.color == Color.red) lamps++; material.color = Color.red;', ""),
    ('if (GUIContent.none.text == "lamps") lamps++; GUIContent.none.text = "lamps";', ""),
    ('if (Physics.gravity.y > 0) lamps++; Physics.gravity = Vector3.up; if (Time.fixedDeltaTime > 1) lamps++; Time.fixedDeltaTime = 2;', ""),
    ('if (System.AppDomain.CurrentDomain.GetData("lamps") != null) lamps++; System.AppDomain.CurrentDomain.SetData("lamps", "1");', ""),
]


@pytest.mark.parametrize(("build", "declared"), [*STATE, *(pytest.param(*state, marks=pytest.mark.slow) for state in MORE_STATE)])
def test_a_run_is_not_affected_by_scripts_of_earlier_runs(project: Project, build: str, declared: str) -> None:
    change_scene(project, build, declared)
    result = project.sweep("--jobs", "1", **TWO)
    assert result.returncode == 0, result.stderr
    assert len(set(project.table()["nodes"])) == 1


@pytest.mark.parametrize(("build", "declared"), [
    pytest.param("", "internal static class First { public static readonly float Value = Random.value; }", marks=pytest.mark.slow),
    ("", "internal struct Draw { public float Number; internal static Draw Next() => new Draw { Number = Random.value }; }"
     "internal static class First { private static readonly Draw Drawn = Draw.Next(); public static float Value => Drawn.Number; }"),
    pytest.param("Range.Length = Random.value;", "internal static class Range { public static float Length; }"
                 "internal static class First { public static readonly float Value; static First() { Value = Range.Length; } }", marks=pytest.mark.slow),
])
def test_static_fields_are_initialised_in_the_run_that_needs_them(project: Project, build: str, declared: str) -> None:
    change_scene(project, build + "lamps += (int)(First.Value * 50);", declared)
    assert project.sweep("--jobs", "1", **TWO).returncode == 0
    assert len(set(project.table()["nodes"])) > 1, "each run must have the value for its seed"


@pytest.mark.parametrize(("found", "change"), [
    ('System.getProperty("lamps") != null', 'System.setProperty("lamps", "1")'),
    pytest.param("java.util.Locale.getDefault() == java.util.Locale.GERMANY", "java.util.Locale.setDefault(java.util.Locale.GERMANY)", marks=pytest.mark.slow),
    pytest.param('java.util.TimeZone.getDefault().id == "Asia/Tokyo"', 'java.util.TimeZone.setDefault(java.util.TimeZone.getTimeZone("Asia/Tokyo"))',
                 marks=pytest.mark.slow)])
def test_a_run_is_not_affected_by_programs_of_earlier_runs(project: Project, found: str, change: str) -> None:
    program = project.folder / "project/programs/Brightest.kt"
    # Each run loads the class of the file once, before its first round.
    program.write_text(program.read_text().replace("brightest = best", "brightest = if (late) -1f else best")
                       + f"\nprivate val late: Boolean = ({found}).also {{ {change} }}\n")
    (project.folder / "project/lamps.json").write_text((project.folder / "project/lamps.json").read_text().replace('"seconds": 1', '"seconds": 0.1'))
    result = project.sweep("--jobs", "1", **TWO)
    assert result.returncode == 0, result.stderr
    assert len(set(project.digests().values())) == 1


@pytest.mark.parametrize(("collection", "can_leave"), [("HashSet<Lamp>()", True), pytest.param("LinkedHashSet<Lamp>()", False, marks=pytest.mark.slow)])
def test_programs_that_depend_on_hashes_can_leave_state(project: Project, tmp_path: Path, collection: str, can_leave: bool) -> None:
    program = project.folder / "project/programs/Brightest.kt"
    program.write_text(program.read_text().replace("share(mine)", f"share(mine + listOf(Lamp(0), Lamp(1)).toCollection({collection}).first().index)")
                       + "internal class Lamp(val index: Int)\n")
    assert project.sweep(vary={"seed": [1]}).returncode == 0
    assert can_leave_state(shutil.copy(project.folder / "out/bundle/programs.jar", tmp_path / "programs.jar")) == can_leave


def test_damaged_programs_can_leave_state(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "programs.jar", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("A.class", bytes(100))
        start = len(archive.infolist()[0].FileHeader())
    content = bytearray((tmp_path / "programs.jar").read_bytes())
    content[start] ^= 0xFF
    (tmp_path / "programs.jar").write_bytes(content)
    assert can_leave_state(str(tmp_path / "programs.jar"))


def test_runs_do_not_depend_on_locale_and_time_zone(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "de_DE.UTF-8")
    monkeypatch.setenv("TZ", "Asia/Tokyo")
    change_scene(project, "lamps += 1.5f.ToString().IndexOf('.') + System.TimeZoneInfo.Local.BaseUtcOffset.Hours;")
    assert project.sweep(vary={"seed": [1]}).returncode == 0
    assert list(project.table()["nodes"]) == [11]


@pytest.mark.parametrize(("build", "declared", "is_used_again"), [
    ("", "", True),
    pytest.param("System.GC.Collect();", "", False, marks=pytest.mark.slow),
    pytest.param("new Kept();", "internal sealed class Kept { ~Kept() { } }", False, marks=pytest.mark.slow),
])
def test_a_process_is_reused_only_for_scripts_without_state(
        project: Project, tmp_path: Path, build: str, declared: str, is_used_again: bool) -> None:
    change_scene(project, build, declared)
    assert project.sweep(vary={"seed": [1]}).returncode == 0
    worker = Worker(str(project.folder / "out/bundle"), str(tmp_path / "worker.txt"))
    try:
        kept = []
        for index in range(2):
            assert worker.run({"seed": index}, "{}", str(tmp_path / str(index)), 60, is_repeated=index == 1).status == "complete"
            kept.append(worker._idle)
        assert kept[0] is not None
        assert (kept[0] is kept[1]) == is_used_again
    finally:
        worker.stop()


def test_a_difference_between_a_run_and_its_repetition_stops_the_sweep(project: Project) -> None:
    change_scene(project, "lamps += (int)(System.Diagnostics.Stopwatch.GetTimestamp() % 1000);")
    result = project.sweep(**TWO)
    assert result.returncode == 1
    assert re.search(r"differs: the digest was [0-9a-f]{16}, but [0-9a-f]{16} when repeated in a fresh process", result.stderr)
    assert "the sweep stopped" in result.stderr


@pytest.mark.parametrize(("name", "old", "new", "line"), [
    ("metrics.csv", "1,0.25,", "1,0.5,", 3), ("metrics.csv", "1,0.25,7,1,2,3,4,5,6,7,8,9\n", "", 3), ("metrics.csv", ",8,9\n", ",8.5,9.5\n", 0),
    ("nodes.csv", '"a"', '"b"', 2), ("nodes.csv", "0,7,", "0,8,", 2),
])
def test_a_repetition_has_equal_tables_except_for_times(name: str, old: str, new: str, line: int, tmp_path: Path) -> None:
    header = ",".join(("second", "share", "links", *TIMES))
    texts = {"metrics.csv": header + "\n0,0,7,1,2,3,4,5,6,7,8,9\n1,0.25,7,1,2,3,4,5,6,7,8,9\n", "nodes.csv": 'second,id,text\n0,7,"a"\n'}
    for folder in ("first", "second"):
        (tmp_path / folder).mkdir()
        for table, text in texts.items():
            (tmp_path / folder / table).write_text(text.replace(old, new) if folder == "second" and table == name else text)
    problem = _table_difference(str(tmp_path / "first"), str(tmp_path / "second"))
    assert problem.startswith(f"line {line} of {name} was ") if line else problem == ""
    (tmp_path / "second/metrics.csv").unlink()
    assert _table_difference(str(tmp_path / "first"), str(tmp_path / "second")).startswith("line 1 of metrics.csv was ")


PRINTED = """
            var output = System.Console.OpenStandardOutput();
            var text = System.Text.Encoding.ASCII.GetBytes("collektive-run {\\"code\\": 0, \\"again\\": true}\\n{\\"code\\": 0, \\"again\\": true}\\n");
            output.Write(text, 0, text.Length);
            output.Flush();
"""
CLOSED = "new System.IO.FileStream(new Microsoft.Win32.SafeHandles.SafeFileHandle((System.IntPtr)1, true), System.IO.FileAccess.Write).Dispose();"


def test_a_script_cannot_fake_a_response(project: Project) -> None:
    change_scene(project, PRINTED + "System.Diagnostics.Process.GetCurrentProcess().Kill();")
    result = project.sweep(vary={"seed": [1]})
    assert result.returncode == 1
    assert list(project.table()["status"]) == ["crashed"]


@pytest.mark.slow
def test_a_script_that_closes_its_output_times_out(project: Project) -> None:
    change_scene(project, CLOSED + "while (true) System.Threading.Thread.Sleep(10);")
    result = project.sweep("--time-limit", "3", vary={"seed": [1]})
    assert result.returncode == 1
    assert list(project.table()["status"]) == ["timeout"]


@pytest.mark.slow
def test_a_pipe_that_a_script_left_in_the_folder_is_not_read(project: Project) -> None:
    change_scene(project, 'System.Diagnostics.Process.Start("sh", "-c \'cd ../../runs/*/ && mkfifo pipe\'").WaitForExit();')
    result = project.sweep(vary={"seed": [1]})
    assert result.returncode == 0, result.stderr
    assert (project.run("seed=1") / "pipe").is_fifo()


@pytest.mark.slow
def test_processes_of_scripts_end_with_the_sweep(project: Project) -> None:
    change_scene(project, f'System.Diagnostics.Process.Start("sh", "-c \'setsid sleep 600; : {project.folder}/child\'");')
    command = [COLLEKTIVE, "sweep", project.experiment(vary={"seed": [1]}), "--out", str(project.folder / "out")]
    result = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stderr
    assert not processes(f"{project.folder}/child")


@pytest.mark.slow
def test_a_failed_sweep_releases_its_folder(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    words = ["sweep", project.experiment(vary={"seed": [1]}), "--out", str(project.folder / "out")]

    def fail(*_: object) -> None:
        raise OSError("a full disk")
    with monkeypatch.context() as broken:
        broken.setattr(Store, "finish", fail)
        gc.disable()
        try:
            assert main(words) == 1
            assert main([*words, "--resume"]) == 1
        finally:
            gc.enable()
    assert main(words) == 0


@pytest.mark.slow
def test_an_interrupted_deletion_leaves_no_incomplete_bundle(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    words = ["sweep", project.experiment(vary={"seed": [1]}), "--out", str(project.folder / "out")]
    assert main(words) == 0
    shutil.rmtree(project.run("seed=1"))

    def fail(*_: object) -> None:
        raise OSError("a full disk")
    with monkeypatch.context() as broken:
        broken.setattr(shutil, "rmtree", fail)
        assert main([*words, "--resume"]) == 1
    assert not (project.folder / "out/bundle").exists()
    assert main(words) == 0


def test_a_folder_of_the_user_is_not_modified(project: Project) -> None:
    out = project.folder / "out"
    for name in ("bundle", "runs/x.part"):
        (out / name).mkdir(parents=True)
        (out / name / "thesis.txt").write_text("all of it")
    result = project.sweep(**TWO)
    assert result.returncode == 1
    assert result.stderr.count("\n") == 1 and "was not created by a sweep" in result.stderr
    assert [(out / name / "thesis.txt").read_text() for name in ("bundle", "runs/x.part")] == ["all of it"] * 2


@pytest.mark.parametrize("name", ["", "runs", "sweep.json", *(pytest.param(name, marks=pytest.mark.slow)
                                                             for name in ("bundle", "logs", "logs/check.txt", "runs.parquet"))])
def test_nothing_is_written_through_a_symbolic_link(project: Project, name: str) -> None:
    elsewhere = project.folder / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "thesis.txt").write_text("all of it")
    out = project.folder / "out"
    if name:
        (out / "logs").mkdir(parents=True)
        (out / ".collektive-sweep").touch()
        if name == "logs":
            (out / "logs").rmdir()
    (out / name).symlink_to(elsewhere if "." not in name else elsewhere / "thesis.txt")
    result = project.sweep(vary={"seed": [1]})
    assert os.listdir(elsewhere) == ["thesis.txt"]
    assert (elsewhere / "thesis.txt").read_text() == "all of it"
    assert "Traceback" not in result.stderr
    # The sweep replaces these two files, and with them the links. All other links are errors.
    assert (result.returncode == 0) == (name in ("sweep.json", "runs.parquet"))


def test_resume_repeats_runs_with_damaged_results(project: Project) -> None:
    keys = {"vary": {"seed": "1-10"}}
    assert project.sweep(**keys).returncode == 0
    before = project.digests()
    damages = list(itertools.product(("run.json", "manifest.json", "metrics.csv"), ("empty", "truncated", "removed")))
    for seed, (name, damage) in enumerate(damages, 1):
        path = project.run(f"seed={seed}") / name
        content = path.read_bytes()
        if damage == "removed":
            path.unlink()
        else:
            # The file is cut at the end of a line, so the rest is still a valid table.
            path.write_bytes(b"" if damage == "empty" else content[:content.rindex(b"\n", 0, -1) + 1])
    (project.folder / "out/sweep.json").write_text("")
    result = project.sweep("--resume", **keys)
    assert result.returncode == 0, result.stderr
    assert result.stderr.count("is damaged; repeating the run") == len(damages)
    assert "sweep.json' is damaged; writing it again" in result.stderr
    assert "1 of 10 runs are already complete" in result.stderr
    assert project.digests() == before


def test_a_scenario_is_read_as_the_player_reads_it(project: Project) -> None:
    scenario = project.folder / "project/lamps.json"
    scenario.write_text("\ufeff" + scenario.read_text().replace('"scene":', '// the scene\n  "scene":').replace('"metrics": true }', '"metrics": true, }, '))
    result = project.sweep(vary={"seed": [1]})
    assert result.returncode == 0, result.stderr


def test_names_and_values_of_metrics_cannot_inject_code_or_paths(project: Project) -> None:
    names = ["<script>alert(1)</script>", '../../x, "y"\n$z$', "../../x, 'y'_$z$"]
    change_scene(project, measure=" values[2] = lamps == 1 ? double.NaN : lamps == 2 ? double.PositiveInfinity : 7;",
                 names="{ " + ", ".join(json.dumps(name) for name in names) + " }")
    result = project.sweep(vary={"fields.lamps": [1, 2, 3]}, measure=names)
    assert result.returncode == 0, result.stderr
    runs, series = project.table(), project.table(name="series")
    assert list(runs.columns[-len(names) - 8:-8]) == names
    assert runs[names[2]].isna().tolist() == [True, True, False]
    assert series[names[2]].dropna().tolist() == [7, 7]
    assert "is NaN or infinite in 2 runs" in result.stderr
    out = project.folder / "out"
    everything = set(project.folder.rglob("*"))
    assert main(["plot", str(out)]) == 0
    assert all(path.is_relative_to(out / "figures") or path == out / "figures.html" for path in set(project.folder.rglob("*")) - everything)
    page = (out / "figures.html").read_text()
    assert "<script" not in page and "Content-Security-Policy" in page
    assert len(list((out / "figures").glob("*.svg"))) == 6


def test_a_missing_run_in_a_table_is_an_error(lamps: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    experiment = read(lamps.experiment(**EIGHT))
    records = tables._Columns.records
    monkeypatch.setattr(tables._Columns, "records", lambda columns: list(records(columns))[1:])
    before = pd.read_parquet(lamps.folder / "out/runs.parquet")
    try:
        assert tables.write(experiment, Store(str(lamps.folder / "out")), False) == len(before) - 1
    finally:
        monkeypatch.undo()
        tables.write(experiment, Store(str(lamps.folder / "out")), True)


@pytest.mark.parametrize(("name", "is_removed"), [("manifest.json", False), ("metrics.csv", False), ("nodes.csv", False), ("nodes.csv", True)])
def test_a_run_with_changed_results_is_not_complete_in_the_tables(lamps: Project, tmp_path: Path, name: str, is_removed: bool) -> None:
    out = tmp_path / "out"
    shutil.copytree(lamps.folder / "out", out)
    path = out / "runs" / lamps.run("fields.lamps=5,network.loss=0,seed=1").name / name
    text = path.read_text()
    path.unlink()
    if not is_removed:
        path.write_text(text.replace('"errors": 0', '"errors": 7') if name == "manifest.json" else text[:text.rindex("\n", 0, -1) + 1])
    assert tables.write(read(lamps.experiment(**EIGHT)), Store(str(out)), False) == 7


@pytest.mark.parametrize("is_moved", [False, True])
def test_a_sweep_does_not_write_to_a_folder_that_another_sweep_created_again(lamps: Project, tmp_path: Path, is_moved: bool) -> None:
    out = tmp_path / "out"
    experiment = read(lamps.experiment(**EIGHT))
    run = next(iter(experiment.runs()))
    with Store(str(out)) as first, Store(str(out)) as second:
        first.open(experiment, False)
        if is_moved:
            out.rename(tmp_path / "former")
        else:
            shutil.rmtree(out)
        for _ in range(2):
            for write in (lambda: first.begin(run), lambda: first.finish(run, Outcome("failed"), 1), lambda: tables.write(experiment, first, False)):
                with pytest.raises(ExperimentError, match="was moved or deleted during the sweep"):
                    write()
            second.open(experiment, False)
        assert not os.listdir(out / "runs") and not list(out.glob("*.parquet*"))


@pytest.mark.parametrize("name", ["csharp/Collektive.Unity.dll", ""])
def test_resume_rejects_a_changed_bundle(lamps: Project, tmp_path: Path, name: str) -> None:
    out = tmp_path / "out"
    shutil.copytree(lamps.folder / "out", out)
    path = out / "bundle" / (name or "jars/new.jar")
    path.write_bytes(path.read_bytes() + b"\n" if name else b"")
    result = lamps.sweep("--resume", out=str(out), **EIGHT)
    assert result.returncode == 1
    assert "bundle' was changed after the earlier runs: " in result.stderr


def test_a_bundle_that_changes_during_the_sweep_is_an_error(project: Project, monkeypatch: pytest.MonkeyPatch,
                                                            capsys: pytest.CaptureFixture[str]) -> None:
    finish = Store.finish

    def change_and_finish(store: Store, run: Run, outcome: Outcome, seconds: float) -> None:
        with open(os.path.join(store.bundle, "inputs/scenario.json"), "a") as file:
            file.write("\n")
        finish(store, run, outcome, seconds)

    monkeypatch.setattr(Store, "finish", change_and_finish)
    assert main(["sweep", project.experiment(vary={"seed": [1, 2]}), "--out", str(project.folder / "out"), "--jobs", "1"]) == 1
    assert "bundle' was changed during the runs, which may have different inputs: name another folder with --out" in capsys.readouterr().err
    assert not (project.folder / "out/runs.parquet").exists()


def test_resume_accepts_a_bundle_of_an_earlier_version(lamps: Project, tmp_path: Path) -> None:
    out = tmp_path / "out"
    shutil.copytree(lamps.folder / "out", out)
    (out / "bundle/fingerprint.txt").unlink()
    assert lamps.sweep("--resume", out=str(out), **EIGHT).returncode == 0


def test_a_rejected_resume_does_not_change_the_settings(lamps: Project, tmp_path: Path) -> None:
    out = tmp_path / "out"
    shutil.copytree(lamps.folder / "out", out)
    before = (out / "sweep.json").read_bytes()
    result = lamps.sweep("--resume", out=str(out), **{**EIGHT, "measure": ["glow"]})
    assert result.returncode == 1
    assert "the scene has no metric 'glow'" in result.stderr
    assert (out / "sweep.json").read_bytes() == before


def test_modules_in_the_current_folder_are_not_executed(tmp_path: Path) -> None:
    for name in ("argparse", "collections", "json", "pandas", "sitecustomize"):
        (tmp_path / f"{name}.py").write_text("open('executed', 'w')\n")
    result = subprocess.run([COLLEKTIVE, "plot", "."], cwd=tmp_path, capture_output=True, text=True)
    assert "is not a sweep folder" in result.stderr
    assert not (tmp_path / "executed").exists()


def test_a_sweep_without_a_complete_run_has_no_figures(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    change_scene(project, 'throw new System.InvalidOperationException("no luck");')
    assert project.sweep(vary={"seed": [1]}).returncode == 1
    assert main(["plot", str(project.folder / "out")]) == 1
    assert "has no complete runs to plot" in capsys.readouterr().err


def test_tables_without_columns_are_a_one_line_error(lamps: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "out"
    out.mkdir()
    for name, column in (("runs", "status"), ("series", "second")):
        for path in [lamps.folder / "out/sweep.json", *(lamps.folder / "out").glob("*.parquet")]:
            shutil.copy(path, out)
        lamps.table(name=name).drop(columns=column).to_parquet(out / f"{name}.parquet")
        assert main(["plot", str(out)]) == 1
        assert "are damaged or from an earlier version: write them again" in capsys.readouterr().err


def test_a_table_with_a_run_twice_is_a_one_line_error(lamps: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in [lamps.folder / "out/sweep.json", *(lamps.folder / "out").glob("*.parquet")]:
        shutil.copy(path, tmp_path)
    runs = lamps.table(name="runs")
    pd.concat([runs, runs[:1]], ignore_index=True).to_parquet(tmp_path / "runs.parquet")
    assert main(["plot", str(tmp_path)]) == 1
    assert "are damaged or from an earlier version: write them again" in capsys.readouterr().err


@pytest.mark.parametrize("edited", [{"keys": []}, {"keys": [1]}, {"keys": None}, {"measure": ["lit"]}, {"labels": {"lit": 1}}], ids=json.dumps)
def test_edited_settings_are_a_one_line_error(lamps: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str], edited: dict[str, object]) -> None:
    for path in (lamps.folder / "out").glob("*.parquet"):
        shutil.copy(path, tmp_path)
    settings = json.loads((lamps.folder / "out/sweep.json").read_text())
    (tmp_path / "sweep.json").write_text(json.dumps({**settings, **edited}))
    assert main(["plot", str(tmp_path)]) == 1
    assert "damaged or" in capsys.readouterr().err


@pytest.mark.parametrize("edited", [{"status": 1}, {"message": None}, {"files": {"metrics.csv": ""}}, {"files": []}], ids=json.dumps)
def test_an_edited_record_is_damaged(tmp_path: Path, edited: dict[str, object]) -> None:
    folder = tmp_path / "runs/seed=1"
    folder.mkdir(parents=True)
    record = {"name": "seed=1", "status": "complete", "message": "", "files": {"manifest.json": "", "metrics.csv": ""}}
    for change, is_valid in (({}, True), (edited, False)):
        (folder / "run.json").write_text(json.dumps({**record, **change}))
        assert (Store(str(tmp_path)).record(Run("seed=1", {}, {})) is not None) == is_valid


@pytest.mark.parametrize("name", ["run.json", "metrics.csv"])
def test_an_error_of_the_disk_is_not_damage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    store, run = Store(str(tmp_path)), Run("seed=1", {}, {})
    folder = tmp_path / "runs/seed=1"
    folder.mkdir(parents=True)
    for each in ("manifest.json", "metrics.csv", files.MARKER):
        (folder / each).touch()
    hashes = {each: hashlib.sha256().hexdigest() for each in ("manifest.json", "metrics.csv")}
    (folder / "run.json").write_text(json.dumps({"name": "seed=1", "status": "complete", "message": "", "files": hashes}))
    assert store.is_complete(run)
    stat = os.stat

    def fail(path: str, **options: bool) -> os.stat_result:
        if os.path.basename(path) == name:
            raise OSError(errno.EIO, os.strerror(errno.EIO), path)
        return stat(path, **options)

    with monkeypatch.context() as patch:
        patch.setattr(os, "stat", fail)
        with pytest.raises(OSError, match="Input/output error"):
            store.is_complete(run)
    assert store.is_complete(run)


def test_ctrl_c_during_imports_is_a_one_line_error(tmp_path: Path) -> None:
    process = subprocess.Popen([COLLEKTIVE, "plot", str(tmp_path)], stderr=subprocess.PIPE, text=True, start_new_session=True)
    while not processes("collektive_experiments", str(tmp_path)) and process.poll() is None:
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert errors.count("\n") == 1 and "interrupted" in errors


def test_a_folder_that_is_not_a_sweep_is_a_one_line_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(tmp_path)]) == 1
    assert "is not a sweep folder" in capsys.readouterr().err


def test_pipes_instead_of_results_are_damaged_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "runs/seed=1"
    folder.mkdir(parents=True)
    (folder / ".collektive-sweep").touch()
    for name in ("run.json", "metrics.csv"):
        (folder / "run.json").unlink(missing_ok=True)
        (folder / "run.json").write_text('{"name": "seed=1", "status": "complete", "message": "", "files": {"metrics.csv": "00", "manifest.json": ""}}')
        (folder / name).unlink(missing_ok=True)
        os.mkfifo(folder / name)
        # Reading a pipe would wait for its writer.
        assert not Store(str(tmp_path)).is_complete(Run("seed=1", {}, {}))
        assert f"{name}' is damaged" in capsys.readouterr().err
        folder.mkdir()
        (folder / ".collektive-sweep").touch()
    os.mkfifo(tmp_path / "sweep.json")
    assert main(["plot", str(tmp_path)]) == 1
    assert "is damaged" in capsys.readouterr().err


def test_a_folder_is_on_the_disk_before_it_has_its_final_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    part = tmp_path / "run.part"
    files.make_marked(str(part))
    (part / "logs").mkdir()
    (part / "logs/check.txt").touch()
    files.write_part(str(part / files.RECORD), "{}")
    expected = {str(path) for path in (part, *part.rglob("*"))}
    events: list[str] = []
    rename = os.rename

    def replace(old: str, new: str) -> None:
        events.append("renamed")
        rename(old, new)

    monkeypatch.setattr(os, "fsync", lambda descriptor: events.append(os.readlink(f"/proc/self/fd/{descriptor}")))
    monkeypatch.setattr(os, "replace", replace)
    files.publish(str(tmp_path / "run"))
    assert set(events[:-2]) == expected
    assert events[-2:] == ["renamed", str(tmp_path)]


def test_an_interrupted_deletion_leaves_no_record(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "run"
    files.make_marked(str(folder))
    for name in ("metrics.csv", files.RECORD, "nodes.csv"):
        (folder / name).touch()
    delete, left = os.unlink, iter([True])

    def once(path: str) -> None:
        if next(left, None) is None:
            raise OSError("no more")
        delete(path)

    monkeypatch.setattr(os, "unlink", once)
    with pytest.raises(OSError, match="no more"):
        files.remove(str(folder))
    assert {path.name for path in folder.iterdir()} == {"metrics.csv", "nodes.csv", files.MARKER}
