"""Fuzzes schemas. Each schema must be rejected with a line number, or compile on both sides, which must then exchange data without changing it.

`./collektive test --fuzz schemas` runs `fuzz.py SECONDS SEED`. test_fuzz.py runs a short batch and the corpus.
"""
import os
import random
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import compile_schemas  # noqa: E402

CORPUS = os.path.join(HERE, "corpus")
ROOT = os.path.dirname(os.path.dirname(HERE))

# The name of a case, and its errors.
Finding = tuple[str, str]

SCALARS = ["bool", "byte", "ubyte", "short", "ushort", "int", "uint", "long", "ulong", "float", "double"]
PLAIN = ["Alpha", "Beta", "Gamma", "Delta", "Omega", "Robot", "Wheel", "Arm", "Goal", "Area", "Point", "Track", "Zone", "Lamp"]
FIELDS = ["speed", "angle", "home", "target", "label", "size", "mode", "path", "name", "id", "value", "time", "heading", "neighbours",
          "battery", "load", "temperature", "camelCase", "two_words", "x", "y", "z", "w", "count"]
# Names with a meaning in a language, a runtime or generated code.
HOSTILE_TYPES = ["Table", "String", "Struct", "List", "Int", "Object", "System", "Type", "Row", "Offset", "Span", "ByteBuffer", "when", "class",
                 "_", "__", "record", "Any", "Unit", "Companion", "DataSchema", "View", "Bridge", "Draft", "Enum", "Nullable", "Schema", "UserSchema",
                 "AlphaValue", "BetaT", "alpha", "Exception", "Integer", "Boolean", "Math", "KeyValuePair", "Collektive", "Google", "var", "dynamic",
                 "Verifier", "FlatBufferBuilder", "SensorDataT", "SensorDataValue", "ActuatorDataVerify", "Override", "Number", "Pair", "Map",
                 "StringBuilder", "StructLayout", "Func", "Vector3", "Deprecated", "JvmOverloads", "LongArray", "Void", "Class", "Array", "Char"]
HOSTILE_FIELDS = ["_", "__", "_x", "x_", "_1", "a__b", "x1", "class", "when", "default", "in", "is", "fun", "val", "object", "to_string", "hash_code",
                  "get_class", "wait", "notify", "add_x", "create_x_vector", "start_x_vector", "x_as_byte_buffer", "get_x_bytes", "get_x_array", "has_x",
                  "x_type", "x_by_key", "make_home", "clear", "fill", "write", "row", "layout", "find_not_finite", "write_children", "component1",
                  "copy", "equals", "bb", "o", "j", "i", "it", "builder", "data", "result", "target_", "place", "items", "depth", "struct", "table",
                  "string", "namespace", "event", "var", "dynamic", "value", "get", "set", "this", "__init", "__assign", "__vector", "sensor_data",
                  "actuator_data", "Speed", "SPEED", "typeof", "package", "String", "Table", "get_root_as_sensor_data", "end_sensor_data", "length",
                  "byte_buffer", "spare1", "child1", "base", "absent", "offset", "vtable", "v_table", "field0", "x_vector", "x_length", "pack"]
HOSTILE_NAMESPACES = ["class", "fun", "Table", "String", "_", "data", "java", "kotlin", "System", "in", "default", "Bridge", "types", "x", "Value",
                      "SensorData", "builder", "it", "com", "org", "global", "record", "constant", "Alpha", "object", "Google", "name", "_a", "a_"]
HOSTILE_FILES = ["1st.fbs", "_.fbs", "class.fbs", "sch\u00f6n.fbs", "a b.fbs", "table.fbs", "a-b.fbs", "a.b.fbs", "sensor_data.fbs", "-x.fbs"]
HOSTILE_COMMENTS = ["*/ int evil; /*", "\\u002a\\u002f int evil; /*", "/ int evil;", "C:\\users\\me", "/* never closed", "a\u2028int evil;",
                    "a\u0085int evil;", "a\u000cint evil;", "]]></summary>int evil;", "& < > \"", "@param x", "{@link", "```", "*", "\\", "{{name}}",
                    "$x ${evil}", "@property", "\u202eevil", "#endif", "#region", "///", "é\U0001f600"]


