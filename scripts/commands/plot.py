"""Plots the metrics of a sweep: the mean and 95 % confidence interval over time for each configuration, and box plots of the final values. Writes
SVG and PDF files to figures/ in the sweep's folder, and figures.html with all figures."""
import argparse

from build import experiments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="FOLDER", help="folder of a sweep")


def run(_: argparse.Namespace) -> int:
    return experiments.run()
