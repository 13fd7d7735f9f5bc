#!/usr/bin/env python3
"""`changelog.py X.Y.Z` prints the changelog's section of a version, for the notes of its release."""
import os
import re
import sys

from places import ROOT


def section(text: str, version: str) -> str:
    """The text below the version's heading. Raises ValueError when there is none, or nothing below it."""
    found = re.search(rf"(?ms)^## \[{re.escape(version)}\][^\n]*\n(.*?)(?=^## \[|\Z)", text)
    if not found or not found[1].strip():
        raise ValueError(f"CHANGELOG.md has no section [{version}], or nothing in it")
    return found[1].strip() + "\n"


def main() -> None:
    with open(os.path.join(ROOT, "CHANGELOG.md")) as file:
        try:
            print(section(file.read(), sys.argv[1]), end="")
        except ValueError as error:
            sys.exit(f"changelog.py: {error}")


if __name__ == "__main__":
    main()
