# ./collektive test: the steps of the suites; scripts/suites.py runs them and adds up their results.

PROBE="$ROOT/unity/Headless~/Tests/Simulation/Probe"
PYTHON="$BUILD/python/bin/python"

help_test() {
  cat <<'H'
usage: ./collektive test [SUITE]... | --quick | --faults [WORDS] | --exits | --chaos [SEED] | --soak MINUTES | --stress | --sanitize
                        | --fuzz [NAME]... [MINUTES [SEED]] | bare [ROOT]...

Builds and tests everything, or the suites named: lint, scripts, jvm, stress, shim, platforms, csharp, assets, faults, exits, soak, roundtrip,
page, site, acceptance, experiments, chaos, fuzz, bench, gradle. The last needs a Gradle on the PATH, or named by COLLEKTIVE_GRADLE, and is
skipped without one. platforms builds the native library for Windows, Linux and macOS, and tests it under qemu and Wine where these can be had;
without its name, for Linux and macOS on ARM64 only. csharp runs on Mono and, without what needs Mono, on CoreCLR. experiments has a Ray cluster
when it is named; slow tests run on the newest JDK, or on each when their suite is named.
  --quick     the verdict that matters in about six minutes on two idle cores: most suites on one JDK without their slow tests, and a short
              acceptance
  --faults    each fault of scripts/faults/faults.json (or those with WORDS in their name) on every runtime and JVM: a table
  --exits     200 runs that end in each way: the scene is left, quit, Ctrl-C, unhandled exceptions
  --chaos     280 runs that are killed, get signals, full and read-only disks, a jumping clock, little memory: no folder that only
              looks complete, no process left, no lost earlier result; a table of what was tried and what came out
  --soak      a scene whose nodes come, fail and go: memory, threads and descriptors must be flat from the second minute on; a table
  --stress    the JVM side's races between threads, with every compiler and mix of compilers: takes long
  --sanitize  the shim's tests under AddressSanitizer and UndefinedBehaviorSanitizer
  --fuzz      inputs of any bytes against what reads them, 5 minutes or MINUTES for each fuzzer, or for those named: open, step and control
              (frames), record, scenario, schemas, shim (calls in any order, under sanitizers); what it learns stays in build/fuzz
  bare        the demo and the quick tests of the last commit in fresh roots of debian-12, debian-13 and ubuntu-24.04 (or those named),
              as root; one whose packages cannot be had is skipped
The last line is "N passed, N failed" over all that ran; the exit code is 1 when a test failed. Results are read from the JUnit XML files of
the suites, kept in build/results. A changed public API of the JVM side fails the suite jvm, which then shows the difference from
jvm-host/*/api/*.api and the command that accepts it.
H
}

cmd_test() {
  case ${1:-} in
    --faults) at_length faults_at_length "${*:2}" ;;
    --stress) stress_at_length ;;
    --fuzz) at_length fuzz_at_length "${@:2}" ;;
    --chaos) at_length chaos_at_length "${@:2}" ;;
    --soak) at_length soak_at_length "${@:2}" ;;
    --exits | --sanitize)
      [ $# = 1 ] || fail "test: $1 takes no arguments"
      at_length "${1#--}_at_length"
      ;;
    bare) test_bare "${@:2}" ;;
    *) exec python3 "$ROOT/scripts/suites.py" "$@" ;;
  esac
}

# at_length FUNCTION ARGUMENT...: what takes long, with its whole output.
at_length() {
  lock -s
  setup_system
  setup_nunit
  build_native
  "$@"
}

faults_at_length() {
  build_all_faults
  python3 "$ROOT/scripts/faults/faults.py" "$BUILD/faults.json" "$1"
}

exits_at_length() {
  build_all_faults
  python3 "$ROOT/scripts/faults/exits.py" "$BUILD/faults.json" 200
}

build_all_faults() {
  build_jvm
  build_csharp
  build_faults "$BUILD/faults.json" $'mono-sgen\nmono-boehm\ncoreclr' "$(test_jdks)"
}

sanitize_at_length() {
  local jdk results="$BUILD/results/sanitized" failed=0
  build_sanitized
  rm -rf "$results"
  while read -r jdk; do
    echo "== $jdk"
    # shellcheck disable=SC2310 # its result is that of its last command
    shim_cases "$BUILD/sanitized" "$results" "$jdk" || failed=1
  done <<<"$(test_jdks)"
  python3 "$ROOT/scripts/suites.py" sum "$results" "$failed"
}

build_sanitized() {
  clean_cmake "$ROOT/native-shim" "$BUILD/sanitized"
  cmake -S "$ROOT/native-shim" -B "$BUILD/sanitized" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCOLLEKTIVE_SANITIZE=ON \
    -DCOLLEKTIVE_JAVA_HOME="$(find_jdk)"
  cmake --build "$BUILD/sanitized" -j 2
}

# The JDKs that the tests run on: all of this machine that are of version 17 or newer, and last the one that runs simulations.
test_jdks() {
  local jdk version
  {
    for jdk in /usr/lib/jvm/*; do
      # shellcheck disable=SC2310 # looks at files only
      if ! is_jdk "$jdk"; then continue; fi
      version=$(jdk_version "$jdk")
      if [ "$version" -ge 17 ]; then readlink -f "$jdk"; fi
    done
    find_jdk
  } | tac | awk '!seen[$0]++' | tac
}

# Linters and test tools from PyPI, in a virtual environment.
setup_python() {
  once python-tools "$(fingerprint "$ROOT/tools/python") $(python3 --version)" new_environment "$BUILD/python" "$ROOT/tools/python/requirements.txt"
}

# ktlint with all that it needs, from Maven Central.
setup_ktlint() {
  once ktlint "$(fingerprint "$ROOT/tools/ktlint")" fetch_ktlint
}

fetch_ktlint() {
  rm -rf "$BUILD/ktlint"
  mvn -B -ntp -f "$ROOT/tools/ktlint/pom.xml" dependency:copy-dependencies -DoutputDirectory="$BUILD/ktlint"
}

# The linter of the workflows, where there is Go.
ACTIONLINT=1.7.12
setup_actionlint() {
  # shellcheck disable=SC2310 # looks only
  if have go; then once actionlint "$ACTIONLINT" fetch_actionlint; fi
}

fetch_actionlint() { GOBIN="$BUILD/go" go install "github.com/rhysd/actionlint/cmd/actionlint@v$ACTIONLINT"; }

# python_tests RESULTS FOLDER OPTION...: the tests below a folder.
python_tests() {
  local results=$1 tests=$2
  shift 2
  PYTHONDONTWRITEBYTECODE=1 "$PYTHON" -m pytest -c "$ROOT/scripts/pytest.ini" --junitxml "$results/pytest${*// /-}.xml" "$@" "$tests"
}

