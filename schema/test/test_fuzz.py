"""Runs a short, reproducible batch of random schemas and the corpus."""
from pathlib import Path

import fuzz

SEED = 1
SCHEMAS = 8


def test_random_schemas_are_rejected_with_a_line_or_their_data_round_trips(tmp_path: Path) -> None:
    accepted, rejected, findings = fuzz.batch(str(tmp_path / "batch"), SEED, SCHEMAS)
    print(f"seed {SEED}, {SCHEMAS} random schemas and those of the corpus: {accepted} accepted, {rejected} rejected")
    assert findings == []
    assert accepted >= SCHEMAS / 4
    assert rejected > 0
