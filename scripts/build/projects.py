"""Compiles users' projects: their schema, their Kotlin and their C#, each in a folder of build/ that is named after all that it depends on."""
import hashlib
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import csharp, fetch
from build.console import Failure, say
from build.jdk import feature_version, find_jdk
from build.places import BUILD, CSHARP, FLATC, GENERATOR_JAR, HOST_JAR, LIBRARY_JAR, LINKS, LOGS, ROOT, compiler_plugin

# A file for each jar that was run here, named by its SHA-256.
OWN_PROGRAMS = BUILD / "own-programs"
MAX_FILES = 10_000
PLUGIN_SERVICE = "META-INF/services/org.jetbrains.kotlin.compiler.plugin.CompilerPluginRegistrar"


class CompileError(Failure):
    """A project's sources do not compile; the compiler's messages were printed."""


def generator(schema: Path, *outputs: str | Path) -> list[str | Path]:
    """Returns the command line that generates the code of a schema; outputs are --csharp DIR and --jvm DIR."""
    return [find_jdk() / "bin/java", "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1", "-jar", GENERATOR_JAR, "--flatc", FLATC, "--include",
            ROOT / "schema", "--schema", schema, *outputs]


def fingerprint(*paths: Path) -> str:
    """Returns a hash over the contents of files and folders, build outputs left out.

    Files count by their places in the folder, not by its location: copies of a project share what is compiled.
    """
    digest = hashlib.sha256()
    for path in paths:
        for file in _files(path) if path.is_dir() else [path]:
            name = file.relative_to(path) if file != path else ""
            digest.update(f"{name}\0".encode(errors="surrogateescape"))
            digest.update(hashlib.sha256(file.read_bytes()).digest())
    return digest.hexdigest()[:32]


def _files(folder: Path) -> list[Path]:
    found = []
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name not in ("target", "node_modules", ".git")]
        found += [Path(place, name) for name in names if not Path(place, name).is_symlink()]
    return sorted(file for file in found if file.is_file())


def own_program(jar: Path) -> None:
    """Notes a jar that the user runs. `./collektive replay` runs those again without a question."""
    OWN_PROGRAMS.mkdir(parents=True, exist_ok=True)
    (OWN_PROGRAMS / hashlib.sha256(jar.read_bytes()).hexdigest()).touch()


def programs_jar(schema: Path, programs: Path, jars: Path | None = None, plugin: Path | None = None) -> Path:
    """Returns the jar of a folder of Kotlin, compiled if it changed; a jar is returned as it is.

    Programs are compiled for the built-in runtime, or for the one whose jars are in the folder `jars`, with its compiler plugin.
    """
    if programs.is_file():
        return programs
    _check_size(programs)
    fetch.fetch("kotlinc")
    inputs = [LIBRARY_JAR, compiler_plugin()] if jars is None or plugin is None else [jars, plugin, LINKS]
    key = fingerprint(schema, programs, ROOT / "schema", HOST_JAR, GENERATOR_JAR, *inputs)

    def compile_programs(work: Path, run: Callable[[Sequence[str | Path]], None]) -> None:
        generated, classes = work / "generated", work / "classes"
        options: list[str | Path] = [f"-Xplugin={plugin or compiler_plugin()}"]
        library, mark = str(LIBRARY_JAR), "builtIn"
        if jars is not None and plugin is not None:
            _require_plugin(plugin)
            mark = f"collektive {_runtime_hash(jars)}"
            library = ":".join(str(jar) for jar in sorted(jars.glob("*.jar")))
            options += ["-P", "plugin:it.unibo.collektive.collektive-compiler-plugin:collektiveEnabled=true", LINKS]
        run(generator(schema, "--jvm", generated))
        compile_jvm(run, library, generated, classes, [*options, programs])
        # The host refuses programs of another runtime by this.
        (work / "mark").write_text(f"Collektive-Runtime: {mark}\n")
        run([find_jdk() / "bin/jar", "--create", "--file", work / "programs.jar", "--manifest", work / "mark", "-C", classes, "."])

    return _cached(BUILD / "programs" / key, "programs.jar", "compile-programs", compile_programs)


