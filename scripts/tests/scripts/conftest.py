"""Fixtures of the tests of the scripts."""
from pathlib import Path

import pytest
from checkout import Checkout


@pytest.fixture
def checkout(tmp_path: Path) -> Checkout:
    """A checkout of its own."""
    return Checkout(tmp_path)
