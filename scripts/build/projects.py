"""Compiles the schema, Kotlin and C# of users' projects. Each output has its own folder in build/, whose name contains a hash of all inputs."""
import contextlib
import fcntl
import hashlib
import os
import re
import shutil
import subprocess
import sys
import uuid
import zipfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import csharp, fetch, inputs, maven
from build.console import Failure, print_progress
from build.inputs import Part
from build.jdk import feature_version, find_jdk
from build.places import BUILD, CSHARP, FLATC, GENERATOR_JAR, HOST_JAR, LIBRARY_JAR, LINKS, LOGS, PLAYER, compiler_plugin

# A folder with a file for each jar that was run here. The name of the file is the jar's SHA-256.
OWN_PROGRAMS = BUILD / "own-programs"
COMPILE_COMMAND = "org.collektive.generator.CompileCommand"
# The folder of the index of programs in a jar. ProgramIndex.kt defines its format.
PROGRAM_INDEX = "META-INF/collektive/programs/"
ESCAPES = {"t": "\t", "n": "\n", "r": "\r"}
PLUGIN_SERVICE = "META-INF/services/org.jetbrains.kotlin.compiler.plugin.CompilerPluginRegistrar"


class CompileError(Failure):
    """The sources of a project do not compile, and the compiler has printed its messages."""


def generator(schema: Path, *outputs: str | Path) -> list[str | Path]:
    """Returns the command line that generates the code of a schema. `outputs` contains the options --csharp DIR and --jvm DIR."""
    return [find_jdk() / "bin/java", "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1", "-jar", GENERATOR_JAR, "--flatc", FLATC, "--include",
            inputs.CORE, "--schema", schema, *outputs]


def _key(parts: Sequence[Part], tools: Sequence[Path]) -> str:
    """Returns a hash of parts of a project and of the tools that compile them.

    The hash does not contain absolute paths, so copies of a project share outputs.
    """
    digest = hashlib.sha256("\0".join(part.digest for part in parts).encode())
    for tool in [Path(__file__), FLATC, GENERATOR_JAR, *sorted(inputs.CORE.glob("*.fbs")), *tools]:
        digest.update(hashlib.sha256(tool.read_bytes()).digest())
    return digest.hexdigest()[:32]


def record_own_program(jar: Path) -> None:
    """Stores the hash of a jar that the user runs. `./collektive replay` can then run it without --trust."""
    note = OWN_PROGRAMS / hashlib.sha256(jar.read_bytes()).hexdigest()
    if not note.exists():
        OWN_PROGRAMS.mkdir(parents=True, exist_ok=True)
        note.touch()


def program_names(programs: Part) -> set[str] | None:
    """Returns the names of the programs in a folder of Kotlin. Returns None for a jar, and for names or annotations that only the compiler can read."""
    if programs.path.is_file():
        return None
    found: list[str] = []
    for name, file in programs.files.items():
        text = file.read_text(encoding="utf-8", errors="replace") if name.endswith(".kt") else ""
        names = re.findall(r'@Program\s*\(\s*(?:name\s*=\s*)?"([^"$\\]+)"\s*[,)]', text)
        # Other occurrences of the word may be annotations, too, such as @[Program("a")], or declare an alias.
        if len(re.findall(r"\bProgram\b", re.sub(r"(?m)^import org\.collektive\.api\.Program\s*$", "", text))) != len(names):
            return None
        found += names
    return set(found)


def parameters(jar: Path) -> dict[str, dict[str, list[str]]]:
    """Returns the parameters of each program in a jar, by name: the default, the description and the possible values.

    They are in the index of our compiler plugin. Without an index, returns an empty object.
    """
    found: dict[str, dict[str, list[str]]] = {}
    try:
        with zipfile.ZipFile(jar) as archive:
            for index in [name for name in archive.namelist() if name.startswith(PROGRAM_INDEX) and not name.endswith("/")]:
                program = ""
                for line in archive.read(index).decode(errors="replace").split("\n")[:-1]:
                    kind, name, *rest = [re.sub(r"\\(.)", lambda match: ESCAPES.get(match[1], match[1]), column) for column in line.split("\t")]
                    program = name if kind == "program" else program
                    declared = found.setdefault(program, {})
                    if kind == "parameter" and len(rest) >= 2:
                        declared[name] = rest
    # The host reports damaged jars. An encrypted or damaged entry, or an unknown compression, raises one of many types.
    except Exception:
        return {}
    return found


