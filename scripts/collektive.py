"""The command `./collektive`. Each of its commands is a module of the same name in the package `commands`."""
import signal

if __name__ == "__main__":
    # Until `run_in_group` handles Ctrl-C, it ends the process without a traceback.
    signal.signal(signal.SIGINT, signal.SIG_DFL)

import argparse
import errno
import importlib
import os
import re
import resource
import shutil
import sys
from pathlib import Path
from typing import NoReturn

if sys.version_info < (3, 11):  # noqa: UP036 - the syntax of this file is older
    sys.exit(f"collektive: Python 3.11 or newer is needed, and {sys.executable} has version {sys.version.split()[0]}")
sys.path.insert(0, str(Path(__file__).resolve().parent))

from build.console import Failure
from build.places import ROOT

COMMANDS = {
    "setup": "install build dependencies",
    "build": "build targets of this checkout",
    "generate": "generate C#, Java and Kotlin from a FlatBuffers schema",
    "demo": "run the case study without Unity",
    "live": "run a scenario in real time and change its programs in the browser",
    "new": "create a project",
    "check": "check scenarios and experiments before their runs",
    "run": "run a scenario without Unity",
    "repeat": "repeat a run from its manifest and compare the results",
    "sweep": "run a scenario for many parameter values",
    "tune": "search parameter values for the best value of a metric",
    "plot": "plot the results of a sweep",
    "profile": "run a scenario and profile the JVM",
    "replay": "replay a recorded run with its programs or with others",
    "diff": "compare two recorded runs",
    "compare-runtimes": "compare the built-in runtime with Collektive on random networks",
    "test": "build and run tests",
    "bench": "run benchmarks",
    "package": "build the Unity package",
    "site": "build the documentation site",
    "clean": "remove build outputs and caches",
}
EPILOGUE = """Each command first installs, fetches and builds its dependencies. Outputs and caches are in build/.

Exit code: 0 success; 1 failure, with the reason in the last line; 2 unknown command; 130 Ctrl-C."""
# Python, Mono and Node need a stack of this size.
STACK_KB = 1024


class Parser(argparse.ArgumentParser):
    """Reports errors in one line. A command can set their exit code with the default `error_code`."""

    def error(self, message: str) -> NoReturn:
        raise Failure(f"{self.prog.removeprefix('./collektive ')}: {message} (see {self.prog} --help)", self.get_default("error_code") or 1)

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        """Reports unknown arguments with the name of their command."""
        arguments, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unknown argument {unknown[0]}")
        return arguments, unknown


