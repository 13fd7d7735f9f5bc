"""Random data of the test schemas from C# to Kotlin and back: each side prints what it wrote, the other compares what it read.

Run by `./collektive test roundtrip`, which builds both halves.
"""
import os
import re
import subprocess

import pytest

SCHEMAS = ["blocks.Blocks", "features.Features", "globals.Globals"]
RECORDS, SEED = "500", "1"


def csharp(*words):
    return ["mono-sgen", os.environ["ROUNDTRIP_CSHARP"], *words]


def kotlin(*words):
    return [os.environ["ROUNDTRIP_JAVA"], "-cp", os.environ["ROUNDTRIP_CLASSES"], "org.collektive.frames.data.RoundTrip", *words]


@pytest.mark.parametrize("writer, reader", [(csharp, kotlin), (kotlin, csharp)], ids=["to Kotlin", "to C#"])
@pytest.mark.parametrize("schema", SCHEMAS)
def test_what_one_side_writes_the_other_reads(schema, writer, reader, tmp_path):
    name, file = f"test.{schema}Schema", str(tmp_path / "data")
    subprocess.run(writer("write", name, file, RECORDS, SEED), check=True)
    read = subprocess.run(reader("read", name, file), check=True, capture_output=True, text=True).stdout
    records, different = map(int, re.search(r"(\d+) passed, (\d+) failed$", read.strip()).groups())
    assert records >= int(RECORDS)
    assert different == 0, read
