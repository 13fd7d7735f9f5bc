"""Parses JSON with the player's extensions, and records the line of each value."""
import bisect
import json
import math
import os
import re
from typing import Any, NoReturn

Path = tuple[str | int, ...]

MAX_DEPTH = 64
"""The maximum nesting of objects and lists, which is the same in the player."""
MAX_DIGITS = 300
# Possessive quantifiers, because others need 120 bytes of memory for each character.
SPACE = re.compile(r"(?:\s++|//[^\n]*+|/\*.*?\*/)*+", re.S)
STRING = re.compile(r'"(?:[^"\\]++|\\.)*+"', re.S)
QUOTED = re.compile(r"'(?:[^'\\]++|\\.)*+'", re.S)
NAME = re.compile(r"[A-Za-z_$][\w$]*")
NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)?(?![\w.])")
LITERALS = {"true": True, "false": False, "null": None}


class ExperimentError(Exception):
    """An error in the user's input. If the error is in a file, the message names the file and the line."""


class Located:
    """
    The content of a JSON file, and the lines of its values.

    Like the player, this accepts comments, trailing commas, single quotes, unquoted keys and a byte-order mark. Duplicate keys are errors.
    """

    def __init__(self, path: str):
        self.path = path
        # Only files are read, because reading a pipe may never end.
        if os.path.exists(path) and not os.path.isfile(path):
            raise ExperimentError(f"'{path}' cannot be read: it is not a file")
        try:
            with open(path, encoding="utf-8-sig") as file:
                self.text = file.read()
        except OSError as error:
            raise ExperimentError(f"'{path}' cannot be read: {error.strerror}") from error
        except UnicodeDecodeError as error:
            raise ExperimentError(f"'{path}' is not a JSON file: it is not UTF-8") from error
        self._starts = [match.end() for match in re.finditer("\n", self.text)]
        self._lines: dict[Path, int] = {}
        self.root, end = self._value(self._skip(0), ())
        if self._skip(end) < len(self.text):
            self._fail(self._skip(end), "unexpected text after the value")

    def error(self, message: str, *place: str | int) -> ExperimentError:
        """Returns an error with the line of a value. If the value does not exist, uses the line of the object or list that would contain it."""
        while place and place not in self._lines:
            place = place[:-1]
        return ExperimentError(f"{self.path}:{self._lines.get(place, 1)}: {message}")

    def _line(self, at: int) -> int:
        return bisect.bisect_right(self._starts, at) + 1

    def _fail(self, at: int, problem: str) -> NoReturn:
        raise ExperimentError(f"{self.path}:{self._line(at)}: not valid JSON: {problem}")

    def _skip(self, at: int) -> int:
        """Returns the index of the next token."""
        match = SPACE.match(self.text, at)
        assert match
        return match.end()

    def _value(self, at: int, place: Path) -> tuple[Any, int]:
        """Returns the value that begins at an index, and the index after its end."""
        if len(place) > MAX_DEPTH:
            self._fail(at, f"more than {MAX_DEPTH} levels of objects and lists")
        self._lines[place] = self._line(at)
        start = self.text[at:at + 1]
        if start and start in "{[":
            return self._container(at, place)
        if start and start in "\"'":
            return self._string(at)
        if number := NUMBER.match(self.text, at):
            return self._number(number), number.end()
        name = NAME.match(self.text, at)
        if name is None or name[0] not in LITERALS:
            self._fail(at, f"unexpected {start!r}" if start else "unexpected end of file")
        return LITERALS[name[0]], name.end()

    def _container(self, at: int, place: Path) -> tuple[Any, int]:
        pairs: dict[str, Any] = {}
        items: list[Any] = []
        is_object = self.text[at] == "{"
        end = "}" if is_object else "]"
        at = self._skip(at + 1)
        while not self.text.startswith(end, at):
            if is_object:
                key_at = at
                key, at = self._key(at)
                if key in pairs:
                    raise ExperimentError(f"{self.path}:{self._line(key_at)}: the key '{key}' is used twice")
                at = self._skip(at)
                if not self.text.startswith(":", at):
                    self._fail(at, "expected ':'")
                pairs[key], at = self._value(self._skip(at + 1), (*place, key))
            else:
                item, at = self._value(at, (*place, len(items)))
                items.append(item)
            at = self._skip(at)
            if self.text.startswith(",", at):
                at = self._skip(at + 1)
            elif not self.text.startswith(end, at):
                self._fail(at, f"expected ',' or '{end}'")
        return pairs if is_object else items, at + 1

    def _key(self, at: int) -> tuple[str, int]:
        if self.text[at:at + 1] in ("'", '"'):
            return self._string(at)
        name = NAME.match(self.text, at)
        if name is None:
            self._fail(at, "expected a key")
        return name[0], name.end()

    def _string(self, at: int) -> tuple[str, int]:
        match = (STRING if self.text[at] == '"' else QUOTED).match(self.text, at)
        if match is None:
            self._fail(at, "unterminated string")
        text = match[0]
        if text[0] == "'":
            text = '"' + re.sub(r"\\.|\"", lambda found: {"\\'": "'", '"': '\\"'}.get(found[0], found[0]), text[1:-1], flags=re.S) + '"'
        try:
            value: str = json.loads(text, strict=False)
            value.encode()
        except UnicodeEncodeError:
            self._fail(at, f"{match[0][:50]} contains an unpaired surrogate")
        except ValueError as error:
            self._fail(at, str(error))
        return value, match.end()

    def _number(self, match: re.Match[str]) -> int | float:
        if len(match[0]) > MAX_DIGITS:
            self._fail(match.start(), f"a number has {len(match[0]):,} characters; the maximum is {MAX_DIGITS}")
        if not math.isfinite(float(match[0])):
            self._fail(match.start(), f"{match[0][:50]} is too large")
        return float(match[0]) if match[1] or match[2] else int(match[0])
