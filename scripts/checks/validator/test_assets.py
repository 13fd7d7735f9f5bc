"""Validates the package's assets, and tests that the validator finds each kind of error."""
import functools
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import validate

from build import local_ids, managed, metas
from build.places import CSHARP, ROOT
from validator import assets, guids, plugins, serialized_fields

PREFAB = "unity/Prefabs/Simulation Manager.prefab"
NODE = "unity/Prefabs/Node.prefab"
SCENE = "unity/Samples~/GradientAscent/GradientAscent.unity"
LIBRARY = "unity/Samples~/GradientAscent/gradient_ascent.clkprograms"
ASMDEF = "unity/Runtime/Unity/Collektive.Unity.asmdef"


@functools.cache
def classes() -> dict[str, serialized_fields.ScriptClass]:
    """Returns the serialised fields of each component."""
    command = managed.command("mono-sgen", CSHARP / "Collektive.SerializedFields.exe", CSHARP / "Collektive.Unity.dll", CSHARP / "Collektive.Samples.dll")
    output = subprocess.run(command, env=managed.environment("mono-sgen"), stdout=subprocess.PIPE, text=True, check=True).stdout
    return serialized_fields.parse(output)


class AssetsTest(unittest.TestCase):
    def test_tests_of_edit_mode_are_for_the_editor_only(self) -> None:
        for name in "unity/Tests/PublicApi/Collektive.Unity.PublicApi.Tests", "unity/Tests/Editor/Collektive.Unity.Editor.Tests":
            with open(os.path.join(ROOT, name + ".asmdef")) as file:
                self.assertEqual(json.load(file)["includePlatforms"], ["Editor"])

    def test_assets_are_valid(self) -> None:
        self.assertEqual(list(validate.problems(ROOT, classes())), [])


class LocalIdsTest(unittest.TestCase):
    def test_ids_are_those_of_public_projects(self) -> None:
        self.assertEqual(local_ids.of_script("<root>"), -944628639613478452)
        self.assertEqual(local_ids.of("Shader", "MainAsset"), -6465566751694194690)

    def test_the_hash_is_xxh64(self) -> None:
        ishmael = "Call me Ishmael. Some years ago--never mind how long precisely-"
        for text, value in [("", 0xEF46DB3751D8E999), ("abc", 0x44BC2CF5AD770999), (ishmael, 0x02A2E85470D6FD96)]:
            self.assertEqual(local_ids.xxh64(text.encode()), value)


