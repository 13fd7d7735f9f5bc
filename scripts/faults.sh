# Faults and exits: each in a real process, on every runtime and JVM. ./collektive test --faults and --exits.

FAULTS="$ROOT/unity/Headless~/Faults"

# build_faults FILE RUNTIMES JDKS: builds what the two scripts run, and writes where it is.
build_faults() {
  local jar misfit="$BUILD/misfit"
  build_csharp_tests
  assembly Collektive.Faults.exe \
    "$CSHARP/Collektive.FlatBuffers.dll $CSHARP/Collektive.Bridge.dll $CSHARP/UnityEngine.dll $CSHARP/Collektive.Unity.dll $CSHARP/Collektive.Headless.Tests.dll" \
    "$FAULTS" -- -target:exe
  cp -u "$NUNIT" "$CSHARP/"
  jar=$(programs_jar "$PROBE/probe.fbs" "$FAULTS/programs") || exit 1
  once misfit "$(fingerprint "$ROOT/native-shim/test/misfit")" build_misfit "$misfit"
  python3 - "$1" "$2" "$3" <<P
import json, sys
json.dump({"runtimes": sys.argv[2].split(), "jdks": sys.argv[3].split(), "jobs": 2, "program": "$CSHARP/Collektive.Faults.exe",
           "player": "$CSHARP/Collektive.Player.exe", "shim": "$SHIM", "host": "$HOST_JAR", "jar": "$jar", "misfit": "$misfit/host.jar",
           "schema": "$PROBE/probe.fbs"}, open(sys.argv[1], "w"))
P
}

# build_misfit DIR: a host jar of another version.
build_misfit() {
  rm -rf "$1" && mkdir -p "$1/classes" &&
    "$(find_jdk)/bin/javac" --release 17 -nowarn -d "$1/classes" "$ROOT"/native-shim/test/misfit/org/collektive/host/*.java &&
    "$(find_jdk)/bin/jar" --create --file "$1/host.jar" -C "$1/classes" .
}

# faults PLACES [WORDS]
faults() { python3 "$ROOT/scripts/faults/faults.py" "$@"; }

# exits PLACES RUNS
exits() { python3 "$ROOT/scripts/faults/exits.py" "$@"; }
