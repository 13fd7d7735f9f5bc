"""Sends random data of the test schemas from C# to Kotlin and back, and compares written and read data.

`./collektive test roundtrip` builds the programs and runs this test.
"""
import functools
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import compile_schemas
import pytest

SCHEMAS = ["blocks.Blocks", "features.Features", "globals.Globals"]
RECORDS, SEED = "500", "1"


classes = functools.cache(compile_schemas.compile_test_schemas)


def csharp(*words: str) -> list[str]:
    return [*compile_schemas.round_trip_csharp(), *words]


def kotlin(*words: str) -> list[str]:
    return [*compile_schemas.round_trip_kotlin(classes()), *words]


@pytest.mark.parametrize("writer, reader", [(csharp, kotlin), (kotlin, csharp)], ids=["to Kotlin", "to C#"])
@pytest.mark.parametrize("schema", SCHEMAS)
def test_written_data_is_read_back(schema: str, writer: Callable[..., list[str]], reader: Callable[..., list[str]], tmp_path: Path) -> None:
    name, file = f"test.{schema}Schema", str(tmp_path / "data")
    subprocess.run(writer("write", name, file, RECORDS, SEED), check=True)
    read = subprocess.run(reader("read", name, file), check=True, capture_output=True, text=True).stdout
    counts = re.search(r"(\d+) passed, 0 failed$", read.strip())
    assert counts, read
    assert int(counts[1]) >= int(RECORDS)
