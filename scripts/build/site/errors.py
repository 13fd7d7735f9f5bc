"""The site's page of errors: codes of the native library, checks of the compiler plugin, exit codes of ./collektive, faults that the tests cause."""
import json
import re
from collections.abc import Iterator

from build.site.sources import commands, help_of, text


# By the name of a code in the C header, what to do next. The text of an error names the file, node or setting.
NEXT = {
    "ARGUMENT": "Correct the setting or argument that the text names.",
    "MEMORY": "Close other programs, use fewer nodes or smaller neighbourhoods, or lower the JVM's maximum heap: it shares the memory.",
    "HANDLE": "A script uses a session or slot that is closed. Open a new one.",
    "TIMEOUT": "Raise the limit that the text names, or look for what another call still does.",
    "JVM_NOT_FOUND": "Install a JRE or JDK 17 or newer, or the package's JVM, and name its root in the JVM settings.",
    "JVM_OPTIONS": "Correct the options in the JVM settings; the JVM's own words are in the text.",
    "JVM_START": "Read the JVM's own words in the text; a maximum heap that does not fit the memory is lowered in the JVM settings.",
    "JVM_LOST": "Save, and restart the editor or player. The text says why the JVM ended.",
    "JVM_NOT_RUNNING": "Start the JVM first: the Simulation Manager does so when Play starts.",
    "JVM_RUNNING": "Restart the editor to use the new settings, or take the former ones back.",
    "HOST": "Parts of two versions are mixed: remove the package, restart the editor, install it again.",
    "FRAME": "A sensor, program or script gave what the text names. Correct it; the session goes on.",
    "SCHEMA": "Tools > Collektive > Generate Schema Code, then Rebuild Programs.",
    "PROGRAM": "Build the programs again, or correct the name or jar in the manager; the text lists the programs that there are.",
    "SESSION_FAILED": "Correct the program by the stacks in the console, or raise the step limit; then start the simulation again.",
    "JAVA": "Report it as an issue with the text, which has the stack.",
}


def codes() -> list[tuple[str, str, str]]:
    """Name, number and meaning of each error in the C header."""
    return re.findall(r'X\((\w+), (-\d+), "([^"]+)"\)', text("native-shim/include/collektive_shim.h"))


def bridge_errors() -> dict[str, str]:
    """Name by number in C#."""
    return {number: name for name, number in re.findall(r"(?m)^ +(\w+) = (-\d+),$", text("unity/Runtime/Bridge/BridgeException.cs"))}


def checks() -> Iterator[tuple[str, str, str]]:
    """Name, severity and documentation of each check of the compiler plugin; the documentation is empty where there is none."""
    source = text("jvm-host/compiler-plugin/src/main/kotlin/org/collektive/compiler/checks/AggregateDiagnostics.kt")
    for doc, name, severity in re.findall(r"(?:/\*\*((?:(?!\*/).)*)\*/\s+)?val (\w+) by (error|warning)\d", source, re.S):
        yield name, severity, " ".join(re.sub(r"(?m)^ *\* ?", "", doc).split())


def exit_codes() -> Iterator[tuple[str, list[str]]]:
    """By command, and by "" for all of them, the sentences of its help that begin with `Exit code:`."""
    for command in ["", *commands()]:
        found = re.search(r"(?ms)^Exit code: (.*?)(?:\n\n|\Z)", help_of(*filter(None, [command])))
        if found:
            yield command, " ".join(found[1].split()).removesuffix(".").split("; ")


def errors() -> str:
    """Returns the page."""
    bridge = bridge_errors()
    page = ("# Errors\n\nEach error has a text that says what happened, to what, and what to do next. [Troubleshooting](../troubleshooting.md) is "
            "ordered by these texts; this page lists the kinds.\n\n## Codes\n\n"
            "`BridgeException.Error` in C#; what the functions of the native library return.\n\n"
            "| Code | C# | C | What happened | What to do |\n|---|---|---|---|---|\n")
    for name, number, meaning in codes():
        page += f"| {number} | `{bridge[number]}` | `CLK_{name}` | {meaning} | {NEXT[name]} |\n"
    page += ("\n## Checks of the compiler\n\nWhat the compiler plugin reports about a program. `@Suppress(\"NAME\")` silences a warning.\n\n"
             "| Name | Severity | When, and what to do |\n|---|---|---|\n")
    for name, severity, doc in checks():
        shown = re.sub(r"\[(\w+)\]", r"`\1`", doc)
        page += f"| `{name}` | {severity} | {shown} |\n"
    page += "\n## Exit codes of the command\n\n| Command | Code | Meaning |\n|---|---|---|\n"
    for command, meanings in exit_codes():
        for meaning in meanings:
            code, _, words = meaning.partition(" ")
            page += f"| {f'`{command}`' if command else 'all others'} | {code} | {words} |\n"
    page += ("\n## Faults that were tried\n\nEach is caused by the tests in a process of its own, on each runtime of C# and each JVM: what the user reads, "
             "as a regular expression, and what works afterwards.\n\n| Fault | Message | Afterwards works |\n|---|---|---|\n")
    for fault in json.loads(text("scripts/tests/faults/faults.json")):
        message = f"`{fault['reads']}`".replace("|", "\\|") if "reads" in fault else "none"
        page += f"| {fault['fault']} | {message} | {fault['works']} |\n"
    return page
