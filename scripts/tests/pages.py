"""Tests pages in a browser: `pages.py page RESULTS` tests replay pages, `pages.py live RESULTS` tests the live page, and `pages.py site RESULTS` tests the
documentation site."""
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import managed, processes
from build.places import BUILD, COLLEKTIVE, CSHARP, NODE_MODULES, ROOT


def run_node(test: Path, results: Path, *words: Path) -> int:
    """Runs a file of Node tests and returns the exit code."""
    reporters = ["--test-reporter=spec", "--test-reporter-destination=stdout", "--test-reporter=junit", f"--test-reporter-destination={results}"]
    return processes.call(["node", *reporters, test, *words], env={**os.environ, "COLLEKTIVE_NODE_MODULES": str(NODE_MODULES)})


def page(results: Path) -> int:
    """Tests the replay page of a demo, and pages of synthetic runs with known content."""
    test = ROOT / "unity/Headless~/Replay/test.mjs"
    code = run_node(test.with_name("unit-test.mjs"), results / "units.xml")
    demo, sample = BUILD / "page-demo", BUILD / "page-sample"
    subprocess.run([COLLEKTIVE, "demo", "--nodes", "60", "--seconds", "10", "--out", demo, "--overwrite"], check=True)
    sample.mkdir(exist_ok=True)
    code = run_node(test, results / "demo.xml", demo / "replay.html") or code
    for name, nodes, ticks in (("replay", "60", "200"), ("large", "10000", "60")):
        file = sample / f"{name}.html"
        subprocess.run(managed.command("mono-sgen", CSHARP / "SampleReplay.exe", BUILD / "replay.html", file, nodes, ticks), check=True)
        code = run_node(test, results / f"{name}.xml", file, file.with_name(f"{file.name}.expected.json")) or code
    return code


def live(results: Path) -> int:
    """Tests the page of a live run. Keeps pictures and logs in build/live-page."""
    return run_node(ROOT / "unity/Headless~/Replay/live-test.mjs", results / "live.xml", COLLEKTIVE, BUILD / "live-page")


def site(results: Path) -> int:
    """Tests the site at three widths, in the light and the dark theme. Keeps pictures in build/site-pictures."""
    subprocess.run([COLLEKTIVE, "site", "--out", BUILD / "site"], check=True)
    return run_node(ROOT / "scripts/tests/site.mjs", results / "site.xml", BUILD / "site", BUILD / "site-pictures")


if __name__ == "__main__":
    sys.exit({"page": page, "live": live, "site": site}[sys.argv[1]](Path(sys.argv[2])))