def parser_for(name: str | None) -> Parser:
    """Returns the parser of all commands, with the options of the named one. It does not load the modules of other commands."""
    parser = Parser(prog="./collektive", allow_abbrev=False, epilog=EPILOGUE, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(metavar="COMMAND", dest="command", title="commands")
    for command, summary in COMMANDS.items():
        module = importlib.import_module(f"commands.{command.replace('-', '_')}") if command == name else None
        sub = commands.add_parser(command, help=summary, allow_abbrev=False, description=module.__doc__ if module else None,
                                  formatter_class=argparse.RawDescriptionHelpFormatter)
        if module:
            module.add_arguments(sub)
            sub.set_defaults(run=module.run)
    return parser


def resolve_parents(word: str) -> str:
    """Resolves a path with `..` after a symbolic link, but not in a value of --set. Mono and other tools would remove both, and use another file."""
    if ".." not in word:
        return word
    option, path = re.fullmatch("(--[a-z-]+=)?(.*)", word, re.DOTALL).groups("")  # type: ignore[union-attr]
    folder, name = os.path.split(path)
    try:
        return word if os.path.realpath(os.path.normpath(path)) == os.path.realpath(path) else option + os.path.join(os.path.realpath(folder), name)
    except FileNotFoundError:
        # The current folder was deleted, which `main` reports.
        return word


def main(words: list[str]) -> int:
    """Runs a command line and returns its exit code."""
    if not words or words[0] in ("-h", "--help", "help"):
        parser_for(None).print_help()
        return 0
    if words[0] not in COMMANDS:
        report(Failure(f"unknown command '{words[0]}'"))
        parser_for(None).print_help(sys.stderr)
        return 2
    code = 1
    try:
        # Some commands pass `sys.argv` to another process.
        sys.argv[1:] = words = [resolve_parents(word) for word in words]
        arguments = parser_for(words[0]).parse_args(words)
        code = getattr(arguments, "error_code", code)
        for text in [_current_folder(), *words]:
            if re.search("[\udc80-\udcff]", text):
                raise Failure(f"{text!r} is not UTF-8, which the player and the JVM need: rename the file or folder")
        from build.processes import run_in_group
        return run_in_group(lambda: run_command(arguments))
    except Failure as failure:
        return report(failure, code)
    except OSError as error:
        return report(Failure(f"cannot start a process: {error.strerror}"), code)


def _current_folder() -> str:
    try:
        return os.getcwd()
    except FileNotFoundError as error:
        raise Failure("the current folder was deleted: change to another folder") from error


def run_command(arguments: argparse.Namespace) -> int:
    """Runs a parsed command. Reports a `Failure` or `OSError` and returns its exit code, by default the command's `error_code`."""
    code = getattr(arguments, "error_code", 1)
    try:
        check_environment()
        return int(arguments.run(arguments))
    except Failure as failure:
        return report(failure, code)
    except KeyboardInterrupt:
        return 130
    except OSError as error:
        advice = ""
        if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS) and ROOT in Path(str(error.filename)).parents:
            advice = ": the command must be able to write to its checkout; use a checkout that you own"
        place = f"'{error.filename}': " if error.filename else ""
        return report(Failure(f"{place}{_reason(error)}{advice}"), code)


def _reason(error: OSError) -> str:
    # This error of shutil lists all files that could not be copied.
    if isinstance(error, shutil.Error) and isinstance(error.args[0], list):
        _, target, reason = error.args[0][0]
        return f"cannot write '{target}': {reason}"
    return error.strerror or str(error)


def report(failure: Failure, otherwise: int = 1) -> int:
    """Prints why a command failed and returns the exit code. Escapes control characters, which a terminal would execute."""
    if message := re.sub(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", lambda found: repr(found[0])[1:-1], str(failure)):
        print(f"collektive: {message}", file=sys.stderr)
    return failure.code or otherwise


def open_closed_descriptors() -> None:
    """Opens closed standard descriptors, so that no other file gets their numbers. A closed standard error becomes standard output."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            if descriptor == 2:
                os.dup2(1, 2)
            else:
                os.open(os.devnull, os.O_RDWR)
    sys.stdout = sys.stdout or open(1, "w", closefd=False)
    sys.stderr = sys.stderr or open(2, "w", closefd=False)


def check_environment() -> None:
    """Sets locale and time zone, and checks Mono's options, the stack limit and the path of the checkout."""
    # Names of files are UTF-8, and numbers and times that scenes and programs format do not depend on the user's settings.
    os.environ.update(LC_ALL="C.UTF-8", TZ="UTC")
    # Mono removes quotes and backslashes.
    if re.search(r"(?:^|\s)(?:-O|--optimize)", re.sub(r"[\"'\\]", "", os.environ.get("MONO_ENV_OPTIONS", ""))):
        raise Failure("MONO_ENV_OPTIONS sets optimizations, and some of them change results: remove -O or --optimize")
    stack, _ = resource.getrlimit(resource.RLIMIT_STACK)
    if stack != resource.RLIM_INFINITY and stack < STACK_KB * 1024:
        raise Failure(f"the stack limit is {stack // 1024} KB, and the tools need {STACK_KB} KB: run ulimit -s 8192")
    # ":", ";" and "," separate paths, "mono --aot" passes the path to a shell in double quotes, and CMake rejects definitions with "#".
    for character in ":;,\"$`\\#":
        if character in str(ROOT):
            raise Failure(f"the path of this checkout, '{ROOT}', contains '{character}', which the build tools do not support: move or rename the folder")


if __name__ == "__main__":
    open_closed_descriptors()
    # A reader such as `head` may close the output early.
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main(sys.argv[1:]))