def programs_jar(schema: Part, programs: Part, jars: Part | None = None, plugin: Part | None = None) -> Path:
    """Compiles a folder of Kotlin if it has changed, and returns its jar. A jar is returned unchanged.

    The programs are compiled for the built-in runtime, or with `jars` and `plugin` for the runtime that consists of these jars.
    """
    if programs.path.is_file():
        return programs.path
    fetch.fetch("kotlinc")
    runtime = [jars, plugin, inputs.programs(LINKS)] if jars and plugin else []
    parts = [schema, programs, *runtime]
    # A change of the host or the library that is not visible to programs does not change their jar.
    host = maven.read_modules()["host"]
    visible = [maven.PARENT, host.folder / "pom.xml", *(module.target / "abi" for module in [host, *host.upstream])]
    key = _key(parts, [*visible, BUILD / "stamp/kotlinc", find_jdk() / "release", *([] if runtime else [compiler_plugin()])])

    def compile_programs(work: Path, run: Callable[[Sequence[str | Path]], None]) -> None:
        options = compilation(schema, programs, work, jars, plugin)
        try:
            run([*compiler_jvm(), COMPILE_COMMAND, *options])
        except subprocess.CalledProcessError as error:
            # The compiler has this exit code after an internal error, which a plugin usually causes.
            if error.returncode == 2:
                version = fetch.pom_value("kotlin.version")
                raise Failure(f"the Kotlin compiler {version} crashed (see above); the compiler plugin may be built for another version") from error
            raise
        if (cache := aot_cache()) and not cache.exists():
            _record_aot_cache(cache, work, options)

    return _cached(BUILD / "programs" / key, "programs.jar", "compile-programs", parts, compile_programs)


def compilation(schema: Part, programs: Part, work: Path, jars: Part | None = None, plugin: Part | None = None) -> list[str | Path]:
    """Returns the options with which the compiler writes programs.jar to the folder `work`."""
    options: list[str | Path] = [f"-Xplugin={plugin.path if plugin else compiler_plugin()}"]
    library, mark = [LIBRARY_JAR], "builtIn"
    if jars and plugin:
        _require_plugin(plugin.path)
        library, mark = list(jars.files.values()), f"collektive {_runtime_hash(jars)}"
        options += ["-P", "plugin:it.unibo.collektive.collektive-compiler-plugin:collektiveEnabled=true", LINKS]
    values: list[tuple[str, str | Path]] = [
        ("--flatc", FLATC), ("--include", inputs.CORE), ("--schema", schema.copy(work / "schema")), ("--jar", work / "programs.jar"), ("--work", work),
        # The host reads this mark, and rejects programs that were compiled for another runtime.
        ("--mark", f"Collektive-Runtime:{mark}"),
        *(("--library", jar) for jar in [HOST_JAR, *library]),
        *(("--kotlin", option) for option in options), *(("--source", file) for file in programs.files.values())]
    return [word for value in values for word in value]


def compile_server(folder: Path) -> list[str | Path]:
    """Returns the command of a process that handles compilation requests in a folder until this process ends."""
    fetch.fetch("kotlinc")
    return [*compiler_jvm(), COMPILE_COMMAND, "--serve", folder, str(os.getpid())]


def test_classes(schema: Part, tests: Part, class_path: Sequence[Path], plugin: Path) -> Path:
    """Compiles a folder of Kotlin tests if they have changed, and returns the folder of their classes.

    The last jar of the class path contains the tested programs.
    """
    fetch.fetch("kotlinc")
    key = _key([schema, tests], [*class_path, plugin, BUILD / "stamp/kotlinc", find_jdk() / "release"])

    def compile_tests(work: Path, run: Callable[[Sequence[str | Path]], None]) -> None:
        (work / "classes").mkdir()
        run([*compiler_jvm(), "org.jetbrains.kotlin.cli.jvm.K2JVMCompiler", "-no-stdlib", "-no-reflect", "-jvm-target", "17",
             "-cp", ":".join(map(str, class_path)), "-d", work / "classes", f"-Xplugin={plugin}", f"-Xfriend-paths={class_path[-1]}", *tests.files.values()])

    return _cached(BUILD / "programs" / key, "classes", "compile-tests", [schema, tests], compile_tests)


def scripts_dll(schema: Part, scripts: Part) -> Path:
    """Compiles a folder of C# and the schema's generated code if they have changed, and returns the assembly."""
    # The key contains the folder, because stack traces show it. Copies in different folders therefore cannot share an assembly.
    place = hashlib.sha256(os.fsencode(scripts.path.resolve())).hexdigest()[:8]
    key = _key([schema, scripts], [Path(csharp.__file__), BUILD / "stamp/npm", csharp.SYMBOLS, *sorted(CSHARP.glob("*.dll")), PLAYER])

    def compile_scripts(work: Path, run: Callable[[Sequence[str | Path]], None]) -> None:
        generated = work / "generated"
        run(generator(schema.copy(work / "schema"), "--csharp", generated))
        folder = scripts.path
        # The compiler removes quotes from paths, so it could not find these files.
        if '"' in str(folder):
            folder = work / "scripts"
            folder.symlink_to(scripts.path.resolve())
        files = [*(folder / name for name in scripts.files), *csharp.sources([generated])]
        run(csharp.command(work / "Scenario.dll", files, [*csharp.symbols(), "-warnaserror-", *csharp.REFERENCES]))

    return _cached(BUILD / "scripts" / f"{key}-{place}", "Scenario.dll", "compile-scripts", [schema, scripts], compile_scripts)


