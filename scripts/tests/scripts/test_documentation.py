"""Tests that every public member of the Kotlin modules and the C headers has documentation. The build itself checks C#."""
import glob
import os
import re
from collections.abc import Iterator

import pytest

import collektive
from build.places import ROOT
from build.site import sources

MODULES = sorted({path.split(os.sep)[-2] for path in glob.glob(os.path.join(ROOT, "jvm-host/*/api"))} | {"dsl", "stdlib"})
# All public declarations have a modifier because of Kotlin's explicit API mode. Overrides and companions inherit their documentation.
PUBLIC = re.compile(r"^\s*(?:@\w+(?:\([^)]*\))?\s+)*(?:public|protected)\s(?!(?:final |open )?override\b|companion object)")
NAME = re.compile(r"\b(?:val|var|fun|class|interface|object|typealias)\s+(?:<[^>]*>\s*)?(?:[\w<>?, *]+\.)?(\w+)")
HEADERS = ["collektive_shim.h", "collektive_neighbours.h"]


def undocumented_kotlin(text: str) -> Iterator[str]:
    """Yields the lines of public declarations without KDoc. Properties of a constructor may have a @property in the KDoc of the class instead."""
    lines, last = text.splitlines(), ""
    for number, line in enumerate(lines):
        above = number - 1
        # Skips annotations, which may have several lines and then end with a bracket.
        while above >= 0 and re.match(r"\s*(?:@|//|\)$|context\()|\s+\w+\.\w+,$", lines[above]):
            above -= 1
        documented = above >= 0 and lines[above].rstrip().endswith("*/")
        if documented:
            start = next(at for at in range(above, -1, -1) if "/**" in lines[at])
            if re.search(r"\b(?:class|interface|object)\b", line):
                last = "\n".join(lines[start:above + 1])
        if not PUBLIC.match(line) or documented:
            continue
        name = NAME.search(line)
        if not (name and re.search(rf"@(?:property|param) {name[1]}\b", last)):
            yield f"{number + 1}: {line.strip()}"


def undocumented_c(text: str) -> Iterator[str]:
    """Yields declarations without a comment above them or on their line, except `size`, which the introduction of the header describes."""
    lines = text.splitlines()
    inside = False
    for number, line in enumerate(lines):
        before = lines[number - 1].rstrip()
        declares = re.match(r"CLK_(?:\w+_)?API |typedef |enum ", line) or (inside and re.match(r"    \w.*[;,=]", line) and "size;" not in line)
        if declares and "/*" not in line and not before.endswith("*/") and not line.startswith("enum "):
            yield f"{number + 1}: {line.strip()}"
        inside = (inside and not line.startswith("}")) or bool(re.match(r"(?:typedef struct|enum) .*{", line))


@pytest.mark.parametrize("module", MODULES)
def test_every_public_member_of_a_module_has_kdoc(module: str) -> None:
    found = []
    for path in sorted(glob.glob(os.path.join(ROOT, "jvm-host", module, "src/main/kotlin/**/*.kt"), recursive=True)):
        with open(path) as file:
            found += [f"{os.path.relpath(path, ROOT)}:{line}" for line in undocumented_kotlin(file.read())]
    assert found == []


@pytest.mark.parametrize("header", HEADERS)
def test_every_declaration_of_a_c_header_has_a_comment(header: str) -> None:
    with open(os.path.join(ROOT, "native-shim/include", header)) as file:
        assert [line for line in undocumented_c(file.read()) if "CLK_X" not in line and "CLK_ERRORS" not in line] == []


def test_the_editor_part_has_no_public_type() -> None:
    """Tests that the editor assembly has only internal types, because the build does not check its documentation."""
    types = []
    for path in sorted(glob.glob(os.path.join(ROOT, "unity/Editor/**/*.cs"), recursive=True)):
        with open(path) as file:
            types += re.findall(r"(?m)^    ((?:\w+ )*(?:class|struct|interface|enum|delegate) \w+)", file.read())
    assert len(types) > 20
    assert [declared for declared in types if not declared.startswith("internal ")] == []


def test_the_site_has_the_help_of_each_command() -> None:
    assert sources.commands() == list(collektive.COMMANDS)


def test_missing_documentation_is_found() -> None:
    bare = "/** A thing. */\npublic class A(\n    public val a: Int,\n)\n\npublic fun b() = 1"
    assert list(undocumented_kotlin(bare)) == ["3: public val a: Int,", "6: public fun b() = 1"]
    assert list(undocumented_kotlin("/**\n * A.\n *\n * @property a its a.\n */\n@Serializable\npublic class A(\n    public val a: Int,\n)")) == []
    assert list(undocumented_c("\nCLK_API int f(void);\n\ntypedef struct a {\n    uint32_t size;\n    int b;\n    int c; /* c */\n} a;\n")) == [
        "2: CLK_API int f(void);", "4: typedef struct a {", "6: int b;"]