class RandomSchema:
    """A random schema file with some reserved names and comments."""

    def __init__(self, source: random.Random, root: str) -> None:
        self.random = source
        self.root = root
        self.hostile = source.choice([0, 0, 0.02, 0.05, 0.15])
        self.taken: set[str] = set()

    def pick(self, plain: list[str], hostile: list[str]) -> str:
        return self.random.choice(hostile) if self.random.random() < self.hostile else self.random.choice(plain)

    def type_name(self) -> str:
        while True:
            name = self.pick(PLAIN, HOSTILE_TYPES)
            if name not in self.taken:
                self.taken.add(name)
                return name
            if len(self.taken) > len(PLAIN) - 2:
                return f"Type{len(self.taken)}"

    def comment(self, indent: str = "") -> str:
        if self.random.random() > 0.15:
            return ""
        lines = [self.random.choice(HOSTILE_COMMENTS) if self.random.random() < 0.5 else " In metres." for _ in range(self.random.randint(1, 3))]
        return "".join(f"{indent}///{line}\n" for line in lines)

    def default(self, scalar: str) -> str:
        r = self.random
        if scalar == "bool":
            return r.choice(["true", "false"])
        if scalar in ("float", "double"):
            return r.choice(["0", "1.5", "-2e3", "nan", "inf", "-inf", "1e-30", "-0.0"])
        bits = {"byte": 7, "ubyte": 8, "short": 15, "ushort": 16, "int": 31, "uint": 32, "long": 63, "ulong": 63}[scalar]
        return str(r.choice([0, 1, 2 ** bits - 1] + ([] if scalar.startswith("u") else [-1, -2 ** bits])))

    def fields(self, structs: list[str], tables: list[str], enums: list[str], in_table: bool) -> str:
        r = self.random
        names: set[str] = set()
        lines = []
        for _ in range(r.randint(1, 7)):
            name = self.pick(FIELDS, HOSTILE_FIELDS)
            plain = name.replace("_", "").lower()
            # Avoids names that differ only in `_` or case, which would reject most schemas and have their own tests.
            if plain in names and r.random() > self.hostile:
                continue
            names.add(plain)
            lines.append(self.comment("  ") + f"  {name}: {self.type_of(structs, tables, enums, in_table)};\n")
        return "".join(lines) or "  only: int;\n"

    def type_of(self, structs: list[str], tables: list[str], enums: list[str], in_table: bool) -> str:
        r = self.random
        kind = r.random()
        if kind < 0.4 or (not in_table and not structs and not enums):
            scalar = r.choice(SCALARS)
            if not in_table:
                return scalar
            end = r.random()
            return scalar + ("" if end < 0.5 else f" = {self.default(scalar)}" if end < 0.8 else " = null" if end < 0.95 else " (deprecated)")
        if kind < 0.5 and enums:
            return r.choice(enums) + (" = null" if in_table and r.random() < 0.3 else "")
        if not in_table:
            return r.choice(structs) if structs else "int"
        if kind < 0.6 and structs:
            return r.choice(structs) + r.choice(["", "", " (required)"])
        if kind < 0.7:
            return "string" + r.choice(["", "", " (required)"])
        if kind < 0.8 and tables:
            return r.choice(tables)
        element = r.choice(SCALARS + ["string"] + structs + tables + enums)
        return f"[{element}]" + r.choice(["", "", "", " (required)", " (deprecated)"])

    def text(self) -> str:
        r = self.random
        namespace = self.root
        if r.random() < 0.4:
            namespace += "." + self.pick(["inner", "deep.er"], HOSTILE_NAMESPACES)
        out = ['include "types.fbs";\n'] if r.random() < 0.5 else []
        structs = ["org.collektive.schema.Vector3"] if out else []
        tables: list[str] = []
        enums: list[str] = []
        out.append(f"{self.comment() if r.random() < 0.1 else ''}namespace {namespace};\n")
        for _ in range(r.randint(0, 2)):
            name = self.type_name()
            values = r.sample(["A", "B", "Walk", "Run", "None"] + (["names", "class", "default", "value__", "_"] if r.random() < self.hostile else []), 3)
            flags = " (bit_flags)" if r.random() < 0.2 else ""
            out.append(f"{self.comment()}enum {name} : {r.choice(['ubyte', 'ushort', 'uint'] if flags else ['byte', 'ubyte', 'short', 'int', 'ulong'])}"
                       f"{flags} {{ {', '.join(values)} }}\n")
            # The default 0 must be a value of the enum.
            if not flags:
                enums.append(name)
        for _ in range(r.randint(0, 3)):
            name = self.type_name()
            attribute = r.choice(["", "", "", "", " (private)", " (force_align: 16)", " (csharp_partial)"]) if r.random() < 0.3 else ""
            out.append(f"{self.comment()}struct {name}{attribute} {{\n{self.fields(list(structs), [], enums, False)}}}\n")
            structs.append(name)
        names = [self.type_name() for _ in range(r.randint(0, 4))]
        for name in names:
            # Tables may be recursive.
            out.append(f"{self.comment()}table {name} {{\n{self.fields(structs, names, enums, True)}}}\n")
        tables = names
        if r.random() < 0.1 and tables:
            out.append(f"union {self.type_name()} {{ {r.choice(tables)} }}\n")
        for root in ["SensorData", "ActuatorData"] + (["GlobalData"] if r.random() < 0.4 else []):
            if root != "GlobalData" and r.random() < 0.35:
                out.append(f"{self.comment()}struct {root} {{\n{self.fields(structs, [], enums, False)}}}\n")
            else:
                out.append(f"{self.comment()}table {root} {{\n{self.fields(structs, tables, enums, True)}}}\n")
        if r.random() < 0.1:
            out.append(r.choice(["root_type SensorData;\n", 'file_identifier "ABCD";\nroot_type ActuatorData;\n', 'file_extension "x*/";\n']))
        if r.random() < 0.05:
            out.insert(r.randrange(len(out)), r.choice(["}", "table {", "\"", "/* ", "\\", "\0", "attribute \"x\";\n", ";;;\n"]))
        return "".join(out)

    def file(self) -> str:
        return self.pick(["user.fbs", "my_swarm.fbs"], HOSTILE_FILES)