def compiler_jvm(*archive: str) -> list[str | Path]:
    """Returns the start of a command line that runs the Kotlin compiler in a JVM, without the main class. Uses the AOT cache by default."""
    jdk = find_jdk()
    # Newer JVMs print warnings about features that the compiler uses.
    quiet = ["--enable-native-access=ALL-UNNAMED", "--sun-misc-unsafe-memory-access=allow"] if feature_version(jdk) >= 24 else []
    if not archive and (cache := aot_cache()):
        # The JVM ignores a missing or unsuitable cache.
        archive = (f"-XX:AOTCache={cache}", "-Xlog:disable")
    return [jdk / "bin/java", "-Xmx1g", "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1", *quiet, *archive, "-cp", f"{BUILD}/kotlinc/*:{GENERATOR_JAR}"]


def aot_cache() -> Path | None:
    """Returns the file of loaded classes and profiles that halves the time of compilations, or None if the JDK does not support it.

    The name depends on the modification times of the jars, like the validity of the cache.
    """
    jdk = find_jdk()
    if feature_version(jdk) < 25:
        return None
    key = fetch.key_of(f"{file} {file.stat().st_mtime_ns}" for file in (GENERATOR_JAR, BUILD / "stamp/kotlinc", jdk / "release"))
    return BUILD / f"compiler-{key[:16]}.aot"


def _record_aot_cache(cache: Path, work: Path, options: Sequence[str | Path]) -> None:
    """Repeats a compilation in the folder `work`, and stores its classes and profiles. Without a cache, later compilations are slower."""
    print_progress("compiler-cache ...")
    new = work / "compiler.aot"
    subprocess.run([*compiler_jvm(f"-XX:AOTCacheOutput={new}"), COMPILE_COMMAND, *options], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    if new.exists():
        for old in BUILD.glob("compiler-*.aot"):
            old.unlink(missing_ok=True)
        new.replace(cache)


def _cached(folder: Path, file: str, name: str, parts: Sequence[Part], make: Callable[[Path, Callable[[Sequence[str | Path]], None]], None]) -> Path:
    """Calls `make` to build a file from parts of a project in an empty folder, unless it exists, and returns the file. The first part is a schema.

    The name of the folder contains a hash of all inputs, so an existing file is valid. If two commands build the same folder at the same time, the
    result of the first one is kept.
    """
    if not (folder / file).exists():
        with _work_folder(folder, file) as work:
            log = work / f"{name}.log"
            print_progress(f"{name} ...")
            try:
                with log.open("wb") as output:
                    make(work, lambda command: _run(command, output.fileno()))
                for part in parts:
                    part.require_unchanged()
            except (subprocess.CalledProcessError, Failure) as error:
                # The generator does not support links and has read a copy of the schema. Messages must name the original.
                messages = log.read_text(encoding="utf-8", errors="replace").replace(f"{work}/schema", str(parts[0].root))
                print(messages, end="", file=sys.stderr)
                kept = LOGS / log.name
                kept.parent.mkdir(parents=True, exist_ok=True)
                kept.write_text(messages, encoding="utf-8")
                shutil.rmtree(work)
                raise error if isinstance(error, Failure) else CompileError(f"{name} failed; the full log is {kept}") from error
            for line in log.read_text(encoding="utf-8", errors="replace").splitlines():
                if ": warning: " in line:
                    print(line, file=sys.stderr)
            try:
                work.rename(folder)
            except OSError:
                shutil.rmtree(work)
                if not (folder / file).exists():
                    raise
    return folder / file


@contextlib.contextmanager
def _work_folder(folder: Path, file: str) -> Iterator[Path]:
    """Creates a folder beside `folder`, to build `file` there. If no other command builds one, first removes those of killed commands."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(folder.parent, os.O_RDONLY)
    try:
        with contextlib.suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            # An interrupted `clean` may have left a part of the folder.
            for left in [*folder.parent.glob("*.*"), *(() if (folder / file).exists() else (folder,))]:
                shutil.rmtree(left, ignore_errors=True)
        fcntl.flock(descriptor, fcntl.LOCK_SH)
        # The name does not contain the id of this process, because a process in another container may have the same id.
        work = folder.with_name(f"{folder.name}.{uuid.uuid4().hex}")
        work.mkdir()
        yield work
    finally:
        os.close(descriptor)


def _run(command: Sequence[str | Path], output: int) -> None:
    subprocess.run(command, stdin=subprocess.DEVNULL, stdout=output, stderr=output, check=True)


def _runtime_hash(jars: Part) -> str:
    """Returns the SHA-256 of the concatenated jars in the order of their names."""
    digest = hashlib.sha256()
    for jar in jars.files.values():
        digest.update(jar.read_bytes())
    return digest.hexdigest()


def _require_plugin(jar: Path) -> None:
    """Raises `Failure` if a jar is not a plugin of the Kotlin compiler. The compiler itself would ignore such a jar silently."""
    try:
        with zipfile.ZipFile(jar) as archive:
            archive.getinfo(PLUGIN_SERVICE)
    except (zipfile.BadZipFile, LookupError, ValueError, NotImplementedError) as error:
        raise Failure(f"{jar} is not a plugin of the Kotlin compiler: set 'runtimePlugin' to Collektive's compiler plugin") from error
