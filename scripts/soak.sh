# ./collektive test soak and --soak: whether memory, threads or descriptors grow while nodes come, fail and go.

# test_soak RESULTS: less than half a minute.
test_soak() { soak 24 results="$1/soak.xml"; }

soak_at_length() {
  [[ ${1:-} =~ ^[0-9]*\.?[0-9]+$ ]] || fail "test: --soak needs a number of minutes"
  build_jvm
  build_csharp
  build_soak
  soak "$(awk -v minutes="$1" 'BEGIN { print 60 * minutes }')"
}

build_soak() {
  build_csharp_tests
  assembly Collektive.Soak.exe "$ROOT/unity/Headless~/Soak" -- "${PACKAGE_REFERENCES[@]}" "-r:$CSHARP/Collektive.Headless.Tests.dll" -target:exe
}

# soak SECONDS [KEY=VALUE]
soak() {
  local jar
  jar=$(programs_jar "$PROBE/probe.fbs" "$FAULTS/programs")
  managed mono-sgen "$CSHARP/Collektive.Soak.exe" home="$(find_jdk)" host="$HOST_JAR" jar="$jar" seconds="$1" "${@:2}"
}
