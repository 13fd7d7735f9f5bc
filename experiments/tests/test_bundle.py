"""Tests which files of a project a sweep copies."""
import fcntl
import json
import os
from pathlib import Path
from unittest.mock import Mock

import pytest
from conftest import Project

from collektive_experiments import read
from collektive_experiments.bundle import prepare
from collektive_experiments.positions import ExperimentError
from collektive_experiments.store import Store


def test_an_include_outside_the_project_is_rejected(project: Project) -> None:
    schema = project.folder / "project/light.fbs"
    outside = project.folder / "outside.fbs"
    outside.write_text("// kept\n")
    schema.write_text('include "../outside.fbs";\n' + schema.read_text())
    result = project.sweep(vary={"seed": [1]})
    assert result.returncode == 1
    assert f"the included file '../outside.fbs' is not in the folder '{schema.parent}', which a sweep copies: move it there" in result.stderr
    assert outside.read_text() == "// kept\n"
    assert not list((project.folder / "out").rglob("outside.fbs"))


def test_results_inside_an_input_are_refused(project: Project) -> None:
    result = project.sweep(out="project/programs/out", vary={"seed": [1]})
    assert result.returncode == 1
    assert f"the results would be inside '{project.folder}/project/programs', the scenario's 'programs'" in result.stderr
    assert not (project.folder / "project/programs/out").exists()


@pytest.mark.slow
def test_runs_use_copies_of_linked_and_included_files(project: Project) -> None:
    folder = project.folder / "project"
    (folder / "light.fbs").rename(project.folder / "light.fbs")
    (folder / "common").mkdir()
    (folder / "common/linked.fbs").symlink_to(project.folder / "light.fbs")
    (folder / "light.fbs").write_text('include "common/linked.fbs";\n')
    (folder / "programs").rename(project.folder / "target")
    (folder / "programs").symlink_to(project.folder / "target")
    result = project.sweep(vary={"seed": [1]})
    assert result.returncode == 0, result.stderr
    bundle = project.folder / "out/bundle"
    copies = sorted(str(file.relative_to(bundle / "inputs")) for file in (bundle / "inputs").rglob("*") if file.is_file())
    assert copies == ["programs/Brightest.kt", "scenario.json", "schema/common/linked.fbs", "schema/light.fbs", "scripts/Lamps.cs"]
    assert not any(file.is_symlink() for file in bundle.rglob("*"))
    manifest = json.loads(next((project.folder / "out/runs").glob("*/manifest.json")).read_text())
    assert manifest["inputs"] == json.loads((bundle / "inputs.json").read_text())["hashes"]
    # Changing the target of a link also changes the project.
    (project.folder / "light.fbs").write_text((project.folder / "light.fbs").read_text() + "// changed\n")
    again = project.sweep("--resume", vary={"seed": [1]})
    assert again.returncode == 1
    assert "differ from those of the runs in" in again.stderr


def test_a_scenario_that_changes_before_it_is_copied_is_an_error(project: Project) -> None:
    experiment = read(project.experiment(vary={"network.loss": [0]}))
    scenario = project.folder / "project/lamps.json"
    scenario.write_text(scenario.read_text().replace("{", '{ "seed": 7,', 1))
    with pytest.raises(ExperimentError, match="changed while it was read: run the command again"):
        prepare(experiment.scenario, str(project.folder / "bundle"), False)


def test_a_runtime_cannot_be_added_to_a_bundle(tmp_path: Path) -> None:
    (tmp_path / "programs-collektive.jar").touch()
    with pytest.raises(ExperimentError, match="contains no programs for the runtime 'builtin': name another folder with --out"):
        prepare(Mock(), str(tmp_path), False, ["builtin", "collektive"])


def test_a_sweep_without_its_bundle_is_not_continued_with_other_inputs(project: Project) -> None:
    experiment = read(project.experiment(vary={"seed": "1-2"}))
    with Store(str(project.folder / "out")) as store:
        store.open(experiment, resume=False)
        os.mkdir(os.path.join(store.runs, "seed=1"))
    with Store(str(project.folder / "out")) as store, pytest.raises(ExperimentError, match="with the inputs of the earlier runs is missing"):
        store.open(experiment, resume=True)


def test_a_sweep_does_not_use_the_folder_of_a_run_that_has_written_no_files_yet(project: Project) -> None:
    out = project.folder / "out"
    out.mkdir()
    run = os.open(out, os.O_RDONLY)
    fcntl.flock(run, fcntl.LOCK_EX)
    with Store(str(out)) as store, pytest.raises(ExperimentError, match="a run writes to"):
        store.open(read(project.experiment()), resume=False)
    assert not any(out.iterdir())
    os.close(run)
