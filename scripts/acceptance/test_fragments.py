"""Code of the pages that is no file of a tutorial compiles, too: each piece in a place that gives it what the text around it speaks of."""
import glob
import itertools
import json
import os
import re
import shlex
import textwrap
import unittest

from command import Folder, collektive
from places import ROOT

SCHEMA = """
include "types.fbs";
namespace swarm;
table SensorData { intensity: float; source: bool; position: org.collektive.schema.Vector3; }
struct ActuatorData { target: org.collektive.schema.Vector3; hops: float; distance: float; leader: int; }
"""
USINGS = "using System;\nusing System.Collections.Generic;\nusing Collektive.Bridge;\nusing Collektive.Unity;\nusing swarm;\nusing UnityEngine;\n"
# What stands around members, and around statements.
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


# Of all pages, with and without titles: the tests below, those of the tutorials (test_stories.py) and of the README (test_readme.py) know what to do
# with them, and the site's draw the diagrams. `text` is what a program prints, or a drawing.
LANGUAGES = {"csharp", "kotlin", "fbs", "json", "java", "sh", "console", "python", "mermaid", "text"}
PAGES = ("Documentation~/*.md", "docs/*.md", "*.md", ".github/**/*.md")
# Commands of others in the blocks for shells.
OTHERS = {"cd", "cp", "export", "git", "mkdir", "python3", "xattr", "java", "for", "done"}


def fragments(language, pages="Documentation~/*.md"):
    """Code blocks without a title of the pages, and where they begin."""
    for path in sorted(glob.glob(os.path.join(ROOT, pages), recursive=True)):
        with open(path) as file:
            text = file.read()
        for found in re.finditer(rf"(?m)^( *)```{language}\n(.*?)^\1```$", text, re.S):
            place = f"{os.path.relpath(path, ROOT)}:{text.count(chr(10), 0, found.start()) + 1}"
            yield place, textwrap.dedent(found[2])


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


JAVA = {"long": "Long", "int": "Int", "boolean": "Boolean", "byte[]": "ByteArray", "ByteBuffer": "ByteBuffer", "String": "String"}


def collapsed(pattern):
    whole = ""
    for path in sorted(glob.glob(os.path.join(ROOT, pattern), recursive=True)):
        with open(path) as file:
            whole += file.read() + "\n"
    return " ".join(re.sub(r"//.*", "", whole).split())


def blocks_of_boundary(language):
    return "\n".join(re.sub(r"//.*", "", code) for _, code in fragments(language, "docs/boundary.md"))


class Fragments(Folder):
    def written(self, kind, made):
        """A folder with the fragments, one a file."""
        os.makedirs(self.path(kind))
        for number, (place, code) in enumerate(fragments(kind)):
            # Tests of programs are quoted from the tests of the module testing.
            if "@Test" not in code:
                with open(self.path(kind, f"Fragment{number}.{'cs' if kind == 'csharp' else 'kt'}"), "w") as file:
                    file.write(made(number, place, code))
        with open(self.path("swarm.fbs"), "w") as file:
            file.write(SCHEMA)
        return self.path(kind)

    def test_csharp_compiles(self):
        result = collektive("step", "scripts_dll", self.path("swarm.fbs"), self.written("csharp", csharp))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_kotlin_compiles(self):
        result = collektive("step", "programs_jar", self.path("swarm.fbs"), self.written("kotlin", kotlin))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_json_is_json(self):
        for place, code in fragments("json"):
            with self.subTest(place):
                json.loads(code if code.startswith("{") else f"{{{code}}}")


    def test_python_is_python(self):
        for place, code in fragments("python"):
            compile(code, place, "exec")


class Commands(unittest.TestCase):
    """What the blocks for shells say exists: the commands, their options, and the options of players."""

    def test_commands_have_these_options(self):
        helps, count = {}, 0
        for place, words in commands():
            while words and (words[0] in ("sudo", "do") or re.match(r"[A-Z_]+=", words[0])):
                words.pop(0)
            if not words:
                continue
            with self.subTest(place, words=words):
                if words[0].endswith(".x86_64"):
                    self.assertEqual({word for word in words if word.startswith("-collektive-")} - players_options(), set())
                    continue
                if words[0].rpartition("/")[2] != "collektive":
                    self.assertIn(words[0], OTHERS)
                    continue
                command = words[1]
                if command == "--help":
                    continue
                if command not in helps:
                    helps[command] = collektive(command, "--help").stdout
                for option in (word.partition("=")[0] for word in words[2:] if word.startswith("--")):
                    self.assertRegex(helps[command], rf"{option}\b")
                count += 1
        self.assertGreater(count, 20)


def commands():
    for pages in PAGES:
        for language in ("sh", "console"):
            for place, code in fragments(language + "[^\n]*", pages):
                for line in code.replace("\\\n", " ").splitlines():
                    lexer = shlex.shlex(line.removeprefix("$ "), posix=True, punctuation_chars=True)
                    lexer.whitespace_split = True
                    for joined, words in itertools.groupby(lexer, lambda word: word in ("&&", "||", ";", "|", "&")):
                        if not joined:
                            yield place, list(words)


def players_options():
    with open(os.path.join(ROOT, "unity/Runtime/Unity/Manager/SimulationSettings.cs")) as file:
        return {"-collektive-" + name for name in re.findall(r"(?m)^        public \w+ (\w+)(?: =[^>].*)?;$", file.read())}


class Quotations(unittest.TestCase):
    def test_each_language_of_a_block_has_a_test(self):
        for pages in PAGES:
            for path in glob.glob(os.path.join(ROOT, pages), recursive=True):
                with open(path) as file:
                    for opened in re.findall(r"(?ms)^ *```([^\n]*)\n.*?^ *```\s*?$", file.read()):
                        self.assertIn(opened.partition(" ")[0], LANGUAGES, path)

    def test_the_boundaries_are_those_of_the_code(self):
        """The declarations that docs/boundary.md quotes, of C# as they are, of the host's Kotlin in the words of Java."""
        code = collapsed("unity/Runtime/Bridge/Schema/*.cs")
        declared = [line.partition("{")[0].strip() for line in blocks_of_boundary("csharp").splitlines() if "abstract" in line or "virtual" in line]
        self.assertGreater(len(declared), 15)
        self.assertEqual([line for line in declared if line not in code], [])
        kotlin = collapsed("jvm-host/host/src/main/kotlin/**/*.kt")
        methods = re.findall(r"static (?:native )?(\S+) (\w+)\s*\(([^)]*)\)", blocks_of_boundary("java"))
        self.assertGreater(len(methods), 7)
        for _, name, parameters in methods:
            inner = ", ".join(f"{parameter.split()[1]}: {JAVA[parameter.split()[0]]}" for parameter in parameters.split(", ") if parameter)
            self.assertTrue(re.search(rf"fun {name}\( ?{re.escape(inner)},? ?\)", kotlin), f"{name}({inner})")

    def test_tests_of_programs_are_quoted_from_tests_that_run(self):
        sources = ""
        for path in glob.glob(os.path.join(ROOT, "jvm-host/testing/src/test/kotlin/**/*.kt"), recursive=True):
            with open(path) as file:
                sources += file.read()
        quoted = [code for _, code in fragments("kotlin") if "@Test" in code]
        self.assertEqual(len(quoted), 1)
        for code in quoted:
            self.assertIn(" ".join(code.split()), " ".join(sources.split()))
