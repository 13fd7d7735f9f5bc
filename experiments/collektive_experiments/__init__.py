"""Runs sweeps of Collektive for Unity, and loads, compares and plots their results."""
import importlib
from typing import TYPE_CHECKING, Any

from .experiment import Experiment, Run, read
from .figure_options import FigureOptions, read_options
from .positions import ExperimentError

if TYPE_CHECKING:
    from .figures import at_end, draw, over_time, plot
    from .results import Results, compare, load
    from .statistics import holm, interval, kaplan_meier

__all__ = ["Experiment", "ExperimentError", "FigureOptions", "Results", "Run", "at_end", "compare", "draw", "holm", "interval", "kaplan_meier", "load",
           "over_time", "plot", "read", "read_options"]

# Loaded on first use, because their imports (Matplotlib and pandas) take longer than all other imports of a sweep.
_LAZY = {name: module for module, names in {"figures": ("at_end", "draw", "over_time", "plot"), "results": ("Results", "compare", "load"),
                                            "statistics": ("holm", "interval", "kaplan_meier")}.items() for name in names}


def __dir__() -> list[str]:
    return __all__


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_LAZY[name]}"), name)
