"""Checks the names, references and platforms of assembly definitions, and that every C# file belongs to one."""
import json
import os
from collections.abc import Iterator
from typing import Any

from validator.assets import Assets

# Assemblies and plugins of Unity's packages that assembly definitions may reference.
UNITY_ASSEMBLIES = {"UnityEngine.TestRunner", "UnityEditor.TestRunner"}
UNITY_PLUGINS = {"nunit.framework.dll"}
# Plugins that the build adds to the package.
BUILT_PLUGINS = {"Collektive.FlatBuffers.dll"}
# The path and content of each assembly definition, by name.
Definitions = dict[str, tuple[str, dict[str, Any]]]
PLATFORMS = {"Editor", "LinuxStandalone64", "macOSStandalone", "WindowsStandalone64"}


def problems(assets: Assets) -> Iterator[str]:
    definitions: Definitions = {}
    for path in assets.with_ending(".asmdef"):
        try:
            definition = json.loads(assets.read(path))
        except json.JSONDecodeError as error:
            yield f"{path}:{error.lineno}: not valid JSON: {error.msg}"
            continue
        name = definition.get("name", "")
        if name != os.path.basename(path)[:-len(".asmdef")]:
            yield f"{path}: its name is '{name}', which must be the name of the file"
        if name in definitions:
            yield f"{path}: {definitions[name][0]} has the same name '{name}'"
        definitions[name] = (path, definition)
    for _, (path, definition) in sorted(definitions.items()):
        yield from check_definition(path, definition, definitions)
    yield from cycles(definitions)
    yield from unassigned(assets, definitions)


def check_definition(path: str, definition: dict[str, Any], definitions: Definitions) -> Iterator[str]:
    for reference in definition.get("references", []):
        if reference not in definitions and reference not in UNITY_ASSEMBLIES:
            yield f"{path}: refers to the assembly '{reference}', which is not in the package"
    for plugin in definition.get("precompiledReferences", []):
        if plugin not in BUILT_PLUGINS | UNITY_PLUGINS:
            yield f"{path}: refers to the plugin '{plugin}', which is not in the package"
    if definition.get("precompiledReferences") and not definition.get("overrideReferences"):
        yield f"{path}: lists precompiled references, which Unity ignores without overrideReferences"
    platforms = set(definition.get("includePlatforms", []))
    folders = path.split("/")
    is_test = "Tests" in folders
    if platforms - PLATFORMS or (is_test and not platforms):
        yield f"{path}: its platforms are {sorted(platforms)}, but only {sorted(PLATFORMS)} are allowed, and tests need at least one of them"
    if platforms not in (set(), {"Editor"}) and not is_test:
        yield f"{path}: its platforms are {sorted(platforms)}: runtime code must compile for all platforms, so that unsupported players report an error"
    # Tests that run in edit mode do not need to be in a folder Editor.
    if ("Editor" in folders) != (platforms == {"Editor"}) and ("Editor" in folders or not is_test):
        yield f"{path}: editor code must be in a folder Editor and have only the platform Editor"
    if is_test != ("UNITY_INCLUDE_TESTS" in definition.get("defineConstraints", [])):
        yield f"{path}: tests must be in a folder Tests and have the constraint UNITY_INCLUDE_TESTS"
    if is_test and "nunit.framework.dll" not in definition.get("precompiledReferences", []):
        yield f"{path}: tests must reference nunit.framework.dll"


def cycles(definitions: Definitions) -> Iterator[str]:
    for name in sorted(definitions):
        seen: set[str] = set()
        open_names = list(definitions[name][1].get("references", []))
        while open_names:
            reference = open_names.pop()
            if reference == name:
                yield f"{definitions[name][0]}: is part of a reference cycle"
                break
            if reference in definitions and reference not in seen:
                seen.add(reference)
                open_names += definitions[reference][1].get("references", [])


def unassigned(assets: Assets, definitions: Definitions) -> Iterator[str]:
    """Yields the C# files that belong to no assembly definition. Unity would compile them into the user's assembly."""
    folders = [os.path.dirname(path) + "/" for path, _ in definitions.values()]
    for path in assets.with_ending(".cs"):
        if not any(path.startswith(folder) for folder in folders):
            yield f"{path}: does not belong to an assembly definition"
