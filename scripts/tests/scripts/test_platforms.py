"""Tests the metadata of native libraries and JVM packages."""
import os
from pathlib import Path

import pytest

from build import manifest, metas, platforms
from build.places import ROOT

EXPECTED = {
    "win-x64": ("CPU: x86_64", "OS: Windows", "Win64"),
    "linux-x64": ("CPU: x86_64", "OS: Linux", "Linux64"),
    "mac-x64": ("CPU: x86_64", "OS: OSX", "OSXUniversal"),
    "mac-arm64": ("CPU: ARM64", "OS: OSX", "OSXUniversal"),
}


def importer(platform: str, name: str) -> str:
    return metas.meta_of(ROOT, f"unity/Runtime/Plugins/{platform}/{name}")


@pytest.mark.parametrize("platform", EXPECTED)
def test_a_native_library_is_for_its_own_editor_and_player_only(platform: str) -> None:
    processor, system, player = EXPECTED[platform]
    text = importer(platform, "libcollektive_shim.x")
    assert "Any: \n    second:\n      enabled: 0" in text
    assert f"Editor: Editor\n    second:\n      enabled: 1\n      settings:\n        {processor}\n" in text and system in text
    assert f"Standalone: {player}\n    second:\n      enabled: 1\n      settings:\n        {processor}\n" in text


def test_linux_on_arm_has_no_editor() -> None:
    text = importer("linux-arm64", "libcollektive_shim.so")
    assert "Editor: Editor\n    second:\n      enabled: 0" in text
    assert "Standalone: Linux64\n    second:\n      enabled: 1\n      settings:\n        CPU: ARM64" in text


def test_guids_of_native_libraries_are_stable_and_unique() -> None:
    guids = {metas.guid_in(importer(platform, "libcollektive_shim.so")) for platform in metas.NATIVE}
    assert len(guids) == 5
    assert metas.guid_in(importer("linux-x64", "libcollektive_shim.so")) == "7db39c4f0a517853fde8acd0f946d656"


@pytest.mark.parametrize("platform", metas.NATIVE)
def test_a_jvm_package_is_named_after_its_platform_and_contains_its_files_only(platform: str, tmp_path: Path) -> None:
    manifest.write_jvm(ROOT, platform, tmp_path)
    assert sorted(os.listdir(tmp_path)) == ["package.json", "package.json.meta"]
    written = manifest.for_jvm(ROOT, platform)
    assert written["name"] == "org.collektive.unity.jvm." + platform
    assert written["version"] == manifest.read(ROOT)["version"]
    assert written["files"] == ["Jvm~", *(["Plugins", "Plugins.meta"] if platform in manifest.WITH_LIBRARY else []), "package.json.meta"]
    assert written["unity"] == ("6000.5" if platform == "linux-arm64" else manifest.read(ROOT)["unity"])


def test_manifests_of_a_release_link_to_pages_of_its_tag(tmp_path: Path) -> None:
    manifest.write_jvm(ROOT, "mac-x64", tmp_path)
    manifest.write_links(tmp_path, "https://example.org/owner/name")
    written = manifest.read(tmp_path)
    pages = f"https://example.org/owner/name/blob/v{written['version']}/"
    assert written["documentationUrl"] == pages + "Documentation~/index.md"
    assert (written["changelogUrl"], written["licensesUrl"]) == (pages + "CHANGELOG.md", pages + "LICENSE")


def test_metas_and_manifests_name_the_platforms_that_are_built() -> None:
    assert set(platforms.PLATFORMS) == set(metas.NATIVE) == set(manifest.SYSTEMS)


@pytest.mark.parametrize("platform", platforms.PLATFORMS)
def test_java_of_another_platform_is_run_by_its_emulator(platform: str) -> None:
    words = platforms.java_command(platform)
    assert words[:-1] == platforms.emulator(platform)
    assert words[-1].endswith(f"build/jre-{platform}/bin/java" + (".exe" if platform == "win-x64" else ""))


def test_programs_of_macos_cannot_be_run_here_and_those_of_this_platform_can() -> None:
    assert "macOS" in (platforms.unavailable_reason("mac-x64") or "")
    assert platforms.unavailable_reason("linux-x64") is None
