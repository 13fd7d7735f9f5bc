# Faults and exits: what scripts/faults needs, each in a real process, on every runtime and JVM.

FAULTS="$ROOT/unity/Headless~/Faults"

# build_faults FILE RUNTIMES JDKS: builds what faults.py and exits.py run, and writes where it is. Several runtimes or JDKs take a line each.
build_faults() {
  local jar misfit="$BUILD/misfit"
  build_csharp_tests
  assembly Collektive.Faults.exe "$FAULTS" -- "${PACKAGE_REFERENCES[@]}" "-r:$CSHARP/Collektive.Headless.Tests.dll" -target:exe
  jar=$(programs_jar "$PROBE/probe.fbs" "$FAULTS/programs")
  once misfit "$(fingerprint "$ROOT/native-shim/test/misfit")" build_misfit "$misfit"
  python3 "$ROOT/scripts/faults/write_places.py" "$1" runtimes="$2" jdks="$3" program="$CSHARP/Collektive.Faults.exe" \
    player="$CSHARP/Collektive.Player.exe" shim="$SHIM" host="$HOST_JAR" jar="$jar" misfit="$misfit/host.jar" schema="$PROBE/probe.fbs"
}

# build_misfit DIR: a host jar of another version.
build_misfit() {
  local jdk
  jdk=$(find_jdk)
  rm -rf "$1"
  mkdir -p "$1/classes"
  "$jdk/bin/javac" --release 17 -nowarn -d "$1/classes" "$ROOT"/native-shim/test/misfit/org/collektive/host/*.java \
    "$ROOT"/native-shim/test/misfit/org/collektive/host/shim/*.java
  "$jdk/bin/jar" --create --file "$1/host.jar" -C "$1/classes" .
}