class ValidatorTest(unittest.TestCase):
    """Tests the validator. Each test causes one error in a copy of the package."""

    def setUp(self) -> None:
        self.root = tempfile.mkdtemp(prefix="collektive-assets-")
        self.addCleanup(shutil.rmtree, self.root)
        for name in metas.PACKED_ROOT_FILES:
            path = os.path.join(ROOT, name)
            if os.path.isdir(path):
                shutil.copytree(path, os.path.join(self.root, name), ignore=shutil.ignore_patterns("Headless~"))
            else:
                shutil.copy(path, self.root)
            shutil.copy(path + ".meta", self.root)
        self.guids_file = os.path.join(self.root, "guids.txt")
        shutil.copy(guids.GUIDS_FILE, self.guids_file)

    def change(self, path: str, pattern: str, new: str) -> None:
        path = os.path.join(self.root, path)
        with open(path) as file:
            text, count = re.subn(pattern, new, file.read(), count=1, flags=re.M)
        self.assertEqual(count, 1, f"the pattern must occur in {path}")
        with open(path, "w") as file:
            file.write(text)

    def guid_of(self, path: str) -> str:
        return str(assets.guid_of(os.path.join(self.root, path + ".meta")))

    def assert_problem(self, *words: str) -> None:
        """Asserts that the validator reports a problem that contains all words."""
        problems = list(validate.problems(self.root, classes(), self.guids_file))
        self.assertTrue(any(all(word in problem for word in words) for problem in problems), "\n".join(problems) or "no problem was found")

    def test_finds_a_missing_meta(self) -> None:
        os.remove(os.path.join(self.root, ASMDEF + ".meta"))
        self.assert_problem(ASMDEF, ".meta file is missing")

    def test_finds_a_meta_without_an_asset(self) -> None:
        os.remove(os.path.join(self.root, "unity/Runtime/Unity/Simulation/TickTimes.cs"))
        self.assert_problem("TickTimes.cs.meta", "its asset does not exist")

    def test_finds_a_guid_used_twice(self) -> None:
        self.change(PREFAB + ".meta", "guid: .*", f"guid: {self.guid_of(ASMDEF)}")
        self.assert_problem("duplicate GUID")

    def test_finds_a_changed_guid(self) -> None:
        self.change(PREFAB + ".meta", "guid: .*", "guid: " + 32 * "a")
        self.assert_problem(PREFAB, "is missing")

    def test_finds_an_asset_whose_guid_is_not_listed(self) -> None:
        self.change("guids.txt", r"^.* unity/Prefabs/Node\.prefab\n", "")
        self.assert_problem(NODE, "--update")

    def test_an_update_lists_new_assets_and_keeps_existing_ones(self) -> None:
        os.remove(os.path.join(self.root, PREFAB))
        os.remove(os.path.join(self.root, PREFAB + ".meta"))
        before = guids.read(self.guids_file)
        self.change("guids.txt", r"^.* unity/Prefabs/Node\.prefab\n", "")
        guids.update(assets.Assets(self.root), classes(), self.guids_file)
        self.assertEqual(guids.read(self.guids_file), before)
        self.assert_problem(PREFAB, "its GUID", "is missing")

    def test_finds_a_component_without_an_icon(self) -> None:
        self.change("unity/Runtime/Unity/Nodes/Node.cs.meta", r"icon: .*", "icon: {instanceID: 0}")
        self.assert_problem("Node.cs.meta", "no icon")

    def test_finds_a_script_reference_to_nothing(self) -> None:
        self.change(PREFAB, r"guid: [0-9a-f]{32}", "guid: " + 32 * "b")
        self.assert_problem(PREFAB, "MonoBehaviour.m_Script", 32 * "b")

    def test_finds_a_script_reference_to_something_else(self) -> None:
        guid = self.guid_of("unity/Runtime/Unity/Simulation/TickTimes.cs")
        self.change(PREFAB, r"guid: [0-9a-f]{32}", f"guid: {guid}")
        self.assert_problem(PREFAB, "TickTimes.cs", "contains no component")

    def test_finds_a_field_that_the_script_does_not_have(self) -> None:
        self.change(PREFAB, "  m_EditorClassIdentifier: \n", "  m_EditorClassIdentifier: \n  speed: 3\n")
        self.assert_problem(PREFAB, "SimulationManager", "speed")

    def test_finds_a_nested_field_that_the_script_does_not_have(self) -> None:
        self.change(PREFAB, "  m_EditorClassIdentifier: \n", "  m_EditorClassIdentifier: \n  settings:\n    tempo: 3\n")
        self.assert_problem(PREFAB, "settings.tempo")

    def test_finds_a_field_of_another_kind(self) -> None:
        self.change(PREFAB, "  m_EditorClassIdentifier: \n", "  m_EditorClassIdentifier: \n  paused: []\n")
        self.assert_problem(PREFAB, "SimulationManager.paused", "number")

    def test_finds_a_changed_setting_that_the_script_does_not_have(self) -> None:
        self.change(SCENE, "propertyPath: settings.defaultProgram", "propertyPath: settings.defaultProgramme")
        self.assert_problem(SCENE, "settings.defaultProgramme")

    def test_finds_programs_schemas_and_jars_as_text(self) -> None:
        for field, path in [("program", "program"), ("schema", "schema"), ("jars", r"jars.Array.data[0]")]:
            with self.subTest(field):
                self.change(SCENE, r"propertyPath: settings\.\S+\n      value: ?.*", f"propertyPath: settings.{path}\n      value: text")
                self.assert_problem(SCENE, f"SimulationManager.settings.{field} names a program, a schema or jars as text")
        self.change(NODE, "  m_EditorClassIdentifier: \n", "  m_EditorClassIdentifier: \n  program: hops\n")
        self.assert_problem(NODE, "Node.program names a program")

    def test_finds_a_reference_to_a_program_that_a_library_does_not_have(self) -> None:
        self.change(SCENE, r"fileID: -944628639613478452, guid: [0-9a-f]+", f"fileID: 12, guid: {metas.guid_for(LIBRARY)}")
        self.assert_problem(SCENE, "12 is not the id of an object in", LIBRARY, "<root>, gradient-ascent")

    def test_finds_a_reference_to_no_object_of_the_file(self) -> None:
        self.change(SCENE, r"m_GameObject: \{fileID: \d+\}", "m_GameObject: {fileID: 12}")
        self.assert_problem(SCENE, "object 12 does not exist")

    def test_finds_a_reference_to_no_object_of_another_file(self) -> None:
        self.change(SCENE, r"target: \{fileID: \d+", "target: {fileID: 12")
        self.assert_problem(SCENE, "object 12 does not exist", PREFAB)

    def test_finds_a_component_that_its_object_does_not_list(self) -> None:
        self.change(NODE, r"  - component: \{fileID: \d+\}\n", "")
        self.assert_problem(NODE, "not among the components")

    def test_finds_a_root_that_the_scene_does_not_list(self) -> None:
        self.change(SCENE, r"m_Roots:\n  - .*\n", "m_Roots:\n")
        self.assert_problem(SCENE, "SceneRoots", "not listed")

    def test_finds_two_objects_with_one_id(self) -> None:
        self.change(SCENE, "!u!104 &2", "!u!104 &1")
        self.assert_problem(SCENE, "used twice")

    def test_finds_invalid_yaml(self) -> None:
        self.change(NODE, "^  m_Layer: 0", "  m_Layer 0")
        self.assert_problem(NODE, "could not find expected ':'")

    def test_finds_a_flow_mapping_without_a_value(self) -> None:
        self.change(SCENE, r"m_GameObject: \{fileID: ", "m_GameObject: {fileID ")
        self.assert_problem(SCENE, "not 'key: value'")

    def test_finds_a_duplicate_key(self) -> None:
        self.change(NODE, "^  m_Layer: 0", "  m_Layer: 0\n  m_Layer: 0")
        self.assert_problem(NODE, "duplicate key m_Layer")

    def test_finds_an_object_of_an_unknown_class(self) -> None:
        self.change(SCENE, "!u!20 ", "!u!21 ")
        self.assert_problem(SCENE, "Camera")

    def test_finds_an_assembly_reference_to_nothing(self) -> None:
        self.change(ASMDEF, '"Collektive.Bridge"', '"Collektive.Bridges"')
        self.assert_problem(ASMDEF, "Collektive.Bridges")

    def test_finds_an_assembly_that_refers_to_itself(self) -> None:
        self.change("unity/Runtime/Bridge/Collektive.Bridge.asmdef", r'"references": \[\]', '"references": ["Collektive.Unity"]')
        self.assert_problem("reference cycle")

    def test_finds_an_assembly_of_another_name_than_its_file(self) -> None:
        self.change(ASMDEF, '"name": "Collektive.Unity"', '"name": "Collektive.Units"')
        self.assert_problem(ASMDEF, "Collektive.Units")

    def test_finds_a_missing_plugin(self) -> None:
        self.change(ASMDEF, "Collektive.FlatBuffers.dll", "FlatBuffers.dll")
        self.assert_problem(ASMDEF, "FlatBuffers.dll")

    def test_finds_an_assembly_that_is_missing_on_some_platforms(self) -> None:
        self.change(ASMDEF, r'"includePlatforms": \[\]', '"includePlatforms": ["Editor", "LinuxStandalone64"]')
        self.assert_problem(ASMDEF, "compile for all")

    def test_finds_code_without_an_assembly(self) -> None:
        os.remove(os.path.join(self.root, ASMDEF))
        os.remove(os.path.join(self.root, ASMDEF + ".meta"))
        self.assert_problem("SimulationManager.cs", "not belong to an assembly definition")

    def test_finds_an_asset_that_is_not_packed(self) -> None:
        self.change("package.json", r'    "unity/Prefabs",\n', "")
        self.assert_problem(NODE, "allow-list")

    def test_finds_a_sample_that_is_not_listed(self) -> None:
        os.makedirs(os.path.join(self.root, "unity/Samples~/Extra"))
        self.assert_problem("Samples~/Extra", "not in package.json")

    def test_finds_a_primitive_whose_components_are_stripped_from_players(self) -> None:
        self.change(SCENE, "^--- !u!135 ", "--- !u!136 ")
        self.assert_problem(SCENE, "scripts create a Sphere", "class 135")

    def test_finds_instancing_that_is_enabled_at_run_time(self) -> None:
        self.change("unity/Samples~/Swarm/DroneView.cs", r"\{ color = Colors\[i\] \}", "{ color = Colors[i], enableInstancing = true }")
        self.assert_problem("DroneView.cs", "enables instancing at run time")

    def test_finds_a_shader_without_depth(self) -> None:
        self.change("unity/Materials/Surface.shader", '"LightMode" = "DepthOnly"', '"LightMode" = "Always"')
        self.assert_problem("Surface.shader", "DepthOnly")

    def test_finds_an_old_manifest_for_git(self) -> None:
        self.change("package.json", r'"version": "[^"]*"', '"version": "9.9.9"')
        self.assert_problem("unity/package.json", "outdated")


