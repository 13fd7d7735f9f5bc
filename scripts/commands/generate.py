"""Generates C# from a FlatBuffers schema into --csharp, and Java and Kotlin into --jvm. `./collektive run` generates code by itself. Schemas may
include "types.fbs" for types such as Vector3."""
import argparse
from pathlib import Path

from build import graph, inputs, processes, projects
from build.console import Failure, print_progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("schema", type=Path, metavar="SCHEMA.fbs")
    parser.add_argument("--csharp", type=Path, metavar="DIR", help="folder for C# (default without --jvm: Generated beside the schema)")
    parser.add_argument("--jvm", type=Path, metavar="DIR", help="folder for Java and Kotlin")


def run(arguments: argparse.Namespace) -> int:
    schema: Path = arguments.schema
    if not schema.is_file():
        raise Failure(f"generate: '{schema}' {'is not a file: name a schema' if schema.exists() else 'does not exist'}")
    inputs.schema(schema)
    outputs = {"--csharp": arguments.csharp, "--jvm": arguments.jvm}
    if not any(outputs.values()):
        outputs["--csharp"] = schema.parent / "Generated"
    chosen = {option: folder for option, folder in outputs.items() if folder}
    graph.build("jvm")
    code = processes.call(projects.generator(schema, *(word for pair in chosen.items() for word in pair)))
    if code == 0:
        print_progress("generated " + " and ".join(f"{'C#' if option == '--csharp' else 'Java and Kotlin'} into {folder}" for option, folder in chosen.items()))
    return code
