"""Runs a scenario for each combination of values in an experiment file: {"version": 1, "scenario": "scenario.json", "vary":
{"fields.nodes": [100, 200], "seed": "1-20"}}. Documentation~/experiments.md describes the file. Writes a folder for each run to --out,
runs.parquet (a row for each run) and series.parquet (a row for each run and simulated second).

Exit code: 0 all runs are complete; 1 some are not, or the experiment file is invalid; 130 Ctrl-C."""
import argparse

from build import experiments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    experiments.option("add_sweep_arguments")(parser)


def run(arguments: argparse.Namespace) -> int:
    # Ray is three times as large as all other packages together.
    return experiments.run(*(["ray"] if arguments.ray is not None else []))
