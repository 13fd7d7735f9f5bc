"""Runs scenarios with the player."""
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from build import inputs, managed, processes, projects
from build.console import Failure
from build.inputs import Part
from build.places import HOST_JAR, PLAYER

# The function that reads each part of a project, by the part's key in a scenario.
READERS = {"scripts": inputs.scripts, "schema": inputs.schema, "programs": inputs.programs, "data": inputs.data, "runtimeJars": inputs.jars,
           "runtimePlugin": inputs.jar}

# A number in Java, as in LiveRun.cs.
NUMBER = re.compile(r"\s*[+-]?(NaN|Infinity|((\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|0[xX]([\da-fA-F]+\.?[\da-fA-F]*|\.[\da-fA-F]+)[pP][+-]?\d+)[fFdD]?)\s*",
                    re.ASCII)


@dataclass(frozen=True)
class Plan:
    """The values that the player has read from a scenario, and the current files of the project."""

    values: dict[str, Any]
    parts: dict[str, Part]
    scenario: Path = Path()
    content: bytes = b""

    def __getitem__(self, key: str) -> Any:
        return self.values[key]

    def programs_jar(self) -> Path:
        """Compiles the scenario's programs if they have changed, and returns their jar.

        Raises `Failure` if they do not contain the scenario's program, or a program or parameter in its `parameters`, or if the value of a parameter is
        invalid.
        """
        known = projects.program_names(self.parts["programs"])
        if known and self["program"] not in known:
            raise Failure(f"unknown program '{self['program']}'; '{self['programs']}' contains {', '.join(sorted(known))}")
        jar = projects.programs_jar(self.parts["schema"], self.parts["programs"], self.parts.get("runtimeJars"), self.parts.get("runtimePlugin"))
        # A manifest contains the scenario of its run.
        if parameters := self["file"].get("scenario", self["file"]).get("parameters"):
            check_parameters(parameters, projects.parameters(jar))
        return jar

    def require_unchanged(self) -> None:
        """Raises `Failure` if the scenario or a file of the project was changed, added or removed since this plan was made."""
        if self.scenario.read_bytes() != self.content:
            raise Failure(f"'{self.scenario}' changed during compilation: run the command again")
        for part in self.parts.values():
            part.require_unchanged()

    def report_changes(self) -> None:
        """Prints a warning for each part that the run itself reads and that changed during the run."""
        for key in ("data", "runtimeJars", "programs"):
            part = self.parts.get(key)
            # Only the compiler reads a folder of programs.
            if part is None or (key == "programs" and part.path.is_dir()):
                continue
            try:
                is_changed = part.is_changed()
            except (OSError, Failure):
                is_changed = True
            if is_changed:
                print(f"collektive: warning: '{part.path}' changed during the run. The manifest contains its hash from before the run, but the run may have "
                      "read the new files", file=sys.stderr)

    def scripts_dll(self) -> Path:
        """Compiles the scenario's C# if it has changed, and returns the assembly."""
        return projects.scripts_dll(self.parts["schema"], self.parts["scripts"])

    def hashes(self) -> dict[str, str]:
        """Returns the hashes of the parts, which manifests contain."""
        return {key: part.digest for key, part in self.parts.items()}


def check_parameters(parameters: dict[str, Any], known: dict[str, dict[str, list[str]]]) -> None:
    """Raises `Failure` if a parameter is unknown or its value is invalid. `known` is from `projects.parameters`, and may be empty."""
    for program, values in parameters.items() if known else ():
        if program not in known:
            raise Failure(f"'parameters.{program}': unknown program; the programs are: {', '.join(sorted(known))}")
        for name, value in values.items():
            if name not in known[program]:
                raise Failure(f"'parameters.{program}.{name}': unknown parameter; the program declares: {', '.join(sorted(known[program])) or 'none'}")
            default, _, *constants = known[program][name]
            text = value if isinstance(value, str) else json.dumps(value)
            if constants and text not in constants:
                raise Failure(f"'parameters.{program}.{name}' is '{text}'; it must be one of {', '.join(constants)}")
            if NUMBER.fullmatch(default) and not NUMBER.fullmatch(text):
                raise Failure(f"'parameters.{program}.{name}' is '{text}'; it must be a number like its default {default}")


def plan(scenario: str, options: Sequence[str]) -> Plan:
    """Reads a scenario with the player.

    Raises `InvalidScenario` without a message if the scenario is invalid, because the player has printed the error.
    """
    path = Path(scenario)
    # The content is read before the player reads it, so that each later change is detected. The player reports unreadable files.
    content = path.read_bytes() if path.is_file() and os.access(path, os.R_OK) else b""
    command = managed.command("mono-sgen", PLAYER, "plan", scenario, *options)
    result = subprocess.run(command, env=managed.environment("mono-sgen"), stdout=subprocess.PIPE)
    if result.returncode < 0:
        raise Failure(f"the player was ended by {signal.Signals(-result.returncode).name}", 128 - result.returncode)
    if result.returncode != 0:
        raise InvalidScenario(1)
    values = json.loads(result.stdout)
    parts = {key: read(Path(values[key])) for key, read in READERS.items() if values.get(key)}
    return Plan(values, parts, path, content)


class InvalidScenario(Failure):
    """A scenario is invalid, and the player has printed the error."""

    def __init__(self, code: int) -> None:
        super().__init__("", code)


def run(scenario: str, plan: Plan, jar: Path, dll: Path, java_home: Path, words: Sequence[str | Path]) -> int:
    """Runs a scenario and returns the player's exit code. Kills processes that its scripts have left running."""
    code = processes.call(command("run", scenario, plan, jar, dll, java_home, words), env=managed.environment("mono-sgen"))
    processes.end_orphans()
    return code


def command(name: str, scenario: str, plan: Plan, jar: Path, dll: Path, java_home: Path, words: Sequence[str | Path]) -> list[str | Path]:
    """Returns the player's command line for one of its commands that run a scenario."""
    return managed.command("mono-sgen", PLAYER, name, scenario, "--scripts", dll, "--jar", jar, "--host-jar", HOST_JAR,
                           "--java-home", java_home, "--inputs", json.dumps(plan.hashes()), *words)
