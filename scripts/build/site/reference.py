"""Reference pages generated from the code: the command line, errors, settings, and the APIs of C#, Kotlin and C."""
import re
from collections.abc import Callable, Iterator, Mapping
from xml.etree import ElementTree

from build.places import BUILD, JVM
from build.site.errors import errors
from build.site.sources import commands, help_of, text

DOCUMENTATION = BUILD / "documentation"
Documented = Mapping[str | None, ElementTree.Element]



def command_line() -> str:
    page = "# Command line\n\nHelp texts of `./collektive`, which runs on Linux from a clone of the repository.\n"
    page += f"\n```text\n{help_of()}```\n"
    for command in commands():
        page += f"\n## {command}\n\n```text\n{help_of(command).strip()}\n```\n"
    return page


def jvm_settings() -> str:
    """Returns the page of JVM settings."""
    source = re.sub(r'"\s*\+\s*"', "", text("unity/Runtime/Bridge/Jvm/JvmSetting.cs"))
    rows = re.findall(r'new JvmSetting\(\s*nameof\(JvmSettings\.(\w+)\), "([^"]+)",\s*"([^"]+)"(.*?)(?=new JvmSetting|\};)', source, re.S)
    page = ("# JVM settings\n\nFields of a JVM Settings asset in the inspector, and keys of `jvm` in a scenario file. They take effect when the JVM starts. "
            "[JVM and JFR](../jvm-and-jfr.md) explains them.\n\n| Key | Label | Range | Meaning |\n|---|---|---|---|\n")
    for key, label, tooltip, rest in rows:
        span = re.search(r'"(MB|%|)", (\d+), ([\d <]+)', rest)
        limits = f"{span[2]} to {eval_shift(span[3])} {span[1]}" if span else ""
        page += f"| `{key}` | {label} | {limits} | {tooltip} |\n"
    return page


def simulation_settings() -> str:
    """Returns the page of simulation settings. Scenario.cs names the settings that are not keys of a scenario."""
    source = re.sub(r'"\s*\+\s*"', "", text("unity/Runtime/Unity/Manager/SimulationSettings.cs"))
    scenario = text("unity/Headless~/Player/Scenario.cs")
    inspector_only = re.findall(r"nameof\(SimulationSettings\.(\w+)\)", scenario[scenario.index("Shared ="):scenario.index("private readonly JObject root")])
    page = ("# Simulation settings\n\nFields of the Simulation Manager in the inspector. Most are also keys of a scenario file. For the others, "
            "see [Runs without Unity](../headless.md).\n\n| Field | Type | Default | Key of a scenario | Meaning |\n|---|---|---|---|---|\n")
    for tooltip, kind, name, default in re.findall(r'\[Tooltip\("([^"]+)"\)\].*?public ([\w<>]+) (\w+)(?: = ([^;]+))?;', source, re.S):
        key = "" if name in inspector_only else "yes"
        default = re.sub(r"new .*|^f$", "", default.removesuffix("f")) if default else "0" if kind == "float" else ""
        page += f"| `{name}` | `{kind}` | {f'`{default}`' if default else ''} | {key} | {tooltip} |\n"
    return page


def eval_shift(number: str) -> int:
    """Evaluates a number such as `8` or `1 << 20`."""
    base, _, shift = number.partition("<<")
    return int(base) << int(shift or 0)


def c_header() -> str:
    return ("# C header\n\n`native-shim/include/collektive_shim.h`: the interface of the native library. Use it to embed "
            f"the JVM side in another application.\n\n```c\n{text('native-shim/include/collektive_shim.h')}```\n")


def csharp(assembly: str) -> Callable[[], str]:
    def make() -> str:
        documented = {member.get("name"): member for member in ElementTree.parse(DOCUMENTATION / f"{assembly.split('.')[1]}.xml").iter("member")}
        page = f"# C# API: {assembly}\n\nAll public and protected members. Components are in the menu Add Component > Collektive.\n"
        type_name = header = ""
        for line in text(f"unity/Tests/PublicApi/{assembly}.txt").splitlines():
            name, _, kind = line.partition(" : ")
            if re.search(r"\b(class|struct|interface|enum|delegate)\b", kind.split(",")[0]):
                doc = description(documented, "T:" + identifier(name))
                page += f"\n## {without_namespaces(name).replace('<', '&lt;')}\n\n`{without_namespaces(kind)}`\n\n{doc}\n"
                type_name, header = name, "\n| Member | |\n|---|---|\n"
                continue
            member = name.removeprefix(type_name + ".")
            doc = description(documented, *candidates(type_name, member, documented))
            if member == "new()" and not doc:
                continue  # the compiler's
            shown = without_namespaces(member + (" : " + kind if kind else ""))
            page += f"{header}| `{shown}` | {doc} |\n"
            header = ""
        return page
    return make


def identifier(name: str) -> str:
    """Returns a type's name as in XML documentation files: List`1 for List<T>."""
    return re.sub(r"<([^<>]*)>", lambda match: "`" + str(match[1].count(",") + 1), name)


def candidates(type_name: str, member: str, documented: Documented) -> list[str]:
    """Returns possible keys of a member's documentation. The overload with the same parameter types comes first."""
    base = member.split("(")[0].split("<")[0]
    base = "#ctor" if base == "new" else base
    prefix = identifier(type_name) + "." + base
    keys = [key for key in documented if key and re.sub(r"``\d+$", "", key[2:].split("(")[0]) == prefix]
    expected = parameter_types(member)
    return sorted(keys, key=lambda key: parameter_types(key) != expected)


