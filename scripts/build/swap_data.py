"""swap_data.py OUT SCHEMA...: copies schemas with SensorData and ActuatorData swapped, into the namespace `swapped` for `test`.

The tests then read what sensors write, and write what actuators read. Paths below the first schema's folder are kept.
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
