"""What Unity serialises of each component and asset class, as Collektive.SerializedFields.exe prints it."""


class ScriptClass:
    """One class: its full name, `component` or `asset`, and its fields' kinds by path."""

    def __init__(self, name, kind) -> None:
        self.name = name
        self.kind = kind
        self.fields = {}


def parse(text):
    """The classes by full name."""
    classes = {}
    current = None
    for line in text.splitlines():
        words = line.split()
        if words[0] == "class":
            current = classes[words[1]] = ScriptClass(words[1], words[2])
        else:
            current.fields[words[0]] = words[1]
    return classes
