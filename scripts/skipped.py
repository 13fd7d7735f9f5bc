#!/usr/bin/env python3
"""`skipped.py FOLDER` tells of each file of ctest's results there how many tests ran, and which were skipped for what reason."""
import glob
import os
import re
import sys
import xml.etree.ElementTree as ElementTree


def describe(path: str) -> list[str]:
    cases = list(ElementTree.parse(path).getroot().iter("testcase"))
    skipped = [case for case in cases if case.find("skipped") is not None]
    name = os.path.splitext(os.path.basename(path))[0]
    lines = [f"{name}: {len(cases) - len(skipped)} tests ran, {len(skipped)} were skipped"]
    for case in skipped:
        reason = re.search(r"SKIPPED: (.*)", case.findtext("system-out") or "")
        lines.append(f"  {case.get('name')}: {reason.group(1) if reason else 'it gave no reason'}")
    return lines


if __name__ == "__main__":
    for results in sorted(glob.glob(os.path.join(glob.escape(sys.argv[1]), "*-*64.xml"))):
        print("\n".join(describe(results)))
