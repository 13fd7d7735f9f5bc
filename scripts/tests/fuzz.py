"""Fuzzes all code that reads untrusted input.

`fuzz.py SECONDS RESULTS.xml` fuzzes scenario files. The suite fuzz runs this command.
`fuzz.py --each [NAME]... [MINUTES [SEED]]` runs the named fuzzers, or all of them, each for the given number of minutes.

The corpora in the repository contain all inputs that have revealed a bug, and the test suites run these inputs again. Other inputs that fuzzing finds stay
in build/fuzz for the next run.
"""
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import experiments, fetch, graph, jdk, lock, managed, processes
from build.console import Failure, print_progress
from build.places import BUILD, CSHARP, EXPERIMENTS_PYTHON, FLATC, JVM, LOGS, ROOT, TEST_PYTHON

FUZZ = BUILD / "fuzz"
HOST = JVM / "host/target"


def fuzz_scenario(seconds: int, seed: int, *results: str) -> list[str | Path]:
    """Returns the command line that fuzzes scenario files."""
    return managed.command("mono-sgen", CSHARP / "Collektive.Fuzz.exe", ROOT / "unity/Headless~/Fuzz/corpus/scenario",
                           FUZZ / "scenario/findings", str(seconds), str(seed % 2**31), *results)


def fuzz_schemas(seconds: int, seed: int) -> list[str | Path]:
    """Returns the command line that tests the generator with batches of random schemas."""
    return [TEST_PYTHON, "-I", "-B", ROOT / "schema/test/fuzz.py", str(seconds), str(seed)]


def jazzer(name: str, target: str, module: str) -> Callable[[int, int], list[str | Path]]:
    """Returns a function that returns the command line of a fuzzer of the JVM side. The fuzzer must run in the folder of its module."""
    def command(seconds: int, seed: int) -> list[str | Path]:
        # This jar must be first on the class path, because another jar contains older versions of some of its classes.
        compiler = next((HOST / "fuzz").glob("kotlin-compiler-embeddable-*.jar"))
        classes = f"target/test-classes:target/classes:{HOST}/test-classes:{HOST}/classes:{compiler}:{HOST}/fuzz/*"
        return [jdk.find_jdk() / "bin/java", "-Xmx768m", "-XX:+EnableDynamicAgentLoading", f"-Dcollektive.root={ROOT}", f"-Dcollektive.flatc={FLATC}",
                "-cp", classes, "com.code_intelligence.jazzer.Jazzer", f"--target_class={target}",
                "--instrumentation_includes=org.collektive.**:com.google.flatbuffers.**", "--instrumentation_excludes=org.collektive.generator.**",
                "--custom_hook_includes=org.collektive.**", "--custom_hook_excludes=org.collektive.generator.**", "--keep_going=20",
                f"--reproducer_path={FUZZ / name}", f"-artifact_prefix={FUZZ / name}/findings/", f"-max_total_time={seconds}", f"-seed={seed % 2**32}",
                "-timeout=60", "-rss_limit_mb=4000", FUZZ / name / "corpus", JVM / module / "src/test/corpus" / name]
    return command


FUZZERS: dict[str, Callable[[int, int], list[str | Path]]] = {
    "open": jazzer("open", "org.collektive.host.fuzz.OpenFuzzer", "host"),
    "step": jazzer("step", "org.collektive.host.fuzz.StepFuzzer", "host"),
    "control": jazzer("control", "org.collektive.host.fuzz.ControlFuzzer", "host"),
    "record": jazzer("record", "org.collektive.tools.record.RecordFuzzer", "tools"),
    "scenario": fuzz_scenario,
    "schemas": fuzz_schemas,
    "shim": lambda seconds, seed: [BUILD / "sanitized/test/shim_test", "fuzz"],
    "experiments": lambda seconds, seed: [EXPERIMENTS_PYTHON, "-P", "-s", ROOT / "experiments/tests/fuzz.py", str(seconds), str(seed),
                                          FUZZ / "experiments/findings"],
}


