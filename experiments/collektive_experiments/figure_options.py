"""Checks requests for figures, which are options of ./collektive plot or elements of `figures` in experiment files."""
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .positions import ExperimentError

KEYS = ("metric", "x", "by", "kind", "log", "range", "size", "style")
KINDS = ("line", "box", "heat", "ecdf")
STYLES = ("plain", "ieee", "acm")
LOGS = ("x", "y", "xy")
TIME = "time"
"""The value of `x` for a figure over simulated time."""
CONVERGED = "converged."
"""The prefix of columns with convergence times."""
CENSORED = "censored."
"""The prefix of columns that contain, for runs that did not converge, the last time at which convergence could have been observed."""
MAX_GROUPS = 10
"""The maximum number of lines in a figure. More lines could not be distinguished."""
MIN_INCHES, MAX_INCHES = 1, 20
SIZE = re.compile(r"([0-9.]{1,9})x([0-9.]{1,9})")

Fail = Callable[[str, str], ExperimentError]
"""A function that returns the error for an option and a description of the problem."""


@dataclass(frozen=True)
class FigureOptions:
    """A request for a figure of each of its metrics."""
    metrics: tuple[str, ...]
    x: str | None
    by: str | None
    kind: str
    log: str
    range: tuple[float | None, float | None]
    """The limits of the metric's axis. None stands for the limit of the data."""
    size: tuple[float, float]
    """The width and height in inches."""
    style: str
    fail: Fail


def _fail(option: str, problem: str) -> ExperimentError:
    return ExperimentError(f"'{option}' {problem}")


def read_options(given: Mapping[str, Any], fail: Fail = _fail) -> FigureOptions:
    """Reads the given options. Checks everything except the names of keys and metrics."""
    for option, value in given.items():
        if option not in KEYS:
            raise fail(option, f"is unknown; known here: {', '.join(KEYS)}")
        if option != "metric" and not isinstance(value, str):
            raise fail(option, "must be a string")
    metrics = given.get("metric")
    metrics = [metrics] if isinstance(metrics, str) else metrics
    if not isinstance(metrics, list) or not metrics or not all(isinstance(name, str) and name for name in metrics):
        raise fail("metric", "must name at least one metric")
    for index, name in enumerate(metrics):
        if name in metrics[:index]:
            raise fail("metric", f"contains '{name}' twice")
    kind, style, log = (_choice(given, option, choices, fail) for option, choices in (("kind", KINDS), ("style", STYLES), ("log", LOGS)))
    kind = kind or "line"
    x, by = given.get("x"), given.get("by")
    if x is None and kind == "line":
        x = TIME
    _check_axes(kind, x, by, fail)
    allowed = {"line": "xy", "box": "y", "heat": "", "ecdf": "x"}[kind]
    for axis in log:
        if axis not in allowed:
            raise fail("log", f"is '{log}', but the {axis} axis of the kind '{kind}' cannot be logarithmic")
    limits = _range(given["range"], fail) if "range" in given else (None, None)
    if ("x" if kind == "ecdf" else "y") in log and any(limit is not None and limit <= 0 for limit in limits):
        raise fail("range", f"is '{given['range']}', but a logarithmic axis needs limits above 0")
    size = _size(given["size"], fail) if "size" in given else {"ieee": (3.5, 2.2), "acm": (3.33, 2.2)}.get(style, (3.3, 2.2))
    return FigureOptions(tuple(metrics), x, by, kind, log, limits, size, style or "plain", fail)


def check_keys(options: FigureOptions, varied: Mapping[str, Iterable[Any]]) -> None:
    """Checks that the named keys vary, and that their values suit the kind of figure."""
    known = [key for key in varied if key != "seed"]
    for option, key in (("x", options.x), ("by", options.by)):
        if key is None or (option == "x" and key == TIME):
            continue
        if key == "seed":
            raise options.fail(option, "is 'seed', but runs with different seeds are repetitions; name another key")
        if key not in known:
            extra = [TIME] if option == "x" and options.kind == "line" else []
            raise options.fail(option, f"is '{key}', which does not vary; these vary: {', '.join(known + extra) or 'none'}")
    if options.by is not None and options.kind != "heat" and len(set(map(str, varied[options.by]))) > MAX_GROUPS:
        raise options.fail("by", f"is '{options.by}', which has more than {MAX_GROUPS} values; use it as x, or draw a heat map")
    if options.kind != "line" or options.x in (None, TIME):
        return
    for value in varied[str(options.x)]:
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise options.fail("x", f"is '{options.x}', whose values are not numbers; use the kind 'box'")
        if "x" in options.log and value <= 0:
            raise options.fail("log", f"is '{options.log}', but '{options.x}' has the value {value}, and a logarithmic axis needs values above 0")


def check_metrics(options: FigureOptions, at_end: Sequence[str], over_time: Sequence[str]) -> None:
    """Checks that each named metric exists. For a figure over time, it must have values over time, and otherwise a value at the end of each run."""
    for name in options.metrics:
        if options.x == TIME and name in at_end and name not in over_time:
            raise options.fail("metric", f"is '{name}', which has one value per run; name a key with x, or use the kind 'ecdf'")
        known = over_time if options.x == TIME else at_end
        if name not in known:
            raise options.fail("metric", f"is '{name}', which does not exist; existing metrics: {', '.join(known)}")


def _choice(given: Mapping[str, Any], option: str, choices: tuple[str, ...], fail: Fail) -> str:
    value: str = given.get(option, "")
    if option in given and value not in choices:
        raise fail(option, f"is '{value}'; it must be one of: {', '.join(choices)}")
    return value


def _check_axes(kind: str, x: str | None, by: str | None, fail: Fail) -> None:
    if kind == "ecdf" and x is not None:
        raise fail("x", f"is '{x}', but the horizontal axis of the kind 'ecdf' is the metric; use by")
    if kind in ("box", "heat") and x is None:
        raise fail("x", f"is missing; the kind '{kind}' needs the key of the horizontal axis")
    if kind in ("box", "heat") and x == TIME:
        raise fail("x", f"is '{TIME}', which only the kind 'line' can draw")
    if kind == "heat" and by is None:
        raise fail("by", "is missing; the kind 'heat' needs the key of the vertical axis")
    if x is not None and x == by:
        raise fail("by", f"is '{by}', which is also x; name another key")


def _range(value: str, fail: Fail) -> tuple[float | None, float | None]:
    parts = value.split(":")
    try:
        low, high = (float(part) if part.strip() else None for part in parts)
    except ValueError:
        raise fail("range", f"is '{value}'; it must be one or two limits, such as 0:1, 0: or :1") from None
    if any(limit is not None and not math.isfinite(limit) for limit in (low, high)):
        raise fail("range", f"is '{value}'; its limits must be finite")
    if low is not None and high is not None and low >= high:
        raise fail("range", f"is '{value}'; the first limit must be below the second")
    return low, high


def _size(value: str, fail: Fail) -> tuple[float, float]:
    match = SIZE.fullmatch(value)
    try:
        if match is None:
            raise ValueError
        width, height = float(match[1]), float(match[2])
    except ValueError:
        raise fail("size", f"is '{value}'; it must be a width and a height in inches, such as 3.3x2.2") from None
    if not all(MIN_INCHES <= length <= MAX_INCHES for length in (width, height)):
        raise fail("size", f"is '{value}'; width and height must be from {MIN_INCHES} to {MAX_INCHES} inches")
    return width, height
