"""Reads the part of YAML that Unity writes: block mappings and sequences, one-line flow mappings, plain and quoted scalars."""
import re


class UnityYamlError(Exception):
    """What is wrong, with the line."""


class Document:
    """One object of a file: its class number, its file id, its type name and its fields."""

    def __init__(self, class_id, file_id, stripped, type_name, fields, line):
        self.class_id = class_id
        self.file_id = file_id
        self.stripped = stripped
        self.type_name = type_name
        self.fields = fields
        self.line = line


HEADER = ["%YAML 1.1", "%TAG !u! tag:unity3d.com,2011:"]
ANCHOR = re.compile(r"^--- !u!(\d+) &(-?\d+)( stripped)?$")
KEY = re.compile(r"^([^\s'\"{\[#-][^:]*):(?: (.*)|)$")


def read(path):
    """The documents of a prefab, scene, material or asset file."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    if lines[:2] != HEADER:
        raise UnityYamlError(f"1: the first two lines must be {HEADER[0]!r} and {HEADER[1]!r}")
    documents = []
    starts = [i for i, line in enumerate(lines) if line.startswith("---")]
    for start, end in zip(starts, starts[1:] + [len(lines)]):
        match = ANCHOR.match(lines[start])
        if not match:
            raise UnityYamlError(f"{start + 1}: not the beginning of an object: {lines[start]}")
        body = block(lines, start + 1, end)
        if not isinstance(body, dict) or len(body) != 1:
            raise UnityYamlError(f"{start + 1}: an object must have one type")
        (type_name, fields), = body.items()
        documents.append(Document(int(match[1]), int(match[2]), bool(match[3]), type_name, fields, start + 1))
    return documents


def block(lines, start, end):
    """The value of the lines from start to end."""
    rows = []
    for number in range(start, end):
        text = lines[number].strip()
        if not text:
            continue
        if rows and unbalanced(rows[-1][1]):
            rows[-1] = (rows[-1][0], rows[-1][1] + " " + text, rows[-1][2])
        else:
            rows.append((len(lines[number]) - len(lines[number].lstrip()), text, number + 1))
    value, rest = parse(rows, 0)
    if rest != len(rows):
        raise UnityYamlError(f"{rows[rest][2]}: wrong indentation: {rows[rest][1]}")
    return value


def unbalanced(text):
    return text.count("{") + text.count("[") > text.count("}") + text.count("]")


def parse(rows, at):
    """A mapping or sequence that begins at row `at`, and the row after it."""
    indent, text, _ = rows[at]
    return sequence(rows, at, indent) if text == "-" or text.startswith("- ") else mapping(rows, at, indent)


def mapping(rows, at, indent):
    result = {}
    while at < len(rows) and rows[at][0] == indent and not rows[at][1].startswith("- "):
        _, text, number = rows[at]
        match = KEY.match(text)
        if not match:
            raise UnityYamlError(f"{number}: not 'key: value': {text}")
        if match[1] in result:
            raise UnityYamlError(f"{number}: the key {match[1]} is given twice")
        at += 1
        if match[2]:
            result[match[1]] = scalar(match[2], number)
        elif at < len(rows) and (rows[at][0] > indent or (rows[at][0] == indent and rows[at][1].startswith("- "))):
            result[match[1]], at = parse(rows, at)
        else:
            result[match[1]] = ""
    return result, at


def sequence(rows, at, indent):
    result = []
    while at < len(rows) and rows[at][0] == indent and rows[at][1].startswith("- "):
        _, text, number = rows[at]
        inner = text[2:].lstrip()
        if KEY.match(inner):
            # The item is a mapping that begins behind the dash.
            rows = rows[:at] + [(indent + len(text) - len(inner), inner, number)] + rows[at + 1:]
            value, at = parse(rows, at)
            result.append(value)
        else:
            result.append(scalar(inner, number))
            at += 1
    return result, at


def scalar(text, number):
    """A flow mapping as dict, a flow sequence as list, everything else as text."""
    if text.startswith("{") and text.endswith("}"):
        result = {}
        for part in text[1:-1].split(","):
            if not part.strip():
                continue
            key, colon, value = part.partition(":")
            if not colon:
                raise UnityYamlError(f"{number}: not 'key: value': {part.strip()}")
            result[key.strip()] = value.strip()
        return result
    if text.startswith("[") and text.endswith("]"):
        return [part.strip() for part in text[1:-1].split(",") if part.strip()]
    if text[0] in "'\"":
        if len(text) < 2 or text[-1] != text[0]:
            raise UnityYamlError(f"{number}: the quotation does not end: {text}")
        return text[1:-1]
    return text
