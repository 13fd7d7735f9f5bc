"""Plots the results of a sweep as SVG and PDF files in figures/ in its folder.

With --metric, draws the described figure of each metric: the mean and 95 % interval against a numeric key or over time (line), box plots (box), the
mean for two keys (heat), or the distribution, which for convergence times is the Kaplan-Meier estimate (ecdf). Without options, draws each metric over
time and at the end, the figures of the experiment file, and figures.html with all figures."""
import argparse

from build import experiments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    experiments.option("add_plot_arguments")(parser)


def run(_: argparse.Namespace) -> int:
    return experiments.run(is_sweep=False)
