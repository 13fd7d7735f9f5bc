"""Fixtures for the tests of the scripts."""
from pathlib import Path

import pytest
from checkout import Checkout


@pytest.fixture
def checkout(tmp_path: Path) -> Checkout:
    """Returns a separate checkout."""
    return Checkout(tmp_path)
