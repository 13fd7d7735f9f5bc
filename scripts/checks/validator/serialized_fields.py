"""Reads the output of Collektive.SerializedFields.exe: the fields that Unity serialises for each component and asset class."""


class ScriptClass:
    """A class: its full name, whether it is a `component` or an `asset`, and the kinds of its fields by path."""

    def __init__(self, name: str, kind: str) -> None:
        self.name = name
        self.kind = kind
        self.fields: dict[str, str] = {}


def parse(text: str) -> dict[str, ScriptClass]:
    """Returns the classes by full name."""
    classes: dict[str, ScriptClass] = {}
    for line in text.splitlines():
        words = line.split()
        if words[0] == "class":
            current = ScriptClass(words[1], words[2])
            classes[words[1]] = current
        else:
            current.fields[words[0]] = words[1]
    return classes
