"""The command `./collektive`: declares the commands, and runs one of them. Each is a module of `commands`, with the same name."""
import argparse
import codecs
import errno
import importlib
import locale
import os
import re
import resource
import signal
import sys
from pathlib import Path
from typing import NoReturn

if sys.version_info < (3, 11):  # noqa: UP036 - the syntax of this file is older
    sys.exit(f"collektive: Python 3.11 or newer is needed, and {sys.executable} has version {sys.version.split()[0]}")
sys.path.insert(0, str(Path(__file__).resolve().parent))

from build.console import Failure
from build.places import ROOT

COMMANDS = {
    "setup": "install and fetch what the build needs",
    "build": "build parts of this checkout",
    "generate": "make the code of a user schema (FlatBuffers)",
    "demo": "run the case study without Unity and write pictures, a replay page and tables",
    "run": "run a scenario without Unity",
    "repeat": "repeat a run from its manifest, and compare the results",
    "sweep": "run a scenario with many values of its keys, into tables",
    "plot": "make figures of a sweep",
    "profile": "run a scenario and report where its time goes on the JVM",
    "replay": "run the programs of a recorded run again, or others on its input",
    "diff": "find where two recorded runs differ",
    "test": "build and test everything",
    "bench": "measure what rounds and ticks cost",
    "package": "make the Unity package, a tarball",
    "site": "make the documentation as a site",
    "clean": "remove all build output and caches",
}
EPILOGUE = """Every command first does what it needs: installs, fetches, builds. Caches are kept in build/.

Exit code: 0 it is done; 1 it is not, and the last line says why; 2 unknown command; 130 Ctrl-C."""
# Python, Mono and Node run with this stack.
STACK_KB = 1024


class Parser(argparse.ArgumentParser):
    """A parser whose errors are one line, like those of the commands. A command may choose their code with the default `error_code`."""

    def error(self, message: str) -> NoReturn:
        raise Failure(f"{self.prog.removeprefix('./collektive ')}: {message} (see {self.prog} --help)", self.get_default("error_code") or 1)

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        """Reports unknown arguments as those of the command that they belong to."""
        arguments, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unknown argument {unknown[0]}")
        return arguments, unknown


def parser_for(name: str | None) -> Parser:
    """Returns the parser of all commands, with the options of the named one: the modules of the others are not loaded."""
    parser = Parser(prog="./collektive", allow_abbrev=False, epilog=EPILOGUE, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(metavar="COMMAND", dest="command", title="commands")
    for command, summary in COMMANDS.items():
        module = importlib.import_module(f"commands.{command}") if command == name else None
        sub = commands.add_parser(command, help=summary, allow_abbrev=False, description=module.__doc__ if module else None,
                                  formatter_class=argparse.RawDescriptionHelpFormatter)
        if module:
            module.add_arguments(sub)
            sub.set_defaults(run=module.run)
    return parser


def main(words: list[str]) -> int:
    """Runs a command line and returns its exit code."""
    if not words or words[0] in ("-h", "--help", "help"):
        parser_for(None).print_help()
        return 0
    if words[0] not in COMMANDS:
        print(f"collektive: unknown command '{words[0]}'", file=sys.stderr)
        parser_for(None).print_help(sys.stderr)
        return 2
    try:
        for text in [os.getcwd(), *words]:
            if re.search("[\udc80-\udcff]", text):
                raise Failure(f"{text!r} is not UTF-8, which the player and the JVM need: rename the file or folder")
        arguments = parser_for(words[0]).parse_args(words)
        from build.processes import attended
        return attended(lambda: guarded(arguments))
    except Failure as failure:
        return report(failure)
    except OSError as error:
        return report(Failure(f"cannot start a process: {error.strerror}"))


def guarded(arguments: argparse.Namespace) -> int:
    """Runs a parsed command; a `Failure` or `OSError` becomes a message and an exit code, by default the command's `error_code`."""
    code = getattr(arguments, "error_code", 1)
    try:
        check_surroundings()
        return int(arguments.run(arguments))
    except Failure as failure:
        return report(failure, code)
    except KeyboardInterrupt:
        return 130
    except OSError as error:
        advice = ""
        if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS) and ROOT in Path(str(error.filename)).parents:
            advice = ": the command must be able to write to its checkout; use one that belongs to you"
        place = f"'{error.filename}': " if error.filename else ""
        return report(Failure(f"{place}{error.strerror or error}{advice}"), code)


def report(failure: Failure, otherwise: int = 1) -> int:
    """Prints why a command failed and returns the exit code."""
    if str(failure):
        print(f"collektive: {failure}", file=sys.stderr)
    return failure.code or otherwise


def open_closed_descriptors() -> None:
    """Fills closed standard descriptors, which else the next opened file would take. Messages without a place go to the results."""
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


def check_surroundings() -> None:
    """Makes the tools independent of the caller's shell: an encoding for all file names, and a stack that suffices."""
    if codecs.lookup(locale.getpreferredencoding()).name != "utf-8" or os.environ.get("LC_ALL") in ("C", "POSIX"):
        os.environ["LC_ALL"] = "C.UTF-8"
    stack, _ = resource.getrlimit(resource.RLIMIT_STACK)
    if stack != resource.RLIM_INFINITY and stack < STACK_KB * 1024:
        raise Failure(f"the stack of processes is limited to {stack // 1024} KB, and the tools need {STACK_KB}: ulimit -s 8192")
    for separator in ":;":
        if separator in str(ROOT):
            raise Failure(f"the path of this checkout, '{ROOT}', contains '{separator}', which separates paths for the tools: move or rename the folder")


if __name__ == "__main__":
    open_closed_descriptors()
    # A reader such as `head` may close the output before its end.
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main(sys.argv[1:]))