def write_batch(folder: str, seed: int, count: int) -> None:
    """Writes random schemas to `cases`, each in a folder named after its namespace."""
    source = random.Random(seed)
    for i in range(count):
        # At most one schema has a reserved namespace, because namespaces must be unique.
        root = source.choice([name for name in HOSTILE_NAMESPACES if name not in os.listdir(CORPUS)]) if i == 0 else f"case{i}"
        schema = RandomSchema(source, root)
        case = os.path.join(folder, "cases", root)
        os.makedirs(case)
        with open(os.path.join(case, schema.file()), "w", newline="") as file:
            file.write(schema.text())


def run(folder: str, records: int = 20) -> tuple[int, int, list[Finding]]:
    """Runs all schemas of `cases`. Returns the number of accepted schemas, the number of rejected schemas, and the failures as (case, text)."""
    each = subprocess.run([*compile_schemas.GENERATE_ALL, folder], capture_output=True, text=True)
    outcomes = [line.split("\t") for line in each.stdout.splitlines()]
    findings = []
    if len(outcomes) != len(os.listdir(os.path.join(folder, "cases"))):
        findings.append(("all", "the generator ended early: " + each.stderr[-2000:]))
    accepted = [case for case, outcome, _ in outcomes if outcome == "accepted"]
    for case, outcome, text in outcomes:
        if outcome == "crashed" or (outcome == "rejected" and not re.search(r"\.fbs:\d+(:\d+)?: ", text)):
            findings.append((case, text))
    if accepted:
        findings += compile_and_compare(folder, accepted, records)
    return len(accepted), sum(outcome == "rejected" for _, outcome, _ in outcomes), findings


def compile_and_compare(folder: str, accepted: list[str], records: int) -> list[Finding]:
    text = compile_schemas.compile_generated(Path(folder))
    if text:
        failing = {case for case in accepted if re.search(rf"/(csharp|jvm)/{re.escape(case)}/", text)}
        return [(case, "\n".join(line for line in text.splitlines() if f"/{case}/" in line)[:3000]) for case in sorted(failing)] or [("all", text[-6000:])]
    names = ",".join(sorted(file[:-len(".bfbs")] for file in os.listdir(os.path.join(folder, "jvm", "META-INF", "collektive"))))
    findings = []
    csharp = compile_schemas.round_trip_csharp(Path(folder, "RoundTrip.exe"))
    kotlin = compile_schemas.round_trip_kotlin(Path(folder, "classes"))
    for writer, reader in [(csharp, kotlin), (kotlin, csharp)]:
        data = os.path.join(folder, "data")
        for command in [[*writer, "write", names, data, str(records), "1"], [*reader, "read", names, data]]:
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0 or "Exception" in done.stderr:
                findings.append(("all", " ".join(command[-5:])[:200] + "\n" + done.stdout[-500:] + done.stderr[-3000:]))
        for name, failed in re.findall(r"^(\S+): .* passed, (\d+) failed$", done.stdout, re.MULTILINE):
            if failed != "0":
                findings.append((name.split(".")[0], done.stderr[-3000:]))
        if done.returncode == 0 and len(re.findall(r" passed, 0 failed$", done.stdout, re.MULTILINE)) != len(names.split(",")):
            findings.append(("all", "not all schemas were read: " + done.stdout[-2000:]))
    return findings


def batch(folder: str, seed: int, count: int) -> tuple[int, int, list[Finding]]:
    """Runs random schemas and the corpus of earlier findings."""
    shutil.rmtree(folder, ignore_errors=True)
    write_batch(folder, seed, count)
    shutil.copytree(CORPUS, os.path.join(folder, "cases"), dirs_exist_ok=True)
    return run(folder)


def main() -> None:
    end, seed = time.time() + float(sys.argv[1]), int(sys.argv[2])
    work, totals, found = os.path.join(ROOT, "build", "fuzz", "schemas"), [0, 0], 0
    while time.time() < end:
        folder = os.path.join(work, "batch")
        accepted, rejected, findings = batch(folder, seed, 60)
        totals = [totals[0] + accepted, totals[1] + rejected]
        print(f"seed {seed}: {accepted} accepted, {rejected} rejected, {len(findings)} findings", flush=True)
        for case, text in findings:
            found += 1
            saved = os.path.join(work, "findings", f"{seed}-{case}")
            shutil.rmtree(saved, ignore_errors=True)
            shutil.copytree(os.path.join(folder, "cases", case if case != "all" else ""), saved)
            print(f"{saved}:\n{text}", flush=True)
        seed += 1
    print(f"Done {sum(totals)} runs: {totals[0]} accepted, {totals[1]} rejected, {found} findings")
    sys.exit(found > 0)


if __name__ == "__main__":
    main()
