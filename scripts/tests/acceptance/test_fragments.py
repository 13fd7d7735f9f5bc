"""Tests that the code fragments in pages compile. Each is compiled with the declarations that it needs."""
import glob
import json
import os
import re
import unittest
from pathlib import Path

import pytest
from blocks import of_kind
from command import Folder, compiled

from build import inputs, projects
from build.places import ROOT

USINGS = "using System;\nusing System.Collections.Generic;\nusing Collektive.Bridge;\nusing Collektive.Unity;\nusing swarm;\nusing UnityEngine;\n"
# Templates for the code around members and statements.
CLASS = "public sealed class Users : MonoBehaviour\n{\n    private Node node;\n\n%s\n}"
SCENE = "public sealed class Users : SceneBuilder\n{\n    protected override void Build(SimulationManager manager)\n    {\n    }\n\n%s\n}"
METHOD = CLASS % ("    private void Show(ActuatorData data, ulong ageInTicks) { }\n\n"
                  "    public void Use(SimulationManager manager)\n    {\n        node = null;\n%s\n    }")
IMPORTS = """
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
import org.collektive.links.distances
import org.collektive.schema.Vector3Value
import swarm.ActuatorData
import swarm.SensorData
"""


def fragments(language):
    """Yields the place and the code of each code block in a language, except files of tutorials."""
    return [(block.place, block.text) for block in of_kind("fragment") if block.language == language]


def csharp(number, place, code):
    usings = "".join(line + "\n" for line in re.findall(r"(?m)^using [\w.]+;$", code) if line not in USINGS)
    code = re.sub(r"(?m)^using [\w.]+;\n", "", code)
    if not re.search(r"\bclass\b", code):
        context = SCENE if "public override" in code else CLASS if re.match(r"(?:private|public|protected)\b", code) else METHOD
        code = context % code
    return f"// {place}\n{USINGS}{usings}\nnamespace Fragment{number}\n{{\n{code}\n}}\n"


def kotlin(number, place, code):
    code = re.sub(r"(?m)^(?:package|import) .*\n", lambda line: line[0] if line[0].startswith("import") and line[0] not in IMPORTS else "", code)
    own = "".join(re.findall(r"(?m)^import .*\n", code))
    code = re.sub(r"(?m)^import .*\n", "", code)
    return f"// {place}\npackage fragment{number}\n{IMPORTS}{own}\n" + (code if "fun " in code else "val fragment = " + code)


class Fragments(Folder):
    def test_a_page_has_the_schema_of_the_fragments(self) -> None:
        self.assertEqual(len(fragments("fbs")), 1)

    def write_fragments(self, kind, wrap):
        """Writes each fragment to its own file, and returns the folder of the files."""
        os.makedirs(self.path(kind))
        for number, (place, code) in enumerate(fragments(kind)):
            # Tests of programs are skipped, because the pages quote them from the tests of the module testing.
            if "@Test" not in code:
                with open(self.path(kind, f"Fragment{number}.{'cs' if kind == 'csharp' else 'kt'}"), "w") as file:
                    file.write(wrap(number, place, code))
        with open(self.path("swarm.fbs"), "w") as file:
            file.write(fragments("fbs")[0][1])
        return self.path(kind)

    def test_csharp_compiles(self) -> None:
        folder = Path(self.write_fragments("csharp", csharp))
        compiled(projects.scripts_dll, inputs.schema(Path(self.path("swarm.fbs"))), inputs.scripts(folder))

    @pytest.mark.slow
    def test_kotlin_compiles(self) -> None:
        folder = Path(self.write_fragments("kotlin", kotlin))
        compiled(projects.programs_jar, inputs.schema(Path(self.path("swarm.fbs"))), inputs.programs(folder))

    def test_json_is_valid(self) -> None:
        for place, code in fragments("json"):
            with self.subTest(place):
                json.loads(code if code.startswith("{") else f"{{{code}}}")


class Quotations(unittest.TestCase):
    def test_quoted_program_tests_exist_in_the_test_sources(self) -> None:
        sources = ""
        for path in glob.glob(os.path.join(ROOT, "jvm-host/testing/src/test/kotlin/**/*.kt"), recursive=True):
            with open(path) as file:
                sources += file.read()
        quoted = [code for _, code in fragments("kotlin") if "@Test" in code]
        self.assertEqual(len(quoted), 1)
        for code in quoted:
            self.assertIn(" ".join(code.split()), " ".join(sources.split()))