test_lint() {
  COLLEKTIVE_JAVA="$(find_jdk)/bin/java" python_tests "$1" "$ROOT/scripts/lint" -n 2
}

test_scripts() { python_tests "$1" "$ROOT/scripts/tests" -n 2; }

# test_shim RESULTS JDK
test_shim() {
  cmake_configure
  cmake --build "$BUILD/cmake" -j 2
  shim_cases "$BUILD/cmake" "$1" "$2"
}

# leaves_out_slow JDK: in a run of all suites only the newest JDK has the slow tests, in a quick one none has.
leaves_out_slow() { [ -n "${COLLEKTIVE_QUICK:-}" ] || { [ -n "${COLLEKTIVE_ALL:-}" ] && [ "$1" != "$(find_jdk)" ]; }; }

# shim_cases BUILD RESULTS JDK: the shim's tests of a CMake build, on a JVM.
shim_cases() {
  mkdir -p "$2"
  local without=()
  # shellcheck disable=SC2310 # looks only
  if leaves_out_slow "$3"; then without=(-LE slow); fi
  CLK_TEST_JAVA_HOME="$3" ctest --test-dir "$1" --output-on-failure -j 2 "${without[@]}" \
    --output-junit "$2/$(basename "$3").xml"
}

test_jvm() {
  local code=0 report module stamp="$BUILD/stamp/jvm-host"
  lock -x
  rm -f "$stamp"
  : >"$stamp.started"
  rm -f "$ROOT"/jvm-host/*/target/surefire-reports/TEST-*.xml
  local options=(-Dmaven.test.failure.ignore=true)
  # Most of these JVMs end before code of the second compiler would pay.
  if [ -n "${COLLEKTIVE_QUICK:-}" ]; then options+=(-DexcludedGroups=slow "-Dtest.jvm.flags=-XX:+UseSerialGC -XX:TieredStopAtLevel=1"); fi
  "$ROOT/collektive" step package_jvm "${options[@]}" || code=$?
  rm -f "$stamp.started"
  if [ "$code" = 0 ]; then jvm_fingerprint >"$stamp"; fi
  for report in "$ROOT"/jvm-host/*/target/surefire-reports/TEST-*.xml; do
    module=${report#"$ROOT/jvm-host/"}
    cp "$report" "$1/${module%%/*}-${report##*/}"
  done
  return "$code"
}

has_nunit() { [ -e "$NUNIT" ]; }

build_csharp_tests() {
  # shellcheck disable=SC2310 # looks at a file
  has_nunit || fail "this system has no package of NUnit 2.6, which the C# tests need"
  build_test_schemas
  local editor=("-r:$CSHARP/UnityEditor.dll" "-r:$CSHARP/Collektive.Unity.Editor.dll")
  local framework=("-r:$CSHARP/UnityEngine.TestRunner.dll" "-r:$NUNIT")
  assembly UnityEditor.dll "$ROOT/unity/Headless~/UnityEditor" -- "-r:$CSHARP/UnityEngine.dll"
  assembly Collektive.Unity.Editor.dll "$ROOT/unity/Editor" -- "${PACKAGE_REFERENCES[@]}" "-r:$CSHARP/UnityEditor.dll"
  assembly Collektive.Headless.Tests.dll "$ROOT/unity/Headless~/Tests" "$BUILD/csharp-tests" -- "${GENERATED_CODE_SYMBOLS[@]}" \
    "${PACKAGE_REFERENCES[@]}" "${editor[@]}" "-r:$CSHARP/Collektive.Player.exe" "-r:$NEWTONSOFT" "-r:$NUNIT"
  assembly UnityEngine.TestRunner.dll "$ROOT/unity/Headless~/TestFramework" -- "-r:$CSHARP/UnityEngine.dll" "-r:$NUNIT"
  assembly Collektive.TestRunner.exe "$ROOT/unity/Headless~/TestRunner" -- "-r:$CSHARP/UnityEngine.dll" "${framework[@]}" -target:exe
  assembly Collektive.Unity.Tests.dll "$ROOT/unity/Tests/Runtime" -- "${PACKAGE_REFERENCES[@]}" "${framework[@]}"
  assembly Collektive.Unity.PublicApi.Tests.dll "$ROOT/unity/Tests/PublicApi" -- "${PACKAGE_REFERENCES[@]}" "${framework[@]}"
  assembly Collektive.Unity.Editor.Tests.dll "$ROOT/unity/Tests/Editor" -- "${PACKAGE_REFERENCES[@]}" "${editor[@]}" "${framework[@]}"
  assembly Collektive.TwoEditors.exe "$ROOT/unity/Headless~/TwoEditors" -- "${PACKAGE_REFERENCES[@]}" "${editor[@]}" -target:exe
  assembly Collektive.WithoutLibrary.exe "$ROOT/unity/Headless~/WithoutLibrary" -- "${PACKAGE_REFERENCES[@]}" "${editor[@]}" \
    "-r:$CSHARP/Collektive.Headless.Tests.dll" -target:exe
  once stub-bridge "$(fingerprint "$ROOT/unity/Runtime/Bridge" "$CSHARP/Collektive.FlatBuffers.dll")" build_stub_bridge "$CSHARP/stubs"
  once documentation "$(fingerprint "$ROOT/unity/Runtime" "$CSHARP/Collektive.Unity.dll")" check_documentation
  library "$NUNIT"
}

# check_documentation: each public member of the package has XML documentation; flatc's code has none.
check_documentation() {
  local made
  made=$(mktemp -d)
  compile_documented "$made" Bridge "${GENERATED_CODE_SYMBOLS[@]}" "-r:$CSHARP/Collektive.FlatBuffers.dll"
  compile_documented "$made" Unity "${PACKAGE_REFERENCES[@]:0:3}"
  if cat "$made"/*.log | grep CS1591 | grep -v /Generated/; then fail "public members without documentation: see above"; fi
  rm -rf "$made"
}

# compile_documented FOLDER NAME OPTION...: compiles an assembly of Runtime with its documentation, and the compiler's messages, into FOLDER.
compile_documented() {
  local made=$1 name=$2
  shift 2
  sources "$ROOT/unity/Runtime/$name" | sed 's/.*/"&"/' >"$made/$name.rsp"
  # Under its own name, which may see internal members of the other.
  csc "$made/Collektive.$name.dll" -warnaserror- "-doc:$made/$name.xml" "$@" "@$made/$name.rsp" >"$made/$name.log" 2>&1
}

# build_stub_bridge FOLDER: the bridge as Unity compiles it for a player on a platform without the native library.
build_stub_bridge() {
  mkdir -p "$1"
  sources "$ROOT/unity/Runtime/Bridge" | sed 's/.*/"&"/' >"$1/Collektive.Bridge.rsp"
  csc "$1/Collektive.Bridge.dll" "${GENERATED_CODE_SYMBOLS[@]}" -define:UNITY_5_3_OR_NEWER "-r:$CSHARP/Collektive.FlatBuffers.dll" "@$1/Collektive.Bridge.rsp"
}

build_test_schemas() {
  once test-schemas "$(fingerprint "$ROOT/schema" "$PROBE/probe.fbs" "$GENERATOR_JAR")" generate_test_schemas "$BUILD/csharp-tests"
}

generate_test_schemas() {
  rm -rf "$1"
  mkdir -p "$1"
  local schema
  for schema in "$PROBE/probe.fbs" "$ROOT"/schema/test/*.fbs; do
    generator "$schema" --csharp "$1/$(basename "$schema" .fbs)"
  done
  # With sensor and actuator data swapped: the tests read what sensors write, and write what actuators read.
  mkdir -p "$BUILD/swapped/shared"
  for schema in features.fbs shared/cells.fbs; do
    sed -E 's/\btest\./swapped./; s/\bSensorData\b/Swap/; s/\bActuatorData\b/SensorData/; s/\bSwap\b/ActuatorData/' \
      "$ROOT/schema/test/$schema" >"$BUILD/swapped/$schema"
  done
  generator "$BUILD/swapped/features.fbs" --csharp "$1/swapped"
}

# test_csharp RESULTS JDK [RUNTIME [PART OF A TEST'S NAME]]: all C# tests on one runtime and one JVM.
test_csharp() {
  local jar runtime=${3:-mono-sgen} without=()
  # shellcheck disable=SC2310 # looks only
  if leaves_out_slow "$2" || { [ "$runtime" = coreclr ] && [ -n "${COLLEKTIVE_ALL:-}" ]; }; then without=(--without Slow); fi
  if [ "$runtime" = coreclr ]; then without+=(--without Mono); fi
  jar=$(programs_jar "$PROBE/probe.fbs" "$PROBE/programs")
  COLLEKTIVE_ROOT="$ROOT" COLLEKTIVE_HOST_JAR="$HOST_JAR" COLLEKTIVE_TEST_JAVA_HOME="$2" COLLEKTIVE_PROBE_JAR="$jar" \
    managed "$runtime" "$CSHARP/Collektive.TestRunner.exe" --results "$1/csharp.xml" "${without[@]}" \
    "$CSHARP/Collektive.Headless.Tests.dll" ${4:+"$4"} | tee "$1/output"
  if [ "$runtime" = coreclr ]; then
    sed -n "s/ tests of category Mono are left out/ C# tests were left out on CoreCLR: its hashes need OpenSSL 1.1, and limits of time are Mono's/p" \
      "$1/output" >"$1/notes"
  fi
}

# test_unity RESULTS: the package's own tests, which Unity's test framework runs in the editor.
test_unity() {
  local tests code=0 jars="$1/project/Packages/org.collektive.unity/unity/Jvm~"
  # As in a project with the package: its jars, and a JVM.
  mkdir -p "$jars"
  ln -s "$HOST_JAR" "$LIBRARY_JAR" "$ADAPTER_JAR" "$jars/"
  ln -s "$SAMPLES_JAR" "$jars/collektive-samples.jar"
  cd "$1/project"
  JAVA_HOME=$(find_jdk)
  export JAVA_HOME
  for tests in Collektive.Unity.Tests Collektive.Unity.PublicApi.Tests Collektive.Unity.Editor.Tests; do
    # shellcheck disable=SC2310 # its result is that of its last command
    COLLEKTIVE_ROOT="$ROOT" managed mono-sgen "$CSHARP/Collektive.TestRunner.exe" --results "$1/$tests.xml" "$CSHARP/$tests.dll" || code=$?
  done
  return "$code"
}

test_assets() {
  serialized_fields >"$BUILD/serialized-fields.txt"
  python_tests "$1" "$ROOT/scripts/validator"
}

test_faults() {
  build_faults "$BUILD/faults-short.json" mono-sgen "$(find_jdk)"
  python3 "$ROOT/scripts/faults/faults.py" "$BUILD/faults-short.json" --results "$1/faults.xml"
}

test_exits() {
  build_faults "$BUILD/faults.json" $'mono-sgen\nmono-boehm\ncoreclr' "$(test_jdks)"
  python3 "$ROOT/scripts/faults/exits.py" "$BUILD/faults.json" 4 --results "$1/exits.xml"
}

# test_roundtrip RESULTS: needs the test classes of frames, which the suite jvm compiles.
test_roundtrip() {
  local modules="$ROOT/jvm-host" work="$BUILD/roundtrip" jdk classes
  [ -d "$modules/frames/target/test-classes" ] || fail "the suite roundtrip needs the tests of frames: run ./collektive test jvm first"
  jdk=$(find_jdk)
  classes="$work:$modules/frames/target/test-classes:$HOST_JAR"
  build_roundtrip "$work"
  export_fuzz "$jdk"
  ROUNDTRIP_CSHARP="$CSHARP/RoundTrip.exe" ROUNDTRIP_CLASSES="$classes" ROUNDTRIP_JAVA="$jdk/bin/java" python_tests "$1" "$ROOT/schema/test"
}

# build_roundtrip CLASSES: both sides' code of the test schemas, and the C# half of the suite.
build_roundtrip() {
  local tests="$ROOT/unity/Headless~/Tests/Schema" bridge=("-r:$CSHARP/Collektive.FlatBuffers.dll" "-r:$CSHARP/Collektive.Bridge.dll")
  local schema
  setup_kotlin
  build_test_schemas
  assembly TestSchemas.dll "$BUILD/csharp-tests" -- "${GENERATED_CODE_SYMBOLS[@]}" "${bridge[@]}"
  assembly RoundTrip.exe "$tests/Dump.cs" "$tests/RandomData.cs" "$tests/RoundTrip.cs" -- "${bridge[@]}" -target:exe
  rm -rf "$1"
  mkdir -p "$1"
  for schema in "$ROOT"/schema/test/*.fbs; do
    generator "$schema" --jvm "$1/generated"
    # What the tests of frames compare with.
    "$FLATC" --java --gen-object-api --gen-all --no-warnings --java-package-prefix objects -I "$ROOT/schema" -o "$1/generated" "$schema"
  done
  compile_jvm "$LIBRARY_JAR" "$1/generated" "$1"
}

# The suites below use other commands, which lock build/ themselves.

test_page() {
  local sample="$BUILD/page-sample"
  "$ROOT/collektive" demo --nodes 60 --seconds 10 --out "$BUILD/page-demo" --overwrite
  assembly SampleReplay.exe "$ROOT/unity/Headless~/SampleReplay" "$ROOT/unity/Headless~/Replay" -- "-r:$NEWTONSOFT" -target:exe
  mkdir -p "$sample"
  mono-sgen "$CSHARP/SampleReplay.exe" "$BUILD/replay.html" "$sample/replay.html" 60 200
  mono-sgen "$CSHARP/SampleReplay.exe" "$BUILD/replay.html" "$sample/large.html" 10000 60
  page_tests "$1/demo.xml" "$BUILD/page-demo/replay.html"
  page_tests "$1/sample.xml" "$sample/replay.html" "$sample/replay.html.expected.json"
  page_tests "$1/large.xml" "$sample/large.html" "$sample/large.html.expected.json"
}

# page_tests RESULTS.xml PAGE [EXPECTED.json]
page_tests() {
  COLLEKTIVE_NODE_MODULES="$BUILD/npm/node_modules" node --test-reporter=spec --test-reporter-destination=stdout --test-reporter=junit \
    --test-reporter-destination="$1" "$ROOT/unity/Headless~/Replay/test.mjs" "${@:2}"
}

# test_site RESULTS: its pages at three widths, in the light and in the dark; the pictures stay in build/site-pictures.
test_site() {
  "$ROOT/collektive" site --out "$BUILD/site"
  COLLEKTIVE_NODE_MODULES="$BUILD/npm/node_modules" node --test-reporter=spec --test-reporter-destination=stdout --test-reporter=junit \
    --test-reporter-destination="$1/site.xml" "$ROOT/scripts/site/test.mjs" "$BUILD/site" "$BUILD/site-pictures"
}

# test_acceptance RESULTS: what measures times alone, the rest by two.
test_acceptance() {
  local code=0
  unlock
  # shellcheck disable=SC2310 # its result is that of its last command
  python_tests "$1" "$ROOT/scripts/acceptance" -m alone || code=$?
  python_tests "$1" "$ROOT/scripts/acceptance" -m "not alone" -n 2 --dist loadgroup
  return "$code"
}

# test_acceptance_quick RESULTS: the cases that matter most.
test_acceptance_quick() {
  unlock
  python_tests "$1" "$ROOT/scripts/acceptance" -m quick -n 2 --dist loadgroup
}

# test_gradle RESULTS: compares what Gradle makes of the JVM side with what Maven made.
test_gradle() { python_tests "$1" "$ROOT/scripts/gradle"; }

test_bench() {
  unlock
  python_tests "$1" "$ROOT/scripts/bench"
}
