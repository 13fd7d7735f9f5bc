"""Finds the code blocks in pages, and assigns each block to a kind of test."""
import glob
import os
import re
import textwrap
from dataclasses import dataclass

from build.places import ROOT

FENCE = re.compile(r'(?m)^( *)```(\w*)(?: title="([^"]+)")?\n(.*?)^\1```$', re.S)
STORIES = ["Documentation~/without-unity.md", "Documentation~/first-study.md",
           # tutorial-live.md is missing here, because the suite live tests it.
           *sorted(os.path.relpath(path, ROOT) for path in glob.glob(os.path.join(ROOT, "Documentation~/tutorial-*.md")) if "tutorial-live" not in path)]
PROJECTS = ["README.md", "Documentation~/getting-started.md", "Documentation~/first-swarm-in-unity.md"]
PAGES = sorted(os.path.relpath(path, ROOT) for pattern in ("*.md", "docs/*.md", "Documentation~/*.md") for path in glob.glob(os.path.join(ROOT, pattern)))


@dataclass(frozen=True)
class Block:
    page: str
    line: int
    language: str
    title: str
    text: str

    @property
    def place(self):
        return f"{self.page}:{self.line}"

    @property
    def kind(self):
        """The kind of test for this block, or an empty string if no test covers it."""
        kinds = {
            "story": self.page in STORIES and (self.title or self.language in ("sh", "text")),  # test_stories.py
            "project": self.page in PROJECTS and self.language in ("fbs", "kotlin", "csharp"),  # test_readme.py and test_pages.py
            "fragment": self.page.startswith("Documentation~/") and self.language in ("csharp", "fbs", "json", "kotlin"),  # test_fragments.py
            "contract": self.page == "docs/boundary.md" and self.language == "java",  # test_blocks.py
            "command": self.language in ("sh", "console"),  # test_blocks.py
            "diagram": self.language == "mermaid",  # scripts/tests/site.mjs
            "study": self.page == "Documentation~/experiments.md" and self.language == "python",  # experiments/tests/test_sweep.py
        }
        return next((kind for kind, holds in kinds.items() if holds), "")


def blocks(page):
    with open(os.path.join(ROOT, page)) as file:
        text = file.read()
    return [Block(page, text.count("\n", 0, found.start()) + 1, found[2], found[3] or "", textwrap.dedent(found[4])) for found in FENCE.finditer(text)]


def of_kind(kind):
    return [block for page in PAGES for block in blocks(page) if block.kind == kind]
