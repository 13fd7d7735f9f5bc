"""Copies schemas to OUT with SensorData and ActuatorData swapped, and with the namespace `swapped` instead of `test`: `swap_data.py OUT SCHEMA...`.

With the copies, tests can read the data that sensors write, and write the data that actuators read. The copies keep their paths relative to the folder
of the first schema.
"""
import re
import sys
from pathlib import Path

out, *schemas = map(Path, sys.argv[1:])
for schema in schemas:
    text = schema.read_text()
    for pattern, replacement in (r"\btest\.", "swapped."), (r"\bSensorData\b", "Swap"), (r"\bActuatorData\b", "SensorData"), (r"\bSwap\b", "ActuatorData"):
        text = re.sub(pattern, replacement, text)
    copy = out / schema.relative_to(schemas[0].parent)
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text(text)