def parameter_types(signature: str) -> list[str]:
    """Returns the types of a signature's parameters, without namespaces."""
    inner = signature.partition("(")[2].partition(")")[0]
    found = []
    for parameter in inner.split(","):
        parts = [part for part in parameter.split() if part not in ("ref", "out", "in", "params")]
        found.append(re.sub(r"[<{`@].*", "", parts[0]).split(".")[-1] if parts else "")
    return found


def description(documented: Documented, *keys: str) -> str:
    for key in keys:
        if key in documented:
            return " ".join(filter(None, (plain_text(documented[key].find(part), label) for part, label in
                                          [("summary", ""), ("returns", "Returns: "), ("remarks", "")]))
                            ) + "".join(f" `{item.get('name')}`: {plain_text(item, '')}" for item in documented[key].iter("param"))
    return ""


def plain_text(element: ElementTree.Element | None, label: str) -> str:
    if element is None:
        return ""
    parts = [element.text or ""]
    for child in element:
        reference = child.get("cref") or child.get("name") or child.get("langword") or child.text or ""
        parts += [f"`{last_part(re.sub('^.:', '', reference).split('(')[0])}`", child.tail or ""]
    return label + " ".join("".join(parts).split()).replace("|", "\\|")


def last_part(name: str) -> str:
    name = re.sub(r"``?\d+", "", name)
    return re.sub(r"\b(?:[A-Za-z_]\w*\.)+(?=[A-Z_a-z]\w*$|\w+<)", "", name)


ALIASES = {"Void": "void", "Boolean": "bool", "Single": "float", "Double": "double", "Int32": "int", "UInt32": "uint", "Int64": "long", "UInt64": "ulong",
           "String": "string", "Object": "object", "Byte": "byte"}


def without_namespaces(signature: str) -> str:
    """Returns a signature without namespaces, with C#'s keywords for types."""
    signature = re.sub(r"\b(?:System|Collektive|UnityEngine|org)\.(?:\w+\.)*(?=\w)", "", signature)
    return re.sub(r"\b(" + "|".join(ALIASES) + r")\b", lambda match: ALIASES[match[1]], signature).replace("|", "\\|")


PUBLIC = re.compile(r"^(\s*)(?:@\w+(?:\([^)]*\))?\s+)*public\s+(?!(?:final |open )?override\b|companion object)(.*)")


def kotlin(module: str, about: str, packages: str = "") -> Callable[[], str]:
    """Returns a function that writes the page of a module's public declarations."""
    def make() -> str:
        page = f"# Kotlin API: {module}\n\n{about}\n"
        for path in sorted((JVM / module / "src/main/kotlin" / packages).rglob("*.kt")):
            source = path.read_text()
            found = list(declarations(source.splitlines()))
            if found:
                package = re.findall(r"(?m)^package (.+)$", source)[0]
                page += f"\n## {path.stem}\n\n`{package}`\n"
            for signature, doc in found:
                page += f"\n```kotlin\n{signature}\n```\n\n{doc}\n"
        return page
    return make


def declarations(lines: list[str]) -> Iterator[tuple[str, str]]:
    """Yields the signatures of public declarations and their documentation as Markdown."""
    doc: list[str] = []
    at = 0
    while at < len(lines):
        if lines[at].lstrip().startswith("/**"):
            end = next(number for number in range(at, len(lines)) if "*/" in lines[number])
            doc, at = lines[at:end + 1], end + 1
            continue
        declared = PUBLIC.match(lines[at])
        if declared:
            signature: list[str] = []
            depth = 0
            while True:
                signature.append(lines[at].removeprefix(declared[1]))
                depth += sum(map(lines[at].count, "([")) - sum(map(lines[at].count, ")]"))
                if depth <= 0 or at + 1 == len(lines):
                    break
                at += 1
            # Without the body.
            signature[-1] = re.sub(r"(\)(?:: [\w<>?, .*()-]+)?) (?:=(?!=)|\{).*$", r"\1", signature[-1])
            yield re.sub(r"\s*[{=:]?\s*$", "", "\n".join(signature)), kdoc_as_markdown(doc)
        if lines[at].strip() and not lines[at].lstrip().startswith(("@", "//", "context(")):
            doc = []
        at += 1


def kdoc_as_markdown(lines: list[str]) -> str:
    """Converts KDoc to Markdown: tags become a list, references become code."""
    plain_lines = [re.sub(r"^\s*/?\*{1,2}/? ?", "", line).removesuffix("*/").rstrip() for line in lines]
    body: list[str] = []
    fenced = False
    for line in plain_lines:
        fenced ^= line.startswith("```")
        if not fenced:
            line = re.sub(r"^@(?:property|param) (\w+)", r"- `\1`:", re.sub(r"^@(throws|return|see)\b", r"- *\1*", line))
            line = re.sub(r"\[([\w.]+)\](?!\()", r"`\1`", line)
        if line.startswith("- ") and body and body[-1] and not body[-1].startswith("- "):
            body.append("")
        body.append(line)
    return "\n".join(body).strip()


PAGES: dict[str, Callable[[], str]] = {
    "command-line": command_line,
    "simulation-settings": simulation_settings,
    "jvm-settings": jvm_settings,
    "errors": errors,
    "csharp-unity": csharp("Collektive.Unity"),
    "csharp-bridge": csharp("Collektive.Bridge"),
    "kotlin-api": kotlin("api", "The annotation, device and parameters of programs.", "org/collektive/api"),
    "kotlin-dsl": kotlin("dsl", "Collektive's DSL: primitives, fields, and the API for hosts of programs."),
    "kotlin-stdlib": kotlin("stdlib", "Collektive's standard library and the properties of links, without the lifted operators of Kotlin's library."),
    "kotlin-testing": kotlin("testing", "For tests of programs: `Tools~/collektive-testing.jar`."),
    "c-header": c_header,
}
