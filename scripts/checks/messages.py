"""Prints the user-visible texts in the sources: errors, warnings, log lines, tooltips, menu entries and help.

`build/python/bin/python scripts/checks/messages.py [PATTERN]...` prints the texts of the files that match a pattern, such as 'unity/*.cs'.
"""
import fnmatch
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from pygments import lexers, token

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("*.cs", "*.kt", "*.kts", "*.c", "*.h", "*.py", "*.js", "*.mjs", "*.cmake", "*.java")
TESTS = ("*/tests/*", "*/Tests/*", "*/test/*", "*/TestFramework/*", "*/TestRunner/*", "*/testkit/*", "*/Fuzz/*")
# The characters that may separate two parts of the same text.
GLUE = re.compile(r"[\s+\\$@f]*")


def tokens(path: Path) -> Iterator[tuple[token._TokenType, str]]:
    """Yields the tokens of a source file. Splits C# attributes, such as tooltips, which Pygments returns as one token, into their texts."""
    for sort, value in lexers.get_lexer_for_filename(path.name, stripnl=False).get_tokens(path.read_text(encoding="utf-8")):
        if sort not in token.Name.Attribute:
            yield sort, value
            continue
        for index, part in enumerate(re.split(r'("(?:[^"\\]|\\.)*")', value)):
            yield (token.String if index % 2 else token.Punctuation), part


def texts(path: Path) -> Iterator[tuple[int, bool, str]]:
    """Yields the comments and texts of a source file: the line, whether it is a comment, and the content."""
    line, begin, depth = 1, 1, 0
    kind: str | None = None
    text = ""
    for sort, value in tokens(path):
        is_comment = sort in token.String.Doc or (sort in token.Comment and sort not in token.Comment.Preproc)
        now = "comment" if is_comment else "text" if sort in token.String or depth > 0 else None
        if sort in token.String.Interpol and value in ("{", "${", "}"):
            depth += -1 if value == "}" else 1
            text += "" if value == "}" else "{}"
        elif depth > 0:
            pass
        elif now == kind and now is not None:
            text += value
        elif now is not None or not GLUE.fullmatch(value):
            if kind is not None:
                yield begin, kind == "comment", text
            begin, kind, text = line, now, value
        line += value.count("\n")
    if kind is not None:
        yield begin, kind == "comment", text


def is_message(text: str) -> bool:
    """Returns whether a text counts as a message, that is, has at least three words."""
    return len(re.findall(r"(?<![\w/.{$-])[A-Za-z]{2,}(?![\w/{(=.-]\w)", text)) >= 3


def sources(patterns: list[str]) -> list[str]:
    """Returns the tracked source files that match a pattern, without tests."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", *SOURCES], capture_output=True, text=True, check=True).stdout.split("\0")
    return [path for path in listed if path and not any(fnmatch.fnmatch(f"/{path}", test) for test in TESTS)
            and (not patterns or any(fnmatch.fnmatch(path, pattern) for pattern in patterns))]


if __name__ == "__main__":
    for source in sources(sys.argv[1:]):
        for at, is_comment, words in texts(ROOT / source):
            if not is_comment and is_message(words):
                print(f"{source}:{at}: {' '.join(words.split())}")
