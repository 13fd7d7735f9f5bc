"""Makes figures of a sweep's tables, in its folder: for each metric its mean and 95 % interval over time for each configuration, and box plots of
its values at the end, as SVG and PDF in figures/, and all of them in figures.html."""
import argparse

from build import experiments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="FOLDER", help="folder of a sweep")


def run(_: argparse.Namespace) -> int:
    return experiments.run()
