"""Checks the objects and references in prefabs, scenes and materials, and compares the fields of scripts with the C#."""
import os
import re
from collections.abc import Iterator, Mapping
from typing import Any

from build import local_ids
from validator import unity_yaml
from validator.assets import BUILT_IN, Assets
from validator.serialized_fields import ScriptClass
from validator.unity_yaml import Document

Files = dict[str, list[Document]]

# Unity's class number of each type of object that occurs in the package.
CLASSES = {
    1: "GameObject", 4: "Transform", 20: "Camera", 21: "Material", 23: "MeshRenderer", 29: "OcclusionCullingSettings", 33: "MeshFilter",
    54: "Rigidbody", 65: "BoxCollider", 81: "AudioListener", 104: "RenderSettings", 108: "Light", 114: "MonoBehaviour", 135: "SphereCollider",
    157: "LightmapSettings", 196: "NavMeshSettings", 1001: "PrefabInstance", 1660057539: "SceneRoots",
}
YAML_ENDINGS = (".prefab", ".unity", ".mat", ".asset")
# The file id and the reference type of the main object of an imported asset.
IMPORTED = {".cs": ("11500000", "3"), ".shader": ("4800000", "3")}
# The identifier that ProgramLibraryImporter.cs assigns to a library of programs. A program's identifier is its name.
LIBRARY = "<root>"
# Fields that only scripts may set. Scenes must refer to libraries and programs instead.
TEXTS = {"Collektive.Unity.SimulationManager": {"settings.schema", "settings.jars", "settings.program"}, "Collektive.Unity.Node": {"program"}}
# The file id with which a PrefabInstance refers to the whole prefab.
WHOLE_PREFAB = "100100000"
# Fields that Unity writes for every MonoBehaviour.
COMMON_FIELDS = {
    "m_ObjectHideFlags", "m_CorrespondingSourceObject", "m_PrefabInstance", "m_PrefabAsset", "m_GameObject", "m_Enabled", "m_EditorHideFlags",
    "m_Script", "m_Name", "m_EditorClassIdentifier",
}


def problems(assets: Assets, classes: Mapping[str, ScriptClass]) -> Iterator[str]:
    files: Files = {}
    for path in assets.with_ending(*YAML_ENDINGS):
        try:
            files[path] = unity_yaml.read(os.path.join(assets.root, path))
        except unity_yaml.UnityYamlError as error:
            yield f"{path}:{error}"
    for path, documents in files.items():
        for problem in AssetFile(assets, classes, files, path, documents).problems():
            yield f"{path}:{problem}"


