"""Collects the pages of the site: Documentation~, docs/, the root pages, and reference pages generated from the code."""
import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path

from build.console import Failure
from build.places import ROOT
from build.site import reference

# The sections and their pages in order. Pages of Documentation~ are at the top of the site, and pages of docs/ are in `repository`. Pages that are not
# listed come last in How-to.
SECTIONS = {
    "Start": ["getting-started", "first-swarm-in-unity", "without-unity", "first-study"],
    "Concepts": ["aggregate-computing", "unity-for-researchers", "way-of-a-tick", "schedules-and-network", "reproducibility"],
    "Tutorials": ["tutorial-first-swarm", "tutorial-own-parts", "tutorial-own-rule", "tutorial-scene-builder", "tutorial-live", "tutorial-debugging",
                  "tutorial-profiling", "tutorial-experiment", "tutorial-from-collektive"],
    "How-to": ["programs", "sensors-and-actuators", "neighbourhoods", "headless", "live", "jvm-and-jfr", "where-the-jvm-runs", "samples",
               "from-collektive", "trust", "troubleshooting"],
    "Reference": [*(f"reference/{name}" for name in reference.PAGES)],
    "Explanation": ["repository/architecture", "repository/boundary", "repository/determinism", "repository/record-format", "repository/performance",
                    "repository/disturbances", "repository/decisions", "repository/requirements", "platforms", "limits", "verification"],
    "Project": ["repository/changelog", "repository/contributing", "repository/security", "repository/third-party"],
}
DEFAULT_SECTION = "How-to"
# Libraries of the site's pages. The first one draws diagrams, and the second one makes the search work without a server.
LIBRARIES = {"mermaid.js": "@mermaid-js/tiny/dist/mermaid.tiny.js", "iframe-worker.js": "iframe-worker/shim/index.js"}
# Pages at the root of the repository.
ROOT_PAGES = {"CHANGELOG.md": "repository/changelog.md", "CONTRIBUTING.md": "repository/contributing.md", "SECURITY.md": "repository/security.md",
              "THIRD-PARTY.md": "repository/third-party.md"}
STYLE = """
/* Wide tables and code scroll. */
.md-typeset td code, .md-typeset th code { word-break: normal; overflow-wrap: break-word; }
.md-typeset :is(p, li, h1, h2, h3) { overflow-wrap: anywhere; }
.md-grid { max-width: 72rem; }
"""


def places() -> dict[str, str]:
    """Returns the path in the site of each page, by its path in the repository."""
    found = {path: place for path, place in ROOT_PAGES.items() if os.path.exists(os.path.join(ROOT, path))}
    for folder, place in [("Documentation~", ""), ("docs", "repository/")]:
        for name in sorted(os.listdir(os.path.join(ROOT, folder))):
            found[f"{folder}/{name}"] = place + name
    return found


def rewrite_links(text: str, path: str, site: Mapping[str, str]) -> str:
    """Replaces the links in the text of a page with links that work in the site."""
    def of(target: str) -> str:
        return os.path.relpath(site[target], os.path.dirname(site[path]) or ".")

    def relative(match: re.Match[str]) -> str:
        link, anchor = match[1], match[2] or ""
        target = os.path.normpath(os.path.join(os.path.dirname(path), link))
        if target not in site:
            raise Failure(f"{path}: the link to {link} is broken: the site has no such page")
        return f"]({of(target)}{anchor})"

    text = re.sub(r"\]\((?!https?:|#)([^)#]+)(#[^)]*)?\)", relative, text)
    # Pages in the package only name pages of the repository, because the package does not contain them. In the site, these names become links.
    return re.sub(r"`((?:docs|Documentation~)/[\w-]+\.md)`(\s+(?:in|of)\s+the\s+repository)?",
                  lambda match: f"[{match[1]}]({of(match[1])})" if match[1] in site else match[0], text)


def title(text: str) -> str:
    return str(re.findall(r"(?m)^# (.+)", text)[0])


def write(folder: Path, modules: Path) -> None:
    """Writes the pages and the MkDocs configuration site.yml to a folder. `modules` is the folder of the libraries that pages load.

    Raises `Failure` if a link is broken.
    """
    site = places()
    pages: dict[str, str] = {}
    for path, place in site.items():
        if path.endswith(".md"):
            pages[place.removesuffix(".md")] = rewrite_links((ROOT / path).read_text(), path, site)
        else:
            target = folder / "pages" / place
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / path, target)
    pages |= {f"reference/{name}": make() for name, make in reference.PAGES.items()}
    for name, text in pages.items():
        target = folder / f"pages/{name}.md"
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    assets = folder / "pages/assets"
    assets.mkdir()
    for name, library in LIBRARIES.items():
        shutil.copy(modules / library, assets / name)
    (assets / "site.css").write_text(STYLE)
    shutil.copy(Path(__file__).with_name("mkdocs.yml"), folder)
    # The navigation lists the pages in the order of SECTIONS.
    named = {name for names in SECTIONS.values() for name in names}
    lines = ["INHERIT: mkdocs.yml", "nav:", "  - Home: index.md"]
    for section, names in SECTIONS.items():
        late = sorted(pages.keys() - named - {"index"}) if section == DEFAULT_SECTION else []
        lines.append(f"  - {section}:")
        lines += [f"      - {title(pages[name])!r}: {name}.md" for name in [*names, *late]]
    (folder / "site.yml").write_text("\n".join(lines) + "\n")
