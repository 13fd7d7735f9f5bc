#!/usr/bin/env python3
"""The sources of the site: `pages.py FOLDER XML MODULES` writes them to FOLDER, an own one.

They are the pages of Documentation~ and docs/, the changelog and its neighbours, and reference pages that are made from the code. XML is the
folder with the C# assemblies' documentation, MODULES has the libraries that pages load. A link to a file that is no page of the site is an error.
"""
import os
import re
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import reference

from places import ROOT

# Titles of sections, and pages in their order: Documentation~ lies at the top of the site, docs/ in `repository`. Pages that are named nowhere, as
# new ones may be, come last in How-to.
SECTIONS = {
    "Start": ["getting-started", "without-unity"],
    "Concepts": ["aggregate-computing", "unity-for-researchers", "way-of-a-tick", "schedules-and-network", "reproducibility"],
    "Tutorials": ["tutorial-first-swarm", "tutorial-own-parts", "tutorial-own-rule", "tutorial-scene-builder", "tutorial-debugging", "tutorial-profiling",
                  "tutorial-experiment", "tutorial-from-collektive"],
    "How-to": ["programs", "sensors-and-actuators", "neighbourhoods", "headless", "jvm-and-jfr", "samples", "from-collektive", "trust", "troubleshooting"],
    "Reference": [*(f"reference/{name}" for name in reference.PAGES)],
    "Explanation": ["repository/architecture", "repository/boundary", "repository/determinism", "repository/record-format", "repository/performance",
                    "repository/disturbances", "repository/decisions", "repository/requirements", "platforms", "limits", "verification"],
    "Project": ["repository/changelog", "repository/contributing", "repository/security", "repository/third-party"],
}
LATE = "How-to"
# Libraries of the pages: what draws diagrams, and what lets the search run in pages from the disk.
LIBRARIES = {"mermaid.js": "@mermaid-js/tiny/dist/mermaid.tiny.js", "iframe-worker.js": "iframe-worker/shim/index.js"}
# Files at the root of the repository that are pages, too.
ROOT_PAGES = {"CHANGELOG.md": "repository/changelog.md", "CONTRIBUTING.md": "repository/contributing.md", "SECURITY.md": "repository/security.md",
              "THIRD-PARTY.md": "repository/third-party.md"}
STYLE = """
/* Wide tables and code scroll in themselves. */
.md-typeset td code, .md-typeset th code { word-break: normal; overflow-wrap: break-word; }
.md-typeset :is(p, li, h1, h2, h3) { overflow-wrap: anywhere; }
.md-grid { max-width: 72rem; }
"""


def places():
    """Where each file of the repository that is part of the site lies in the site."""
    found = {path: place for path, place in ROOT_PAGES.items() if os.path.exists(os.path.join(ROOT, path))}
    for folder, place in [("Documentation~", ""), ("docs", "repository/")]:
        for name in sorted(os.listdir(os.path.join(ROOT, folder))):
            found[f"{folder}/{name}"] = place + name
    return found


def linked(text, path, site):
    """A page's text with its links as they are in the site."""
    def of(target):
        return os.path.relpath(site[target], os.path.dirname(site[path]) or ".")

    def relative(match):
        link, anchor = match[1], match[2] or ""
        target = os.path.normpath(os.path.join(os.path.dirname(path), link))
        if target not in site:
            sys.exit(f"{path}: the link to {link} leads to no page of the site")
        return f"]({of(target)}{anchor})"

    text = re.sub(r"\]\((?!https?:|#)([^)#]+)(#[^)]*)?\)", relative, text)
    # Pages of the package name those of the repository, which it does not contain.
    return re.sub(r"`((?:docs|Documentation~)/[\w-]+\.md)`(\s+(?:in|of)\s+the\s+repository)?",
                  lambda match: f"[{match[1]}]({of(match[1])})" if match[1] in site else match[0], text)


def title(text):
    return re.search(r"(?m)^# (.+)", text)[1]


def main():
    folder, xml, modules = sys.argv[1:]
    site, pages = places(), {}
    for path, place in site.items():
        target = os.path.join(folder, place)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if path.endswith(".md"):
            with open(os.path.join(ROOT, path)) as file:
                pages[place.removesuffix(".md")] = linked(file.read(), path, site)
        else:
            shutil.copy(os.path.join(ROOT, path), target)
    for name, make in reference.PAGES.items():
        pages[f"reference/{name}"] = make(xml)
    for name, text in pages.items():
        target = os.path.join(folder, name + ".md")
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "w") as file:
            file.write(text)
    os.makedirs(os.path.join(folder, "assets"))
    for name, library in LIBRARIES.items():
        shutil.copy(os.path.join(modules, library), os.path.join(folder, "assets", name))
    with open(os.path.join(folder, "assets/site.css"), "w") as file:
        file.write(STYLE)
    write_nav(folder, pages)


def write_nav(folder, pages):
    """The order of the pages, for MkDocs."""
    named = {name for names in SECTIONS.values() for name in names}
    lines = ["INHERIT: mkdocs.yml", "nav:", "  - Home: index.md"]
    for section, names in SECTIONS.items():
        late = sorted(pages.keys() - named - {"index"}) if section == LATE else []
        lines.append(f"  - {section}:")
        lines += [f"      - {title(pages[name])!r}: {name}.md" for name in [*names, *late]]
    with open(os.path.join(os.path.dirname(folder), "site.yml"), "w") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