def environment(name: str, seconds: int, seed: int) -> dict[str, str]:
    """Returns the environment variables for a fuzzer."""
    if name == "experiments":
        return dict(experiments.environment())
    if name != "shim":
        return dict(managed.environment("mono-sgen"))
    options = next((BUILD / "sanitized").rglob("asan_options")).read_text()
    return {**os.environ, "ASAN_OPTIONS": options, "CLK_TEST_JAVA_HOME": str(jdk.find_jdk()), "CLK_FUZZ_SECONDS": str(seconds), "CLK_FUZZ_SEED": str(seed)}


def run_each(words: list[str]) -> None:
    """Runs fuzzers one after the other.

    Raises `Failure` if one has findings.
    """
    names = [word for word in words if not word[0].isdigit()]
    numbers = words[len(names):]
    for name in names:
        if name not in FUZZERS:
            raise Failure(f"test --fuzz: unknown fuzzer '{name}'; known: {' '.join(FUZZERS)}")
    if words != names + numbers or len(numbers) > 2 or not all(re.fullmatch(r"\d+", number) for number in numbers) or numbers[:1] == ["0"]:
        raise Failure("test --fuzz: pass a whole number of minutes, and a seed (see ./collektive test --help)")
    seconds = 60 * int(numbers[0] if numbers else 5)
    seed = int(numbers[1]) if len(numbers) > 1 else int(time.time())
    names = names or list(FUZZERS)
    prepare(names)
    failed = [name for name in names if not run(name, seconds, seed)]
    if failed:
        raise Failure(f"test --fuzz: see {LOGS}/fuzz-*.log; fix the bug and copy its input to the fuzzer's corpus")


def prepare(names: list[str]) -> None:
    """Builds the class path for Jazzer and the shim with sanitizers, and fetches packages from PyPI."""
    if "shim" in names:
        graph.build("sanitized")
    if "experiments" in names:
        fetch.fetch("experiments")
    if not (HOST / "fuzz").exists() and {"open", "step", "control", "record"} & set(names):
        lock.exclusive()
        subprocess.run(["mvn", "-B", "-ntp", "-q", "-f", JVM / "pom.xml", "-Pfuzz", "-pl", "host", "-am", "-DskipTests", "-Dmdep.skip=false", "package"],
                       check=True)
        lock.shared()


def run(name: str, seconds: int, seed: int) -> bool:
    """Runs a fuzzer, and writes its output to a log. Returns whether it ended without a finding."""
    findings, log = FUZZ / name / "findings", LOGS / f"fuzz-{name}.log"
    findings.mkdir(parents=True, exist_ok=True)
    (FUZZ / name / "corpus").mkdir(exist_ok=True)
    print_progress(f"fuzz {name} for {seconds // 60} min, seed {seed} ...")
    module = JVM / {"record": "tools"}.get(name, "host")
    with log.open("wb") as file:
        code = subprocess.run(FUZZERS[name](seconds, seed), cwd=module, env=environment(name, seconds, seed), stdout=file, stderr=file).returncode
    text = log.read_text(errors="replace").replace("\r", "\n")
    if name == "shim" and code != 0:
        # The finding of this fuzzer is its output, which contains the seed to add to the corpus in native-shim/test/fuzz.c.
        (findings / f"seed-{seed}.log").write_text(text)
    done = re.search(r"(?m)^Done \d+ runs.*", text)
    print_progress(f"fuzz {name}: {done[0] if done else 'ended early'}, {len(list(findings.iterdir()))} findings in {findings}")
    return code == 0


def main(words: list[str]) -> int:
    """Runs the fuzzers that the command line names. Returns the exit code."""
    if words[0] != "--each":
        seed = int(time.strftime("%j"))
        return processes.call(fuzz_scenario(int(words[0]), seed, words[1]), env=managed.environment("mono-sgen"))
    try:
        run_each(words[1:])
    except Failure as failure:
        print(f"collektive: {failure}", file=sys.stderr)
        return failure.code or 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
