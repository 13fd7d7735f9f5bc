"""Sweeps, tables and figures of Collektive for Unity."""
from .experiment import Experiment, Run, read
from .figures import at_end, over_time, plot
from .positions import ExperimentError
from .results import Results, compare, interval, load

__all__ = ["Experiment", "ExperimentError", "Results", "Run", "at_end", "compare", "interval", "load", "over_time", "plot", "read"]
