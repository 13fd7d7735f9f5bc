"""Reads files of the repository and help texts of commands, for reference pages."""
import os
import re
import subprocess

from build.places import COLLEKTIVE, ROOT

# The width of help texts, which must not depend on the terminal.
WIDTH = "120"


def text(path: str) -> str:
    """Returns the text of a file of the repository."""
    return (ROOT / path).read_text()


def commands() -> list[str]:
    """Returns the names of the commands."""
    return re.findall(r"(?m)^    ([a-z-]+)(?: {2,}\S|$)", help_of())


def help_of(*command: str) -> str:
    """Returns the help of ./collektive, or of one of its commands."""
    return subprocess.run([COLLEKTIVE, *command, "--help"], stdout=subprocess.PIPE, text=True, check=True, env={**os.environ, "COLUMNS": WIDTH}).stdout
