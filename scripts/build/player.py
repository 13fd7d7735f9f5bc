"""The player: what a scenario needs, as the player itself reads the file, and how it is run."""
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from build import managed, processes, projects
from build.console import Failure
from build.places import HOST_JAR, PLAYER


@dataclass(frozen=True)
class Plan:
    """What a scenario needs: the player's reading of its file."""

    values: dict[str, str]

    def __getitem__(self, key: str) -> str:
        return self.values.get(key, "")

    def path(self, key: str) -> Path | None:
        """Returns the path of a key, or None without a value."""
        return Path(self[key]) if self[key] else None

    def programs_jar(self) -> Path:
        """Returns the jar of the scenario's programs, compiled if they changed."""
        return projects.programs_jar(Path(self["schema"]), Path(self["programs"]), self.path("runtime_jars"), self.path("runtime_plugin"))

    def scripts_dll(self) -> Path:
        """Returns the assembly of the scenario's C#, compiled if it changed."""
        return projects.scripts_dll(Path(self["schema"]), Path(self["scripts"]))


def plan(scenario: str, reading: Sequence[str]) -> Plan:
    """Lets the player read a scenario; its messages go to the user.

    Raises `Failure` without a message if the scenario is refused.
    """
    command = managed.command("mono-sgen", PLAYER, "plan", scenario, *reading)
    result = subprocess.run(command, env=managed.environment("mono-sgen"), stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        raise Refused(result.returncode)
    return Plan(dict(line.split("=", 1) for line in result.stdout.splitlines() if "=" in line))


class Refused(Failure):
    """A program has printed why it refuses something."""

    def __init__(self, code: int) -> None:
        super().__init__("", code)


def run(scenario: str, jar: Path, dll: Path, java_home: Path, words: Sequence[str | Path]) -> int:
    """Runs a scenario and returns the player's exit code. Processes that its scripts have started end with it."""
    command = managed.command("mono-sgen", PLAYER, "run", scenario, "--scripts", dll, "--jar", jar, "--host-jar", HOST_JAR,
                              "--java-home", java_home, *words)
    code = processes.call(command, env=managed.environment("mono-sgen"))
    processes.end_orphans()
    return code
