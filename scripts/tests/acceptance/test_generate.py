"""Code of schemas."""
import glob
import os
import subprocess
import sys

import pytest
from command import SAMPLE, Folder, collektive

from build.places import BUILD, FLATC, ROOT


class Generated(Folder):
    @pytest.mark.quick
    def test_the_command_generates_the_same_code_as_the_build(self) -> None:
        for schema in glob.glob(os.path.join(os.path.dirname(SAMPLE), "*/*.fbs")):
            generated = self.path(os.path.basename(schema))
            self.assertEqual(collektive("generate", schema, "--csharp", generated).returncode, 0)
            self.same(generated, os.path.join(BUILD, "generated/samples", os.path.basename(os.path.dirname(schema))))
        schemas = [os.path.join(ROOT, "schema", name) for name in ["frame.fbs", "types.fbs"]]
        subprocess.run([FLATC, "--csharp", "-o", self.path("core"), *schemas], check=True)
        subprocess.run([sys.executable, os.path.join(ROOT, "scripts/build/rename_flatbuffers.py"), self.path("core")], check=True)
        self.same(self.path("core"), os.path.join(BUILD, "generated/bridge"))

    def same(self, generated, built) -> None:
        self.assertEqual(self.files(generated), self.files(built))

    @staticmethod
    def files(folder):
        found = {}
        for where, _, names in os.walk(folder):
            for name in names:
                path = os.path.join(where, name)
                with open(path) as file:
                    found[os.path.relpath(path, folder)] = file.read()
        return found

    def test_unusable_schemas_are_rejected(self) -> None:
        bad = {
            "namespace": ("table SensorData { a: int; } table ActuatorData { a: int; }", "namespace"),
            "sensor": ("namespace a; table Sensors { a: int; } table ActuatorData { a: int; }", "SensorData"),
            "union": ("namespace a; table X { a: int; } union U { X } table SensorData { u: U; } table ActuatorData { a: int; }", "union"),
        }
        for name, (text, word) in bad.items():
            with open(self.path(name + ".fbs"), "w") as file:
                file.write(text)
            result = collektive("generate", self.path(name + ".fbs"))
            self.assertEqual(result.returncode, 1, name)
            self.assertIn(word, result.stderr, name)
