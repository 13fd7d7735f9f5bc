"""Distributes the tests to workers."""
import pytest
from xdist.scheduler import LoadScopeScheduling


class Scheduling(LoadScopeScheduling):
    """A scheduler that lets one worker run all tests of a class that builds a package.

    The class exists because the groups of pytest-xdist 3.8 have no effect in pytest 9.2.
    """

    def _split_scope(self, nodeid: str) -> str:
        return nodeid.rpartition("::")[0] if "/test_package.py::" in nodeid else nodeid


def pytest_xdist_make_scheduler(config: pytest.Config, log) -> LoadScopeScheduling:
    return Scheduling(config, log)
