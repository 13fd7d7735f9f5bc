# ./collektive test: every suite, and one line with the sum of their real results at the end.

PROBE="$ROOT/unity/Headless~/Tests/Simulation/Probe"

help_test() {
  cat <<'H'
usage: ./collektive test [SUITE]... | --faults [WORDS] | --exits | --sanitize | bare [ROOT]...

Builds and tests everything, or the suites named: shim, jvm, csharp, assets, roundtrip, page, acceptance, bench, faults, exits.
  --faults    each fault of scripts/faults/faults.json (or those with WORDS in their name) on every runtime and JVM: a table
  --exits     200 runs that end in each way: the scene is left, quit, Ctrl-C, unhandled exceptions
  --sanitize  the shim's tests under AddressSanitizer and UndefinedBehaviorSanitizer
  bare        the demo and the quick tests of the last commit in fresh roots of debian-12, debian-13 and ubuntu-24.04 (or those named),
              as root; one whose packages cannot be had is skipped
The last line is "N passed, N failed" over all that ran; the exit code is 1 when a test failed. A changed public API of the JVM
side fails the suite jvm, which then shows the difference from jvm-host/*/api/*.api and the command that accepts it.
H
}

TOTAL_PASSED=0
TOTAL_FAILED=0

# suite NAME COMMAND...: runs a suite that prints "N passed, N failed" as its last such line, and adds that up.
suite() {
  local name=$1 log="$BUILD/log/test-$1.log" code=0 result passed failed
  shift
  mkdir -p "$BUILD/log"
  say "test $name ..."
  # In a shell of its own: a step that ends it fails this suite only.
  ("$@") >"$log" 2>&1 || code=$?
  result=$(grep -aoE '[0-9]+ passed, [0-9]+ failed' "$log" | tail -n 1) || true
  passed=${result%% passed*}
  failed=${result##*, }
  failed=${failed%% failed*}
  if [ -z "$result" ] || { [ "$code" != 0 ] && [ "$failed" = 0 ]; }; then
    failed=$((${failed:-0} + 1))
    passed=${passed:-0}
    echo "suite $name ended with code $code${result:+ after \"$result\"}" >>"$log"
  fi
  TOTAL_PASSED=$((TOTAL_PASSED + passed))
  TOTAL_FAILED=$((TOTAL_FAILED + failed))
  [ "$failed" = 0 ] || tail -n 80 "$log" >&2
  say "test $name: $passed passed, $failed failed"
}

# The JDKs that the tests run on: all of this machine that are of version 17 or newer.
test_jdks() {
  local jdk
  { for jdk in /usr/lib/jvm/*; do if is_jdk "$jdk" && [ "$(jdk_version "$jdk")" -ge 17 ]; then readlink -f "$jdk"; fi; done; find_jdk; } | sort -u
}

test_shim() {
  cmake_configure && cmake --build "$BUILD/cmake" -j 2 && shim_cases "$BUILD/cmake"
}

test_sanitized_shim() {
  cmake -S "$ROOT/native-shim" -B "$BUILD/sanitized" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCOLLEKTIVE_SANITIZE=ON \
    -DCOLLEKTIVE_JAVA_HOME="$(find_jdk)" && cmake --build "$BUILD/sanitized" -j 2 && shim_cases "$BUILD/sanitized"
}

# shim_cases BUILD: the shim's tests of a CMake build, on every JVM. A run that tells no sum counts as one failure.
shim_cases() {
  local jdk passed=0 failed=0 log sum
  for jdk in $(test_jdks); do
    echo "== $jdk"
    log=$(CLK_TEST_JAVA_HOME="$jdk" ctest --test-dir "$1" --output-on-failure -j 2) || true
    printf '%s\n' "$log"
    sum=$(printf '%s\n' "$log" | sed -n 's/.*, \([0-9]*\) tests failed out of \([0-9]*\).*/\1 \2/p' | tail -n 1)
    sum=${sum:-1 1}
    failed=$((failed + ${sum% *}))
    passed=$((passed + ${sum#* } - ${sum% *}))
  done
  echo "$passed passed, $failed failed"
  [ "$failed" = 0 ]
}

test_jvm() {
  local code=0
  find "$ROOT/jvm-host" -path '*/target/surefire-reports/*.xml' -delete
  maven package -Dmaven.test.failure.ignore=true || code=$?
  [ "$code" = 0 ] && jvm_fingerprint >"$BUILD/stamp/jvm-host"
  python3 - "$ROOT/jvm-host" <<'P' || code=1
import glob, sys, xml.etree.ElementTree as tree
total = bad = 0
for path in glob.glob(sys.argv[1] + "/*/target/surefire-reports/TEST-*.xml"):
    suite = tree.parse(path).getroot()
    total += int(suite.get("tests")) - int(suite.get("skipped"))
    bad += int(suite.get("failures")) + int(suite.get("errors"))
print(f"{total - bad} passed, {bad} failed")
sys.exit(bad > 0)
P
  return $code
}

build_csharp_tests() {
  [ -e "$NUNIT" ] || fail "this system has no package of NUnit 2.6, which the C# tests need"
  local work="$BUILD/csharp-tests" schema key
  key=$(fingerprint "$ROOT/schema" "$PROBE/probe.fbs" "$GENERATOR_JAR")
  once test-schemas "$key" generate_test_schemas "$work"
  local package="$CSHARP/Collektive.FlatBuffers.dll $CSHARP/Collektive.Bridge.dll $CSHARP/UnityEngine.dll $CSHARP/Collektive.Unity.dll"
  assembly UnityEditor.dll "$CSHARP/UnityEngine.dll" "$ROOT/unity/Headless~/UnityEditor"
  assembly Collektive.Unity.Editor.dll "$package $CSHARP/UnityEditor.dll" "$ROOT/unity/Editor"
  assembly Collektive.Headless.Tests.dll "$package $CSHARP/UnityEditor.dll $CSHARP/Collektive.Unity.Editor.dll $CSHARP/Collektive.Player.exe $NUNIT" \
    "$ROOT/unity/Headless~/Tests" "$work" -- $GENERATED_CODE_SYMBOLS
  local framework="$CSHARP/UnityEngine.TestRunner.dll $NUNIT"
  assembly UnityEngine.TestRunner.dll "$CSHARP/UnityEngine.dll" "$ROOT/unity/Headless~/TestFramework"
  assembly Collektive.TestRunner.exe "$CSHARP/UnityEngine.dll $framework" "$ROOT/unity/Headless~/TestRunner" -- -target:exe
  assembly Collektive.Unity.Tests.dll "$package $framework" "$ROOT/unity/Tests/Runtime"
  assembly Collektive.Unity.PublicApi.Tests.dll "$package $framework" "$ROOT/unity/Tests/PublicApi"
  assembly Collektive.Unity.Editor.Tests.dll "$package $CSHARP/UnityEditor.dll $CSHARP/Collektive.Unity.Editor.dll $framework" "$ROOT/unity/Tests/Editor"
}

generate_test_schemas() {
  rm -rf "$1"
  mkdir -p "$1"
  local schema
  for schema in "$PROBE/probe.fbs" "$ROOT"/schema/test/*.fbs; do
    generator "$schema" --csharp "$1/$(basename "$schema" .fbs)" || return 1
  done
}

# csharp_tests RUNTIME JDK: all C# tests on one runtime and one JVM.
csharp_tests() {
  local jar
  setup_kotlin
  jar=$(programs_jar "$PROBE/probe.fbs" "$PROBE/programs") || return 1
  cp -u "$NUNIT" "$CSHARP/"
  COLLEKTIVE_ROOT="$ROOT" COLLEKTIVE_HOST_JAR="$HOST_JAR" COLLEKTIVE_TEST_JAVA_HOME="$2" COLLEKTIVE_PROBE_JAR="$jar" \
    managed "$1" "$CSHARP/Collektive.TestRunner.exe" "$CSHARP/Collektive.Headless.Tests.dll" ${3:+"$3"}
}

# unity_tests RUNTIME: the package's own tests, which Unity's test framework runs in the editor. One that ends badly after its sum counts as a failure more.
unity_tests() {
  local tests passed=0 failed=0 log sum code
  cp -u "$NUNIT" "$CSHARP/"
  for tests in Collektive.Unity.Tests Collektive.Unity.PublicApi.Tests Collektive.Unity.Editor.Tests; do
    code=0
    log=$(COLLEKTIVE_ROOT="$ROOT" managed "$1" "$CSHARP/Collektive.TestRunner.exe" "$CSHARP/$tests.dll") || code=$?
    printf '%s\n' "$log"
    sum=$(printf '%s\n' "$log" | grep -xE '[0-9]+ passed, [0-9]+ failed' | tail -n 1) || sum="0 passed, 0 failed"
    sum=${sum% failed}
    passed=$((passed + ${sum%% passed*}))
    failed=$((failed + ${sum##*, }))
    if [ "$code" != 0 ] && [ "${sum##*, }" = 0 ]; then
      echo "$tests ended with code $code"
      failed=$((failed + 1))
    fi
  done
  echo "$passed passed, $failed failed"
  [ "$failed" = 0 ]
}

test_assets() {
  serialized_fields >"$BUILD/serialized-fields.txt" || return 1
  python3 "$ROOT/scripts/validator/tests.py" "$ROOT" "$BUILD/serialized-fields.txt"
}

test_acceptance() {
  python3 "$ROOT/scripts/acceptance/acceptance.py" "$ROOT"
}

wanted() {
  if [ ${#SUITES[@]} != 0 ]; then [[ " ${SUITES[*]} " == *" $1 "* ]]; return; fi
  if [[ " csharp faults exits " == *" $1 "* ]] && [ ! -e "$NUNIT" ]; then say "test $1: skipped, this system has no package of NUnit 2.6"; return 1; fi
}

cmd_test() {
  local known="shim jvm csharp assets roundtrip page acceptance bench faults exits" name jdk
  case ${1:-} in
    --faults) test_at_length --faults "${*:2}"; return ;;
    bare) test_bare "${@:2}"; return ;;
    --exits | --sanitize) [ $# = 1 ] || fail "test: $1 takes no arguments"; test_at_length "$1"; return ;;
  esac
  SUITES=("$@")
  for name in "$@"; do [[ " $known " == *" $name "* ]] || fail "test: unknown suite '$name'; known: $known"; done
  setup_system
  setup_nunit
  build_native
  if wanted jvm; then
    setup_flatc
    suite jvm test_jvm
  fi
  build_jvm
  build_csharp
  if wanted shim; then suite shim test_shim; fi
  if wanted csharp; then
    build_csharp_tests
    suite unity unity_tests mono-sgen
    for jdk in $(test_jdks); do suite "csharp-on-$(basename "$jdk")" csharp_tests mono-sgen "$jdk"; done
  fi
  if wanted assets; then suite assets test_assets; fi
  if wanted faults; then
    build_faults "$BUILD/faults-short.json" mono-sgen "$(find_jdk)"
    suite faults faults "$BUILD/faults-short.json"
  fi
  if wanted exits; then
    build_faults "$BUILD/faults.json" "mono-sgen mono-boehm" "$(test_jdks | xargs)"
    suite exits exits "$BUILD/faults.json" 10
  fi
  if wanted roundtrip; then suite roundtrip bash "$ROOT/schema/test/roundtrip.sh"; fi
  if wanted page || wanted acceptance; then build_replay_page; fi
  if wanted acceptance; then suite acceptance test_acceptance; fi
  if wanted bench; then suite bench python3 "$ROOT/scripts/bench_test.py" "$ROOT"; fi
  if wanted page; then suite page test_page; fi
  echo "$TOTAL_PASSED passed, $TOTAL_FAILED failed"
  [ "$TOTAL_FAILED" = 0 ]
}

# What takes long, with its whole output.
test_at_length() {
  setup_system
  setup_nunit
  build_native
  if [ "$1" = --sanitize ]; then test_sanitized_shim; return; fi
  build_jvm
  build_csharp
  build_faults "$BUILD/faults.json" "mono-sgen mono-boehm" "$(test_jdks | xargs)"
  if [ "$1" = --faults ]; then faults "$BUILD/faults.json" "$2"; else exits "$BUILD/faults.json" 200; fi
}

test_page() {
  "$ROOT/collektive" demo --nodes 60 --seconds 10 --out "$BUILD/page-demo" || return 1
  COLLEKTIVE_NODE_MODULES="$BUILD/npm/node_modules" node "$ROOT/unity/Headless~/Replay/test.mjs" "$BUILD/page-demo/replay.html"
}
