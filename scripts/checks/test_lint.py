"""Checks the sources with linters, and pages, comments and messages for grammar and style."""
import fnmatch
import os
import re
import subprocess
import sys

import messages
import pytest

from build.jdk import find_jdk
from build.places import BUILD, ROOT

# Paths of generated files, which are not checked.
GENERATED = re.compile(r"(^|/)Generated/|(^|/)package-lock\.json$|\.meta$|^unity/Tests/PublicApi/.*\.txt$")
# Test programs are not checked, because they have different styles on purpose.
TEST_PROGRAMS = ("jvm-host/*/src/test/resources/*",)
HABITS = [entry.split(" => ") for entry in (ROOT / "scripts/checks/english.txt").read_text().splitlines() if not entry.startswith("#")]


def sources(*patterns: str) -> list[str]:
    """Returns the files of the repository, including new ones, whose paths match a pattern."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"], capture_output=True, text=True, check=True)
    paths = [path for path in listed.stdout.split("\0") if path and os.path.isfile(os.path.join(ROOT, path))]
    found = sorted(path for path in paths if _matches(path, patterns) and not _matches(path, TEST_PROGRAMS) and not GENERATED.search(path))
    if not found:
        pytest.skip(f"no file matches {' '.join(patterns)}")
    return found


def _matches(path: str, patterns: tuple[str, ...]) -> bool:
    return any(fnmatch.fnmatch(path, pattern) for pattern in patterns)


def assert_clean(*command: str, tools: str = "npm") -> None:
    result = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            env={**os.environ, "COLLEKTIVE_NODE_MODULES": os.path.join(BUILD, tools, "node_modules"), "NO_COLOR": "1"})
    if result.returncode != 0:
        pytest.fail(result.stdout[-20000:], pytrace=False)


def test_shell_is_clean_under_shellcheck() -> None:
    assert_clean(os.path.join(BUILD, "python/bin/shellcheck"), "collektive", ".ci/run", "tools/coreclr/coreclr")


def test_python_is_clean_under_ruff() -> None:
    assert_clean(sys.executable, "-m", "ruff", "check", "--no-cache", *sources("*.py"))


def test_python_is_typed() -> None:
    assert_clean(sys.executable, "-m", "mypy", "--config-file", "mypy.ini", "--cache-dir", os.path.join(BUILD, "mypy"))


def test_javascript_is_clean_under_eslint() -> None:
    assert_clean("node", os.path.join(BUILD, "npm/node_modules/eslint/bin/eslint.js"), "--max-warnings", "0", "unity/Headless~/Replay", "scripts")


def test_c_and_cpp_are_formatted_by_clang_format() -> None:
    assert_clean(os.path.join(BUILD, "python/bin/clang-format"), "--dry-run", "--Werror",
                 *sources("native-shim/*.c", "native-shim/*.h", "unity/*.c", "unity/*.cpp", "unity/*.hpp", "unity/*.h"))


def test_kotlin_is_clean_under_ktlint() -> None:
    assert_clean(str(find_jdk() / "bin/java"), "-XX:TieredStopAtLevel=1", "-XX:+UseSerialGC", "-cp", os.path.join(BUILD, "ktlint/*"),
          "com.pinterest.ktlint.Main", "--relative", "--log-level=error",
          *sources("jvm-host/*.kt", "scripts/*.kt", "unity/*.kt", "experiments/*.kt", "*.kts"))


@pytest.mark.slow
def test_workflows_are_clean_under_actionlint() -> None:
    linter = os.path.join(BUILD, "go/actionlint")
    if not os.path.exists(linter):
        pytest.skip("building actionlint needs Go")
    assert_clean(linter, "-shellcheck", os.path.join(BUILD, "python/bin/shellcheck"), *sources(".github/workflows/*.yml"))


def test_text_files_follow_editorconfig() -> None:
    # ktlint checks Kotlin instead, because it allows long lines for literals and names of tests.
    texts = [path for path in sources("*") if not path.endswith((".kt", ".kts"))]
    assert_clean(os.path.join(BUILD, "python/bin/edcfg-lint"), *texts)


def pages() -> list[str]:
    return [page for page in sources("*.md") if page not in ("CHANGELOG.md", "THIRD-PARTY.md")]


def test_git_does_not_convert_line_endings() -> None:
    result = subprocess.run(["git", "-C", ROOT, "check-attr", "text", "collektive"], capture_output=True, text=True, check=True)
    assert result.stdout == "collektive: text: unset\n"


def test_pages_have_no_grammar_errors() -> None:
    assert_clean("node", "scripts/checks/prose.mjs", *pages(), tools="prose")


def habits(place: str, prose: str, line: int = 1) -> list[str]:
    """Returns a message for each match of a pattern of english.txt in `prose`, which begins at `line` of the file `place`."""
    return [f"{place}:{line + prose[:match.start()].count(chr(10))}: {match[0]!r}: {advice}"
            for pattern, advice in HABITS for match in re.finditer(pattern, prose, re.IGNORECASE)]


def test_pages_avoid_the_habits_of_english_txt() -> None:
    code = re.compile(r"^( *)```.*?^\1```|`[^`\n]*`", re.DOTALL | re.MULTILINE)
    found = [habit for page in pages() for habit in habits(page, code.sub(lambda block: "\n" * block[0].count("\n"), (ROOT / page).read_text()))]
    assert not found, "\n".join(found)


PLACES = [
    "CMakeLists.txt",
    "cmake/*",
    "experiments/*",
    "gradle/*",
    "jvm-host/*",
    "native-shim/*",
    "schema/*",
    "scripts/*",
    "tools/*",
    "unity/*",
]


def test_messages_and_comments_avoid_the_habits_of_english_txt() -> None:
    found = [habit for source in messages.sources(PLACES) for line, is_comment, text in messages.texts(ROOT / source)
             if is_comment or messages.is_message(text) for habit in habits(source, text, line)]
    assert not found, "\n".join(found)
