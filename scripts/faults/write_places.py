#!/usr/bin/env python3
"""write_places.py FILE NAME=VALUE...: writes what faults.py and exits.py read. The values of `runtimes` and `jdks` are lists, one entry a line."""
import json
import sys

LISTS = ("runtimes", "jdks")


def places(words: list[str]) -> dict:
    values = dict(word.split("=", 1) for word in words)
    return {name: value.splitlines() if name in LISTS else value for name, value in values.items()} | {"jobs": 2}


if __name__ == "__main__":
    with open(sys.argv[1], "w") as file:
        json.dump(places(sys.argv[2:]), file)
