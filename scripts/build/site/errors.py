"""Writes the site's page of errors: codes of the native library, checks of the compiler plugin, exit codes of ./collektive and tested faults."""
import json
import re
from collections.abc import Iterator

from build.site.sources import commands, help_of, text

# The solution for each error code, by its name in the C header.
SOLUTIONS = {
    "ARGUMENT": "Correct the setting or argument in the message.",
    "MEMORY": "Close other programs, use fewer nodes or smaller neighbourhoods, or lower the JVM's maximum heap.",
    "HANDLE": "A script uses a closed session or slot. Open a new one.",
    "TIMEOUT": "Raise the limit in the message, or find the call that blocks.",
    "JVM_NOT_FOUND": "Install a JRE or JDK 17 or newer, or a JVM package, and set its folder in the JVM settings.",
    "JVM_OPTIONS": "Correct the options in the JVM settings. The message contains the JVM's output.",
    "JVM_START": "Read the JVM's output in the message. If the maximum heap exceeds the memory, lower it in the JVM settings.",
    "JVM_LOST": "Save and restart the editor or player. The message contains the reason.",
    "JVM_NOT_RUNNING": "Start the JVM first. The Simulation Manager starts it on Play.",
    "JVM_RUNNING": "Restart the editor to apply the new settings, or revert them.",
    "HOST": "Two versions of the package are mixed. Remove the package, restart the editor and install it again.",
    "FRAME": "Correct the sensor, program or script that passed the value in the message. The session continues.",
    "SCHEMA": "Choose Tools > Collektive > Generate Schema Code, then Rebuild Programs.",
    "PROGRAM": "Rebuild the programs, or correct the name or jar in the manager. The message lists the available programs.",
    "SESSION_FAILED": "Fix the program using the stack traces in the console, or raise the step limit. Then restart the simulation.",
    "JAVA": "Report an issue with the message, which contains the stack trace.",
}


def codes() -> list[tuple[str, str, str]]:
    """Returns the name, number and meaning of each error in the C header."""
    return re.findall(r'X\((\w+), (-\d+), "([^"]+)"\)', text("native-shim/include/collektive_shim.h"))


def bridge_errors() -> dict[str, str]:
    """Returns the names of the errors in C#, by number."""
    return {number: name for name, number in re.findall(r"(?m)^ +(\w+) = (-\d+),$", text("unity/Runtime/Bridge/BridgeException.cs"))}


def checks() -> Iterator[tuple[str, str, str]]:
    """Yields the name, severity and documentation of each check of the compiler plugin."""
    source = text("jvm-host/compiler-plugin/src/main/kotlin/org/collektive/compiler/checks/AggregateDiagnostics.kt")
    for doc, name, severity in re.findall(r"(?:/\*\*((?:(?!\*/).)*)\*/\s+)?val (\w+) by (error|warning)\d", source, re.S):
        yield name, severity, " ".join(re.sub(r"(?m)^ *\* ?", "", doc).split())


def exit_codes() -> Iterator[tuple[str, list[str]]]:
    """Yields the exit codes in the help of each command. The name "" stands for the help of ./collektive itself."""
    for command in ["", *commands()]:
        found = re.search(r"(?ms)^Exit code: (.*?)(?:\n\n|\Z)", help_of(*filter(None, [command])))
        if found:
            yield command, " ".join(found[1].split()).removesuffix(".").split("; ")


def errors() -> str:
    """Returns the page."""
    bridge = bridge_errors()
    page = ("# Errors\n\nThis page lists error codes, checks and exit codes. [Troubleshooting](../troubleshooting.md) lists messages and their "
            "solutions.\n\n## Codes\n\n"
            "Values of `BridgeException.Error` in C#, and return codes of the native library.\n\n"
            "| Code | C# | C | What happened | What to do |\n|---|---|---|---|---|\n")
    for name, number, meaning in codes():
        page += f"| {number} | `{bridge[number]}` | `CLK_{name}` | {meaning} | {SOLUTIONS[name]} |\n"
    page += ("\n## Checks of the compiler plugin\n\n`@Suppress(\"NAME\")` silences a warning.\n\n"
             "| Name | Severity | When, and what to do |\n|---|---|---|\n")
    for name, severity, doc in checks():
        shown = re.sub(r"\[(\w+)\]", r"`\1`", doc)
        page += f"| `{name}` | {severity} | {shown} |\n"
    page += "\n## Exit codes of the command\n\n| Command | Code | Meaning |\n|---|---|---|\n"
    for command, meanings in exit_codes():
        for meaning in meanings:
            code, _, words = meaning.partition(" ")
            page += f"| {f'`{command}`' if command else 'all others'} | {code} | {words} |\n"
    page += ("\n## Tested faults\n\nThe tests cause each fault in a separate process, on each C# runtime and each JVM. Messages are regular expressions.\n\n"
             "| Fault | Message | Still works |\n|---|---|---|\n")
    for fault in json.loads(text("scripts/tests/faults/faults.json")):
        message = f"`{fault['reads']}`".replace("|", "\\|") if "reads" in fault else "none"
        page += f"| {fault['fault']} | {message} | {fault['works']} |\n"
    return page
