"""Finds the lessons and samples that `./collektive live` can run by name."""
import json
import re
import shutil
import tempfile
from pathlib import Path

from build import sample_programs
from build.console import Failure
from build.places import ROOT

FOLDER = ROOT / "scripts/lessons"
# The lessons in the order of the tutorial.
LESSONS = ("gradient", "channel", "leader", "collection", "gossip", "healing", "sparse", "flocking")
# The samples that the page offers.
SAMPLES = ("GradientAscent", "Swarm", "Rescue")
# Files that only Unity needs.
_UNITY_FILES = ("*.meta", "*.unity", "*.asmdef", "*.mat", "*.prefab")


def find(name: str) -> Path | None:
    """Returns the scenario of a sample or lesson, or None for an unknown name."""
    named = [folder / name / "scenario.json" for folder in (sample_programs.SAMPLES, FOLDER)]
    return next(filter(Path.is_file, named), None)


def is_example(scenario: Path) -> bool:
    return scenario.parent.parent in (sample_programs.SAMPLES, FOLDER)


def catalogue() -> list[dict[str, str]]:
    """Returns the name, title, text and question of each lesson and sample that the page offers. A sample has an empty question."""
    samples = {Path(sample["path"]).name: sample for sample in json.loads((ROOT / "package.json").read_text(encoding="utf-8"))["samples"]}
    return [*map(_lesson, LESSONS), *({"name": name, "title": samples[name]["displayName"], "text": samples[name]["description"], "question": ""}
                                      for name in SAMPLES)]


def _lesson(name: str) -> dict[str, str]:
    (program,) = (FOLDER / name / "programs").glob("*.kt")
    comment = re.sub(r"^// ?", "", program.read_text(encoding="utf-8").partition("\n\npackage ")[0], flags=re.M)
    text, _, question = comment.replace("`", "").partition("\n\nQuestion: ")
    return {"name": name, "title": name.capitalize(), "text": text.replace("\n", " "), "question": question.replace("\n", " ")}


def copy(scenario: Path) -> Path:
    """Copies a sample or lesson and its Kotlin to out/live/NAME, unless that folder exists. Returns the scenario of the copy."""
    folder = Path("out/live") / scenario.parent.name
    target = folder.absolute() / scenario.name
    if target.is_file():
        return target
    if folder.exists():
        raise Failure(f"'{folder}' exists and has no {scenario.name}: delete or rename the folder")
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".", dir=folder.parent) as work:
        part = Path(work, folder.name)
        shutil.copytree(scenario.parent, part, ignore=shutil.ignore_patterns(*_UNITY_FILES))
        if scenario.parent.parent != FOLDER:
            (schema,) = scenario.parent.glob("*.fbs")
            shutil.copytree(sample_programs.folder(schema), part / "programs")
            values = json.loads(scenario.read_text(encoding="utf-8"))
            values["programs"] = "programs"
            (part / scenario.name).write_text(json.dumps(values, indent=2) + "\n", encoding="utf-8")
        part.rename(folder)
    return target