def scripts_dll(schema: Path, scripts: Path) -> Path:
    """Returns the assembly of a folder of C# and the schema's generated code, compiled if they changed.

    Folders named Generated are left out: the code is generated anew.
    """
    _check_size(scripts)
    # Traces of exceptions contain the folder.
    place = hashlib.sha256(os.fsencode(scripts.resolve())).hexdigest()[:8]
    key = fingerprint(schema, scripts, ROOT / "schema", GENERATOR_JAR, *sorted(CSHARP.glob("*.dll")))

    def compile_scripts(work: Path, run: Callable[[Sequence[str | Path]], None]) -> None:
        generated = work / "generated"
        run(generator(schema, "--csharp", generated))
        folder = scripts
        # The compiler takes quotes in paths away.
        if '"' in str(scripts):
            folder = work / "scripts"
            folder.symlink_to(scripts.resolve())
        files = [file for file in csharp.sources([folder, generated]) if "Generated" not in file.parent.parts]
        run(csharp.command(work / "Scenario.dll", files, [*csharp.symbols(), "-warnaserror-", *csharp.PACKAGE]))

    return _cached(BUILD / "scripts" / f"{key}-{place}", "Scenario.dll", "compile-scripts", compile_scripts)


def compile_jvm(run: Callable[[Sequence[str | Path]], None], library: str, generated: Path, classes: Path, arguments: Sequence[str | Path]) -> None:
    """Compiles flatc's Java first, then the generated Kotlin and the sources among the arguments, into a folder of classes."""
    jdk = find_jdk()
    classes.mkdir(parents=True, exist_ok=True)
    run([jdk / "bin/javac", "--release", "17", "-nowarn", "-proc:none", "-cp", HOST_JAR, "-d", classes, *sorted(generated.rglob("*.java"))])
    # Newer JVMs warn of what the compiler uses.
    quiet = ["--enable-native-access=ALL-UNNAMED", "--sun-misc-unsafe-memory-access=allow"] if feature_version(jdk) >= 24 else []
    try:
        run([jdk / "bin/java", "-Xmx1g", "-XX:+UseSerialGC", *quiet, "-cp", BUILD / "kotlinc/*", "org.jetbrains.kotlin.cli.jvm.K2JVMCompiler",
             "-no-stdlib", "-no-reflect", "-jvm-target", "17", "-cp", f"{HOST_JAR}:{library}:{classes}", "-d", classes, generated, *arguments])
    except subprocess.CalledProcessError as error:
        # The compiler's code for an exception of its own, which is a plugin's more often.
        if error.returncode == 2:
            version = fetch.pom_value("kotlin.version")
            raise Failure(f"the Kotlin compiler {version} crashed, see above: the compiler plugin may be made for another version of it") from error
        raise
    shutil.copytree(generated / "META-INF", classes / "META-INF", dirs_exist_ok=True)


def _cached(folder: Path, file: str, name: str, make: Callable[[Path, Callable[[Sequence[str | Path]], None]], None]) -> Path:
    """Returns a file that `make` makes in an empty folder.

    The folder is named after all inputs, so what is there is right: two commands may make it at once, and the first is kept.
    """
    if not folder.is_dir():
        work = folder.with_name(f"{folder.name}.{os.getpid()}")
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        log = work / f"{name}.log"
        say(f"{name} ...")
        try:
            with log.open("wb") as output:
                make(work, lambda command: _run(command, output.fileno()))
        except (subprocess.CalledProcessError, Failure) as error:
            print(log.read_text(encoding="utf-8", errors="replace"), end="", file=sys.stderr)
            kept = LOGS / log.name
            kept.parent.mkdir(parents=True, exist_ok=True)
            log.replace(kept)
            shutil.rmtree(work)
            raise error if isinstance(error, Failure) else CompileError(f"{name} failed; the whole log is {kept}") from error
        for line in log.read_text(encoding="utf-8", errors="replace").splitlines():
            if ": warning: " in line:
                print(line, file=sys.stderr)
        try:
            work.rename(folder)
        except OSError:
            shutil.rmtree(work)
            if not folder.is_dir():
                raise
    return folder / file


def _run(command: Sequence[str | Path], output: int) -> None:
    subprocess.run(command, stdin=subprocess.DEVNULL, stdout=output, stderr=output, check=True)


def _check_size(folder: Path) -> None:
    """Refuses a folder that can hardly be one of sources: hashing all of a disk would seem to hang."""
    count = 0
    for _, _, names in os.walk(folder):
        count += len(names)
        if count > MAX_FILES:
            raise Failure(f"the folder '{folder}' has more than {MAX_FILES:,} files: name the one that contains only the sources of this scenario")


def _runtime_hash(jars: Path) -> str:
    """Returns the SHA-256 of a folder's jars one after the other, by name."""
    digest = hashlib.sha256()
    for jar in sorted(jars.glob("*.jar")):
        digest.update(jar.read_bytes())
    return digest.hexdigest()


def _require_plugin(jar: Path) -> None:
    """Fails unless a jar is a plugin of the Kotlin compiler, since the compiler ignores what is not one."""
    with zipfile.ZipFile(jar) as archive:
        if PLUGIN_SERVICE not in archive.namelist():
            raise Failure(f"{jar} is not a plugin of the Kotlin compiler: name Collektive's compiler-plugin as 'runtimePlugin'")