class NativeLibrariesTest(unittest.TestCase):
    """Tests the rule for native libraries with the same name, which depends on players, processors and versions of Unity."""

    @staticmethod
    def library(platform: str, unity: str, name: str = "libcollektive_shim.so") -> plugins.Library:
        return plugins.Library(f"Plugins/{platform}/{name}", metas.native(platform), unity)

    def test_libraries_of_two_processors_collide_in_linux_players_of_old_versions(self) -> None:
        for unity in "6000.0", "6000.3", "6000.4":
            found = list(plugins.problems([self.library("linux-x64", "6000.0"), self.library("linux-arm64", unity)]))
            self.assertEqual(found, ["Plugins/linux-x64/libcollektive_shim.so: collides with Plugins/linux-arm64/libcollektive_shim.so in Linux64 players "
                                     f"of Unity {unity}"])

    def test_newer_players_have_a_folder_for_each_processor(self) -> None:
        self.assertEqual(list(plugins.problems([self.library("linux-x64", "6000.0"), self.library("linux-arm64", "6000.5")])), [])
        self.assertEqual(list(plugins.problems([self.library("mac-x64", "6000.0"), self.library("mac-arm64", "6000.0")])), [])

    def test_two_libraries_for_one_processor_collide_in_each_version(self) -> None:
        copy = self.library("linux-x64", "6000.5")._replace(path="Other/libcollektive_shim.so")
        self.assertEqual(len(list(plugins.problems([self.library("linux-x64", "6000.5"), copy]))), 1)

    def test_libraries_of_other_names_or_players_do_not_collide(self) -> None:
        self.assertEqual(list(plugins.problems([self.library("linux-x64", "6000.0"), self.library("linux-x64", "6000.0", "libother.so")])), [])
        self.assertEqual(list(plugins.problems([self.library("linux-x64", "6000.0"), self.library("mac-x64", "6000.0")])), [])
