"""Reads prefabs, scenes, materials and assets, which Unity writes as YAML with one document per object."""
import re
from dataclasses import dataclass
from typing import Any

import yaml


class UnityYamlError(Exception):
    """An error in a file. The message begins with the number of the line."""


@dataclass(frozen=True)
class Document:
    """An object in a file. All scalars of its fields are strings."""
    class_id: int
    file_id: int
    stripped: bool
    type_name: str
    fields: Any
    line: int


HEADER = ["%YAML 1.1", "%TAG !u! tag:unity3d.com,2011:"]
# The first line of an object. The word `stripped` after the anchor is not valid YAML.
OBJECT = re.compile(r"--- !u!(\d+) &(-?\d+)( stripped)?")


class _Loader(yaml.CBaseLoader):
    """A loader that rejects duplicate keys, and flow mappings such as {a} whose keys have no values. PyYAML accepts both."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        keys = []
        for key, value in node.value:
            if key.value in keys or (node.flow_style and not value.value):
                problem = "duplicate key" if key.value in keys else "not 'key: value':"
                raise yaml.MarkedYAMLError(problem=f"{problem} {key.value}", problem_mark=key.start_mark)
            keys.append(key.value)
        return super().construct_mapping(node, deep)


def read(path: str) -> list[Document]:
    """Returns the objects in a file. Raises UnityYamlError if Unity would not write the file in this form."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    if lines[:2] != HEADER:
        raise UnityYamlError(f"1: the first two lines must be {HEADER[0]!r} and {HEADER[1]!r}")
    starts = [number for number, line in enumerate(lines) if line.startswith("---")]
    return [_document(lines[start:end], start + 1) for start, end in zip(starts, starts[1:] + [len(lines)])]


def _document(lines: list[str], line: int) -> Document:
    match = OBJECT.fullmatch(lines[0])
    if not match:
        raise UnityYamlError(f"{line}: not the beginning of an object: {lines[0]}")
    try:
        body = yaml.load("\n".join(["", *lines[1:]]), _Loader)
    except yaml.MarkedYAMLError as error:
        raise UnityYamlError(f"{line + (error.problem_mark.line if error.problem_mark else 0)}: {error.problem}") from error
    if not isinstance(body, dict) or len(body) != 1:
        raise UnityYamlError(f"{line}: an object must have one type")
    (type_name, fields), = body.items()
    return Document(int(match[1]), int(match[2]), bool(match[3]), type_name, fields, line)
