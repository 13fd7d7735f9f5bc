"""The fields that Unity serialises of each component and asset class, as Collektive.SerializedFields.exe prints them."""


class ScriptClass:
    """One class: its full name, `component` or `asset`, and its fields' kinds by path."""

    def __init__(self, name: str, kind: str) -> None:
        self.name = name
        self.kind = kind
        self.fields: dict[str, str] = {}


def parse(text: str) -> dict[str, ScriptClass]:
    """The classes by full name."""
    classes: dict[str, ScriptClass] = {}
    for line in text.splitlines():
        words = line.split()
        if words[0] == "class":
            current = ScriptClass(words[1], words[2])
            classes[words[1]] = current
        else:
            current.fields[words[0]] = words[1]
    return classes
