"""Creates missing .meta files of Unity assets: `python3 scripts/build/metas.py ROOT`.

Unity identifies an asset by the GUID in its meta, so an existing meta must never change. The GUID of a new meta is computed from the asset's path.
Files and folders whose names end in `~` or begin with `.` are not assets.
"""
import hashlib
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path

# Plugins in the package: a native library in the folder of each platform, and managed assemblies for all platforms.
PLUGIN = ("PluginImporter:\n  externalObjects: {}\n  serializedVersion: 2\n  iconMap: {}\n  executionOrder: {}\n  defineConstraints: []\n"
          "  isPreloaded: 0\n  isOverridable: 0\n  isExplicitlyReferenced: 0\n  validateReferences: 1\n  platformData:\n%s"
          "  userData: \n  assetBundleName: \n  assetBundleVariant: \n")
PLATFORM = "  - first:\n      %s\n    second:\n      enabled: %d\n      settings:%s\n"
# For each platform: the editor's processor and system, or None if no editor exists, and the player's platform and processor.
NATIVE = {"win-x64": (("x86_64", "Windows"), "Win64", "x86_64"), "linux-x64": (("x86_64", "Linux"), "Linux64", "x86_64"),
          "linux-arm64": (None, "Linux64", "ARM64"), "mac-x64": (("x86_64", "OSX"), "OSXUniversal", "x86_64"),
          "mac-arm64": (("ARM64", "OSX"), "OSXUniversal", "ARM64")}
TEXT = "TextScriptImporter:\n  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n"
PACKED_ROOT_FILES = ["README.md", "CHANGELOG.md", "LICENSE", "THIRD-PARTY.md", "package.json", "unity"]
# Samples need metas, too, because Unity copies them into a project with their metas when the user imports them.
IMPORTED = ["unity", "unity/Samples~"]
IMPORTERS = {
    ".cs": "MonoImporter:\n  externalObjects: {}\n  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n"
           "  icon: {instanceID: 0}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n",
    ".asmdef": "AssemblyDefinitionImporter:\n  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n",
    ".md": TEXT,
    ".txt": TEXT,
    ".mat": "NativeFormatImporter:\n  externalObjects: {}\n  mainObjectFileID: 2100000\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n",
    ".prefab": "PrefabImporter:\n  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n",
    ".shader": "ShaderImporter:\n  externalObjects: {}\n  defaultTextures: []\n  nonModifiableTextures: []\n  preprocessorOverride: 0\n"
               "  userData: \n  assetBundleName: \n  assetBundleVariant: \n",
    ".png": "TextureImporter:\n  externalObjects: {}\n  serializedVersion: 13\n  mipmaps:\n    enableMipMap: 0\n"
            "  textureSettings:\n    wrapU: 1\n    wrapV: 1\n  nPOTScale: 0\n  alphaIsTransparency: 1\n  textureType: 2\n"
            "  userData: \n  assetBundleName: \n  assetBundleVariant: \n",
    ".dll": PLUGIN % (PLATFORM % ("Any: ", 1, " {}") + PLATFORM % ("Editor: Editor", 0, "\n        DefaultValueInitialized: true")),
    ".json": TEXT,
    "package.json": "PackageManifestImporter:\n  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n",
}
DEFAULT = "DefaultImporter:\n  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n"


def is_asset(name: str) -> bool:
    return not name.endswith("~") and not name.startswith(".") and not name.endswith(".meta")


def assets(root: str | Path) -> Iterator[str]:
    """Yields the paths of all assets in the package, relative to its root."""
    yield from PACKED_ROOT_FILES
    for top in IMPORTED:
        for folder, folders, files in os.walk(os.path.join(root, top)):
            folders[:] = sorted(name for name in folders if is_asset(name))
            for name in sorted(folders + [name for name in files if is_asset(name)]):
                yield os.path.relpath(os.path.join(folder, name), root)


def guid_for(asset: str, package: str = "org.collektive.unity") -> str:
    """Returns the GUID of a new asset."""
    return hashlib.md5((package + "/" + asset.replace(os.sep, "/")).encode()).hexdigest()


IMPORTERS[".clkprograms"] = (
    "ScriptedImporter:\n  internalIDToNameTable: []\n  externalObjects: {}\n  serializedVersion: 2\n  userData: \n  assetBundleName: \n"
    f"  assetBundleVariant: \n  script: {{fileID: 11500000, guid: {guid_for('unity/Editor/ProgramLibraryImporter.cs')}, type: 3}}\n")


def guid_in(meta: str) -> str | None:
    """Returns the GUID in the text of a meta, or None."""
    match = re.search(r"^guid: ([0-9a-f]{32})$", meta, re.M)
    return match[1] if match else None


def native(platform: str) -> str:
    """Returns the importer settings of a platform's native library."""
    editor, player, processor = NATIVE[platform]
    in_editor = "\n        DefaultValueInitialized: true"
    if editor:
        in_editor = f"\n        CPU: {editor[0]}{in_editor}\n        OS: {editor[1]}"
    return PLUGIN % (PLATFORM % ("Any: ", 0, " {}") + PLATFORM % ("Editor: Editor", 1 if editor else 0, in_editor)
                     + PLATFORM % ("Standalone: " + player, 1, "\n        CPU: " + processor))


def meta_of(root: str | Path, asset: str, package: str = "org.collektive.unity") -> str:
    path = os.path.join(root, asset)
    head = f"fileFormatVersion: 2\nguid: {guid_for(asset, package)}\n"
    if os.path.isdir(path):
        return head + "folderAsset: yes\n" + DEFAULT
    name, folder = os.path.basename(asset), os.path.basename(os.path.dirname(asset))
    if folder in NATIVE:
        return head + native(folder)
    return head + IMPORTERS.get(name, IMPORTERS.get(os.path.splitext(name)[1], DEFAULT))


def problems(root: str | Path) -> Iterator[str]:
    """Yields a line for each missing meta, meta without an asset, invalid GUID and duplicate GUID."""
    known: dict[str, str] = {}
    expected = set()
    for asset in assets(root):
        meta = os.path.join(root, asset + ".meta")
        expected.add(os.path.abspath(meta))
        if not os.path.exists(meta):
            yield f"{asset}: the .meta file is missing; run scripts/build/metas.py"
            continue
        with open(meta) as file:
            guid = guid_in(file.read())
        if guid is None:
            yield f"{asset}.meta: the GUID is missing or invalid"
        elif guid in known:
            yield f"{asset}.meta: duplicate GUID, also used by {known[guid]}"
        else:
            known[guid] = asset
    for top in IMPORTED:
        for folder, folders, files in os.walk(os.path.join(root, top)):
            folders[:] = [name for name in folders if is_asset(name)]
            for name in files:
                path = os.path.abspath(os.path.join(folder, name))
                if name.endswith(".meta") and path not in expected:
                    yield f"{os.path.relpath(path, root)}: its asset does not exist; delete the file"


def write_missing(root: str | Path) -> None:
    """Writes the missing metas of assets below a root."""
    for asset in assets(root):
        meta = Path(root, asset + ".meta")
        if not meta.exists():
            meta.write_text(meta_of(root, asset))


if __name__ == "__main__":
    write_missing(sys.argv[1])