class AssetFile:
    """The check of one prefab, scene, material or asset."""

    def __init__(self, assets: Assets, classes: Mapping[str, ScriptClass], files: Files, path: str, documents: list[Document]) -> None:
        self.assets = assets
        self.classes = classes
        self.files = files
        self.path = path
        self.documents = documents
        self.by_id = {str(document.file_id): document for document in documents}

    def problems(self) -> Iterator[str]:
        seen: set[int] = set()
        for document in self.documents:
            if document.file_id in seen:
                yield f"{document.line}: the file id {document.file_id} is used twice"
            seen.add(document.file_id)
            if CLASSES.get(document.class_id) != document.type_name:
                yield f"{document.line}: {document.type_name} has the unknown class number {document.class_id}"
            for where, reference in references(document.fields):
                problem = self.check_reference(reference)
                if problem:
                    yield f"{document.line}: {document.type_name}.{where}: {problem}"
            if document.type_name == "GameObject":
                yield from self.check_game_object(document)
            if document.type_name == "Transform" and not document.stripped:
                yield from self.check_transform(document)
            if document.type_name == "MonoBehaviour" and not document.stripped:
                yield from self.check_script(document)
            if document.type_name == "PrefabInstance":
                yield from self.check_instance(document)
        if self.path.endswith(".unity"):
            yield from self.check_scene()

    def check_reference(self, reference: dict[str, str]) -> str | None:
        """Returns the error in a reference, or None if the reference is valid."""
        file_id, guid = reference["fileID"], reference.get("guid")
        if file_id == "0":
            return None
        if guid is None:
            return None if file_id in self.by_id else f"object {file_id} does not exist in this file"
        if guid in BUILT_IN:
            return None
        target = self.assets.guids.get(guid)
        if target is None:
            return f"no asset of the package has the GUID {guid}"
        if target in self.assets.libraries:
            names = [LIBRARY, *sorted(self.assets.libraries[target])]
            known = {str(local_ids.of_script(name)) for name in names}
            return None if file_id in known and reference.get("type") == "3" else f"{file_id} is not the id of an object in {target}: {', '.join(names)}"
        imported = IMPORTED.get(os.path.splitext(target)[1])
        if imported:
            return None if (file_id, reference.get("type")) == imported else f"a reference to {target} needs fileID {imported[0]} and type {imported[1]}"
        if target not in self.files:
            return f"{target} cannot be referenced"
        if target.endswith(".prefab") and file_id == WHOLE_PREFAB:
            return None
        if file_id not in {str(document.file_id) for document in self.files[target]}:
            return f"object {file_id} does not exist in {target}"
        return None

    def check_game_object(self, document: Document) -> Iterator[str]:
        for entry in document.fields["m_Component"]:
            component = self.by_id.get(entry["component"]["fileID"])
            if component and component.fields["m_GameObject"]["fileID"] != str(document.file_id):
                yield f"{component.line}: {component.type_name} is listed by {document.fields['m_Name']}, but belongs to a different GameObject"
        listed = {entry["component"]["fileID"] for entry in document.fields["m_Component"]}
        for other in self.documents:
            owner = other.fields.get("m_GameObject", {}).get("fileID")
            if owner == str(document.file_id) and str(other.file_id) not in listed:
                yield f"{other.line}: {other.type_name} is not among the components of {document.fields['m_Name']}"

    def check_transform(self, document: Document) -> Iterator[str]:
        for child in document.fields["m_Children"]:
            other = self.by_id.get(child["fileID"])
            if other and not other.stripped and other.fields["m_Father"]["fileID"] != str(document.file_id):
                yield f"{other.line}: the parent of this Transform must be {document.file_id}"
        parent = self.by_id.get(document.fields["m_Father"]["fileID"])
        if parent and not parent.stripped and {"fileID": str(document.file_id)} not in parent.fields["m_Children"]:
            yield f"{document.line}: Transform is not among the children of its parent"

    def check_scene(self) -> Iterator[str]:
        roots = [document for document in self.documents if document.type_name == "SceneRoots"]
        if len(roots) != 1:
            yield "1: a scene must have exactly one SceneRoots"
            return
        listed = {reference["fileID"] for reference in roots[0].fields["m_Roots"]}
        roots_found = {str(document.file_id) for document in self.documents if is_root(document)}
        for file_id in sorted(roots_found ^ listed):
            yield f"{roots[0].line}: SceneRoots: object {file_id} is {'not listed' if file_id in roots_found else 'not a root'}"

    def check_script(self, document: Document) -> Iterator[str]:
        script = self.script_of(document)
        if script is None:
            # check_reference has already reported the missing asset.
            return
        known = self.class_of(script)
        if known is None:
            yield f"{document.line}: {script} contains no component or asset class with the name of the file"
            return
        for path, value in flattened(document.fields):
            if path.split(".")[0] not in COMMON_FIELDS:
                yield from self.check_field(document.line, known, path, value)

    def check_field(self, line: int, known: ScriptClass, path: str, value: Any) -> Iterator[str]:
        kind = known.fields.get(path)
        if kind is None:
            yield f"{line}: {known.name} has no serialised field {path}"
        elif not fits(kind, value):
            yield f"{line}: {known.name}.{path} is a {kind}, not {value!r}"
        elif value:
            yield from self.check_text(line, known, path)

    def check_text(self, line: int, known: ScriptClass, path: str) -> Iterator[str]:
        if path in TEXTS.get(known.name, ()):
            yield f"{line}: {known.name}.{path} names a program, a schema or jars as text: refer to the library or the program"

    def check_instance(self, document: Document) -> Iterator[str]:
        source = self.assets.guids.get(document.fields["m_SourcePrefab"].get("guid"))
        targets = {str(target.file_id): target for target in self.files.get(source or "", [])}
        for change in document.fields["m_Modification"]["m_Modifications"]:
            target = targets.get(change["target"]["fileID"])
            if target is None:
                # check_reference has already reported the missing object.
                continue
            path = re.sub(r"\.Array\.(size|data\[\d+\])", "", change["propertyPath"])
            if target.type_name == "MonoBehaviour" and path.split(".")[0] not in COMMON_FIELDS:
                script = self.script_of(target)
                known = script and self.class_of(script)
                if known and path not in known.fields:
                    yield f"{document.line}: {known.name} has no serialised field {path}"
                elif known:
                    yield from self.check_text(document.line, known, path)

    def script_of(self, document: Document) -> str | None:
        return self.assets.guids.get(document.fields["m_Script"].get("guid"))

    def class_of(self, script: str) -> ScriptClass | None:
        """Returns the class that has the name of the script file. Unity uses this class."""
        name = os.path.basename(script)[:-len(".cs")]
        namespace = re.search(r"^namespace ([\w.]+)", self.assets.read(script), re.M)
        return self.classes.get(f"{namespace[1]}.{name}" if namespace else name)


def is_root(document: Document) -> bool:
    if document.type_name == "Transform" and not document.stripped:
        return bool(document.fields["m_Father"]["fileID"] == "0")
    return document.type_name == "PrefabInstance" and bool(document.fields["m_Modification"]["m_TransformParent"]["fileID"] == "0")


def references(value: Any, where: str = "") -> Iterator[tuple[str, dict[str, str]]]:
    """Yields the path of each reference in a value, and the reference."""
    if isinstance(value, dict):
        if "fileID" in value:
            yield where, value
            return
        for key, inner in value.items():
            yield from references(inner, f"{where}.{key}" if where else key)
    elif isinstance(value, list):
        for inner in value:
            yield from references(inner, where)


def flattened(fields: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yields the path and value of each field of a script. The elements of a list have the path of the list."""
    for key, value in fields.items():
        path = prefix + key
        yield path, value
        if isinstance(value, dict) and "fileID" not in value and not is_vector(value):
            yield from flattened(value, path + ".")
        if isinstance(value, list):
            for element in value:
                if isinstance(element, dict) and "fileID" not in element and not is_vector(element):
                    yield from flattened(element, path + ".")


def is_vector(value: dict[str, Any]) -> bool:
    """Returns whether a value is a vector, a colour or a mask. The parts of these are not checked."""
    return set(value) <= set("xyzwrgba") or "m_Bits" in value


def fits(kind: str, value: Any) -> bool:
    if kind == "list":
        return isinstance(value, list)
    if kind == "reference":
        return isinstance(value, dict) and "fileID" in value
    if kind in ("value", "fields"):
        return isinstance(value, dict)
    if kind == "number":
        return isinstance(value, str) and re.fullmatch(r"-?[0-9.]+(e[+-]?\d+)?", value) is not None
    return isinstance(value, str)
