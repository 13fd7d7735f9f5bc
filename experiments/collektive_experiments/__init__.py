"""Runs sweeps of Collektive for Unity, and loads, compares and plots their results."""
from .experiment import Experiment, Run, read
from .figure_options import FigureOptions, read_options
from .figures import at_end, draw, over_time, plot
from .positions import ExperimentError
from .results import Results, compare, load
from .statistics import holm, interval, kaplan_meier

__all__ = ["Experiment", "ExperimentError", "FigureOptions", "Results", "Run", "at_end", "compare", "draw", "holm", "interval", "kaplan_meier", "load",
           "over_time", "plot", "read", "read_options"]
