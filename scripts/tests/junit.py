"""Results of tests in JUnit's XML, the form that all suites write."""
import os
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass


@dataclass(frozen=True)
class Case:
    """One test that ran. An empty failure means that it passed."""
    name: str
    failure: str = ""
    seconds: float = 0


def read(path: str) -> list[Case]:
    """The tests of a file, without those that were skipped. Raises ValueError when the file holds no results."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise ValueError(f"{path} cannot be read: {error}") from error
    if root.tag not in ("testsuites", "testsuite"):
        raise ValueError(f"{path} holds no results of tests: its root is <{root.tag}>")
    return [_case(element) for element in root.iter("testcase") if not _skipped(element)]


def _skipped(element: ElementTree.Element) -> bool:
    """ctest also says "skipped" of a test whose program is missing."""
    skipped = element.find("skipped")
    return skipped is not None and not (skipped.get("message") or "").startswith("Unable to find executable")


def _case(element: ElementTree.Element) -> Case:
    name = ".".join(part for part in (element.get("classname"), element.get("name")) if part)
    bad = element.find("failure") if element.find("failure") is not None else element.find("error")
    # ctest marks a test without a program by its status alone.
    if bad is None and element.get("status") in (None, "run"):
        return Case(name, "", _seconds(element))
    text = "" if bad is None else bad.get("message") or bad.text or ""
    return Case(name, text.strip() or "failed", _seconds(element))


def _seconds(element: ElementTree.Element) -> float:
    try:
        return float((element.get("time") or "0").replace(",", ""))
    except ValueError:
        return 0


def write(path: str, suite: str, cases: list[Case]) -> None:
    """Writes the results of a suite; the file appears when it is whole."""
    failures = [case for case in cases if case.failure]
    root = ElementTree.Element("testsuite", name=suite, tests=str(len(cases)), failures=str(len(failures)), errors="0", skipped="0")
    for case in cases:
        element = ElementTree.SubElement(root, "testcase", classname=suite, name=case.name, time=f"{case.seconds:.3f}")
        if case.failure:
            ElementTree.SubElement(element, "failure", message=_printable(case.failure.splitlines()[0])).text = _printable(case.failure)
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    ElementTree.ElementTree(root).write(path + ".part", encoding="utf-8", xml_declaration=True)
    os.replace(path + ".part", path)


def _printable(text: str) -> str:
    """XML has no place for control characters."""
    return "".join(character if character in "\n\t" or character >= " " else "?" for character in text)
