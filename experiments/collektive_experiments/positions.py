"""JSON with the line of each value, for messages."""
import json
from typing import Any

Path = tuple[str | int, ...]


class ExperimentError(Exception):
    """Something in what the user gave is wrong; the message says what and where."""


class Located:
    """A JSON file and the lines of its values; a key given twice is an error."""

    def __init__(self, path: str):
        self.path = path
        try:
            with open(path, encoding="utf-8") as file:
                self.text = file.read()
        except OSError as error:
            raise ExperimentError(f"'{path}' cannot be read: {error.strerror}") from error
        except UnicodeDecodeError as error:
            raise ExperimentError(f"'{path}' is no JSON file: it is not UTF-8") from error
        try:
            self.root: Any = json.loads(self.text)
        except json.JSONDecodeError as error:
            raise ExperimentError(f"{path}:{error.lineno}: not valid JSON: {error.msg}") from error
        self._lines: dict[Path, int] = {}
        self._read(self._skip(0), ())

    def error(self, message: str, *place: str | int) -> ExperimentError:
        """An error at the value of a place, or at the nearest one around it."""
        while place and place not in self._lines:
            place = place[:-1]
        return ExperimentError(f"{self.path}:{self._lines.get(place, 1)}: {message}")

    def _line(self, at: int) -> int:
        return self.text.count("\n", 0, at) + 1

    def _skip(self, at: int) -> int:
        while at < len(self.text) and self.text[at] in " \t\r\n":
            at += 1
        return at

    def _read(self, at: int, place: Path) -> int:
        """Notes the lines of the value that begins there; returns where it ends. The text is known to be JSON."""
        self._lines[place] = self._line(at)
        if self.text[at] not in "{[":
            return json.JSONDecoder().raw_decode(self.text, at)[1]
        is_object = self.text[at] == "{"
        at, index = self._skip(at + 1), 0
        while self.text[at] not in "}]":
            if is_object:
                key, at = json.JSONDecoder().raw_decode(self.text, at)
                if (*place, key) in self._lines:
                    raise ExperimentError(f"{self.path}:{self._line(at)}: the key '{key}' is given twice")
                at = self._skip(self._skip(at) + 1)
            else:
                key, index = index, index + 1
            at = self._skip(self._read(at, (*place, key)))
            if self.text[at] == ",":
                at = self._skip(at + 1)
        return at + 1
