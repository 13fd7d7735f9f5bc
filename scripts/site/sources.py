"""Files of the repository that pages of the site are made from."""
import os

from places import ROOT


def text(path):
    with open(os.path.join(ROOT, path)) as file:
        return file.read()
