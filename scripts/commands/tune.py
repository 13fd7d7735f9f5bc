"""Searches for values of scenario keys with the best mean of a metric, with Optuna. The key "tune" of the experiment file describes the search:
{"metric": "error", "parameters": {"parameters.PROGRAM.gain": {"from": 0.1, "to": 10, "log": true}, "program": ["a", "b"]}}. Each trial executes all
runs of the experiment, for example one per seed. Documentation~/experiments.md describes the key. Writes the runs, study.db (Optuna's storage) and
trials.csv to --out, and prints the best values.

Exit code: 0 the search is complete; 1 it is not, or the experiment file is invalid; 130 Ctrl-C."""
import argparse

from build import experiments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    experiments.option("add_tune_arguments")(parser)


def run(arguments: argparse.Namespace) -> int:
    return experiments.run("tune", *(["ray"] if arguments.ray is not None else []))
