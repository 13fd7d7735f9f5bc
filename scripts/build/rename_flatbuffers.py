"""Renames the namespace of FlatBuffers in the C# of FOLDER: `rename_flatbuffers.py FOLDER [SOURCE]`. With SOURCE, first replaces FOLDER with a copy of
SOURCE.

With the new namespace, the package also works in projects that contain another copy of FlatBuffers.
"""
import shutil
import sys
from pathlib import Path

folder = Path(sys.argv[1])
if len(sys.argv) > 2:
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(sys.argv[2], folder)
for file in folder.rglob("*.cs"):
    file.write_text(file.read_text(encoding="utf-8-sig").replace("Google.FlatBuffers", "Collektive.FlatBuffers"), encoding="utf-8")
