"""Tests the dependency rules between modules, and that the docs match the code."""
import os
import re
import unittest

from build.places import ROOT


def declaration_pattern(path: str, test: str) -> str:
    """Returns a pattern that matches the declaration of a test in a file. On a page, a test is a manual check with a number."""
    name = re.escape(test)
    return {
        ".cs": rf"\[(?:Test|TestCase|UnityTest)\b[^;{{]*\s{name}\(",
        ".kt": rf"@Test\s+fun `?{name}`?\(",
        ".md": rf"(?m)^\d+\. \*\*{name}\.\*\*",
        ".py": rf"(?m)^ *def {name}\(",
    }[os.path.splitext(path)[1]]


class ArchitectureTest(unittest.TestCase):
    def test_the_core_does_not_mention_case_studies(self) -> None:
        core = ["schema", "native-shim", "unity/Runtime", "unity/Headless~/UnityEngine", "unity/Headless~/Player"]
        core += [os.path.join("jvm-host", module) for module in os.listdir(os.path.join(ROOT, "jvm-host")) if module not in ("programs", "bench")]
        words = re.compile(r"gradient.?ascent|leader.?lamp|walker", re.I)
        for folder in core:
            for where, folders, names in os.walk(os.path.join(ROOT, folder)):
                folders[:] = [name for name in folders if name not in ("target", "build", "test")]
                for name in names:
                    path = os.path.join(where, name)
                    with open(path, errors="replace") as file:
                        match = words.search(file.read())
                    self.assertIsNone(match, f"{path}: {match and match.group(0)}")

    def test_shim_and_neighbour_search_are_independent(self) -> None:
        def headers(folder: str) -> set[str]:
            found: set[str] = set()
            for name in os.listdir(os.path.join(ROOT, "native-shim", folder)):
                with open(os.path.join(ROOT, "native-shim", folder, name)) as file:
                    found |= set(re.findall(r'#include "(.*)"', file.read()))
            return found

        own = {name for name in os.listdir(os.path.join(ROOT, "native-shim/neighbours")) if name.endswith(".h")} | {"collektive_neighbours.h"}
        self.assertEqual(headers("neighbours"), own)
        self.assertFalse(headers("src") & own)

    def test_links_of_pages_are_not_broken(self) -> None:
        folder = os.path.join(ROOT, "Documentation~")
        for name in sorted(os.listdir(folder)):
            if not name.endswith(".md"):
                continue
            with open(os.path.join(folder, name)) as file:
                for link in re.findall(r"\]\((?!https:)([^)#]+)", file.read()):
                    self.assertTrue(os.path.exists(os.path.join(folder, link)), f"{name}: {link}")

    def test_each_setting_of_the_jvm_is_documented(self) -> None:
        with open(os.path.join(ROOT, "unity/Runtime/Bridge/Jvm/JvmSetting.cs")) as file:
            keys = re.findall(r"new JvmSetting\(\s*nameof\(JvmSettings\.(\w+)\)", file.read())
        self.assertGreater(len(keys), 10)
        with open(os.path.join(ROOT, "Documentation~/jvm-and-jfr.md")) as file:
            page = file.read()
        for key in keys:
            self.assertIn(f"`{key}`", page)

    def test_each_key_of_a_scenario_is_documented(self) -> None:
        with open(os.path.join(ROOT, "unity/Headless~/Player/Scenario.cs")) as file:
            player = file.read()
        with open(os.path.join(ROOT, "unity/Runtime/Unity/Manager/SimulationSettings.cs")) as file:
            settings = re.findall(r"(?m)^        public [\w<>]+ (\w+)(?: = .*)?;", file.read())
        shared = player[player.index("Shared ="):player.index("private readonly JObject root")]
        keys = set(settings) - set(re.findall(r"nameof\(SimulationSettings\.(\w+)\)", shared))
        keys |= set(re.findall(r'"(\w+)"', player[player.index("OwnKeys ="):player.index("};")]))
        outputs = re.findall(r'"(\w+)"', player[player.index('"outputs", new[]'):].split("}")[0])
        self.assertGreater(len(keys), 18)
        with open(os.path.join(ROOT, "Documentation~/headless.md")) as file:
            page = file.read()
        for key in [*keys, *(f"outputs.{name}" for name in outputs[1:])]:
            self.assertRegex(page, rf"`{re.escape(key)}[`.]", key)

    def test_troubleshooting_quotes_existing_messages(self) -> None:
        sources = ""
        modules = [os.path.join("jvm-host", module, "src/main") for module in os.listdir(os.path.join(ROOT, "jvm-host"))]
        for folder in ["unity/Runtime", "unity/Editor", "native-shim/src", *modules]:
            for where, _, names in os.walk(os.path.join(ROOT, folder)):
                for name in names:
                    if name.endswith((".cs", ".c", ".h", ".kt")):
                        with open(os.path.join(where, name)) as file:
                            sources += file.read()
        # A message may consist of several literals, which are joined here.
        sources = re.sub(r'"\s*\+?\s*"', "", sources)
        with open(os.path.join(ROOT, "Documentation~/troubleshooting.md")) as file:
            messages = re.findall(r"^\| `([^`]+)`", file.read(), re.M)
        self.assertGreater(len(messages), 20)
        for message in messages:
            self.assertTrue(message in sources, f"no source has the message '{message}'")

    def test_each_requirement_is_mapped_to_tests_that_exist(self) -> None:
        with open(os.path.join(ROOT, "docs/requirements.md")) as file:
            text = file.read()
        numbers = {"B": 6, "D": 10, "C": 4, "U": 7, "S": 2, "Q": 2}
        for letter, count in numbers.items():
            for number in range(1, count + 1):
                self.assertRegex(text, rf"(?m)^\| {letter}{number} \|", f"{letter}{number} has no row")
        for path, test in re.findall(r"`([^`:]+):([^`]+)`", text):
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)), path)
            with open(os.path.join(ROOT, path)) as file:
                self.assertRegex(file.read(), declaration_pattern(path, test), f"{path} has no {test}")
