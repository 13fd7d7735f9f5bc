"""Replays the record of the case study on the JVM of each platform that can run on this machine."""
import json
import os
import subprocess
import tempfile
from collections.abc import Iterator

import pytest

from build.places import BUILD, COLLEKTIVE, ROOT

TOOLS = os.path.join(ROOT, "jvm-host/tools/target/collektive-tools.jar")
HOST = os.path.join(ROOT, "jvm-host/host/target/collektive-host.jar")
# The command that runs java, for each platform.
JAVA = json.loads(os.environ["COLLEKTIVE_JAVA_COMMANDS"])


@pytest.fixture(scope="module")
def record() -> Iterator[str]:
    sample = os.path.join(ROOT, "unity/Samples~/GradientAscent")
    with open(os.path.join(sample, "scenario.json")) as file:
        scenario = json.load(file)
    scenario |= {"scripts": sample, "schema": os.path.join(sample, scenario["schema"]), "outputs": {"record": True}, "seconds": 5}
    scenario["programs"] = os.path.normpath(os.path.join(sample, scenario["programs"]))
    scenario["fields"] = {**scenario.get("fields", {}), "nodes": 60}
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scenario.json"), "w") as file:
            json.dump(scenario, file)
        subprocess.run([COLLEKTIVE, "run", os.path.join(folder, "scenario.json"), "--out", os.path.join(folder, "out")], check=True)
        yield os.path.join(folder, "out/run.clkrec")


@pytest.mark.parametrize("platform", JAVA)
def test_replays_on_the_platform_have_the_recorded_digests(platform: str, record: str) -> None:
    separator = ";" if platform.startswith("win") else ":"
    command = [*JAVA[platform], "-cp", TOOLS + separator + HOST, "org.collektive.tools.record.RecordsKt", "replay", record, "--trust"]
    environment = {**os.environ, "WINEPREFIX": os.path.join(BUILD, "wine"), "WINEDEBUG": "-all"}
    result = subprocess.run(command, capture_output=True, text=True, env=environment)
    print(result.stdout, result.stderr)
    assert result.returncode == 0
    assert "all digests equal the record" in result.stdout
