# ./collektive test fuzz and --fuzz: inputs of any kind, for all that reads what others wrote. Corpora are kept in the repository: the suites
# replay them, and each input that showed a defect is one of their cases. What fuzzing learns stays in build/fuzz for the next time.

FUZZERS="open step control record scenario schemas shim"
FUZZ="$ROOT/unity/Headless~/Fuzz"

# test_fuzz RESULTS: scenario files. Corpora and random inputs of the other fuzzers are cases of the suites jvm, roundtrip and shim.
test_fuzz() { fuzz_scenario 5 "$(date +%j)" "$1/scenario.xml"; }

# fuzz_at_length [NAME]... [MINUTES [SEED]]: all fuzzers, or those named, for so long each.
fuzz_at_length() {
  local names=() name minutes seed findings failed=0
  while [ $# -gt 0 ] && [[ ! $1 =~ ^[0-9] ]]; do
    [[ " $FUZZERS " = *" $1 "* ]] || fail "test --fuzz: there is no fuzzer '$1'; there are: $FUZZERS"
    names+=("$1")
    shift
  done
  minutes=${1:-5} seed=${2:-$(date +%s)}
  [[ $minutes =~ ^[1-9][0-9]*$ && $seed =~ ^[0-9]+$ && $# -le 2 ]] || fail "test --fuzz: name whole minutes, and a seed (see ./collektive test --help)"
  # shellcheck disable=SC2206 # a word each
  [ ${#names[@]} -gt 0 ] || names=($FUZZERS)
  build_fuzzers
  build_csharp
  build_fuzz
  for name in "${names[@]}"; do
    mkdir -p "$BUILD/fuzz/$name/corpus" "$BUILD/fuzz/$name/findings"
    say "fuzz $name for $minutes min, seed $seed ..."
    # shellcheck disable=SC2310 # returns at its first error
    fuzz "$name" $((60 * minutes)) "$seed" >"$BUILD/log/fuzz-$name.log" 2>&1 || failed=1
    findings=$(find "$BUILD/fuzz/$name/findings" -mindepth 1 -maxdepth 1 | wc -l)
    say "fuzz $name: $(grep -aE '^Done [0-9]+ runs' "$BUILD/log/fuzz-$name.log" || echo "ended early"), $findings findings in $BUILD/fuzz/$name/findings"
  done
  [ "$failed" = 0 ] || fail "test --fuzz: see $BUILD/log/fuzz-*.log; mend the defect and copy its input to the fuzzer's corpus"
}

# build_fuzzers: the JVM side with its tests and Jazzer.
build_fuzzers() {
  setup_flatc
  [ -d "$ROOT/jvm-host/host/target/fuzz" ] || rm -f "$BUILD/stamp/fuzzers"
  once fuzzers "$(jvm_fingerprint)" package_jvm -q -Pfuzz -DskipTests
  cp "$BUILD/stamp/fuzzers" "$BUILD/stamp/jvm-host"
}

# fuzz NAME SECONDS SEED
fuzz() {
  local modules="$ROOT/jvm-host"
  case $1 in
    scenario) fuzz_scenario "$2" "$3" ;;
    schemas) fuzz_schemas "$2" "$3" ;;
    shim) fuzz_shim "$2" "$3" ;;
    record)
      jazzer record "$2" "$3" org.collektive.tools.record.RecordFuzzer "$modules/tools" "$modules/tools/src/test/corpus/record"
      ;;
    *) jazzer "$1" "$2" "$3" "org.collektive.host.fuzz.${1^}Fuzzer" "$modules/host" "$modules/host/src/test/corpus/$1" ;;
  esac
}

# jazzer NAME SECONDS SEED CLASS MODULE CORPUS
jazzer() {
  local work="$BUILD/fuzz/$1" host="$ROOT/jvm-host/host/target" compiler
  # Before all others: another jar has some of its classes without all of their functions.
  compiler=$(find "$host/fuzz" -name 'kotlin-compiler-embeddable-*.jar')
  cd "$5"
  "$(find_jdk)/bin/java" -Xmx768m -XX:+EnableDynamicAgentLoading -Dcollektive.root="$ROOT" -Dcollektive.flatc="$BUILD/flatc" \
    -cp "target/test-classes:target/classes:$host/test-classes:$host/classes:$compiler:$host/fuzz/*" \
    com.code_intelligence.jazzer.Jazzer "--target_class=$4" \
    --instrumentation_includes='org.collektive.**:com.google.flatbuffers.**' --instrumentation_excludes='org.collektive.generator.**' \
    --custom_hook_includes='org.collektive.**' --custom_hook_excludes='org.collektive.generator.**' --keep_going=20 \
    --reproducer_path="$work" -artifact_prefix="$work/findings/" -max_total_time="$2" -seed=$(($3 % 4294967296)) -timeout=60 \
    -rss_limit_mb=4000 "$work/corpus" "$6"
}

build_fuzz() {
  assembly Collektive.Fuzz.exe "$FUZZ" -- "-r:$CSHARP/Collektive.Player.exe" "-r:$NEWTONSOFT" -target:exe
}

# fuzz_scenario SECONDS SEED [RESULTS.xml]
fuzz_scenario() {
  managed mono-sgen "$CSHARP/Collektive.Fuzz.exe" "$FUZZ/corpus/scenario" "$BUILD/fuzz/scenario/findings" "$1" $(($2 % 2147483648)) ${3:+"$3"}
}

# fuzz_shim SECONDS SEED: what crashes names its seed, which joins the corpus in native-shim/test/fuzz.c.
fuzz_shim() {
  local log="$BUILD/fuzz/shim/findings/seed-$2.log" code=0 jdk asan
  jdk=$(find_jdk)
  build_sanitized
  cd "$BUILD/sanitized"
  asan=$(find . -name asan_options -exec cat {} +)
  ASAN_OPTIONS=$asan CLK_TEST_JAVA_HOME=$jdk CLK_FUZZ_SECONDS=$1 CLK_FUZZ_SEED=$2 test/shim_test fuzz >"$log" 2>&1 || code=$?
  tr '\r' '\n' <"$log" | tail -n 60
  if [ "$code" = 0 ]; then rm "$log"; fi
  return "$code"
}

# export_fuzz JDK: what schema/test/fuzz.py needs. The suite jvm compiles it, or `test --fuzz`.
export_fuzz() {
  local modules="$ROOT/jvm-host"
  export FUZZ_JAVA="$1/bin/java" FUZZ_FLATC="$FLATC"
  export FUZZ_GENERATOR="$modules/generator/target/test-classes:$GENERATOR_JAR" FUZZ_FRAMES="$modules/frames/target/test-classes:$HOST_JAR"
}

# fuzz_schemas SECONDS SEED: batches of random schemas.
fuzz_schemas() {
  setup_python
  setup_kotlin
  build_roundtrip "$BUILD/roundtrip"
  export_fuzz "$(find_jdk)"
  "$PYTHON" "$ROOT/schema/test/fuzz.py" "$1" "$2"
}

# compile_fuzzed FOLDER: both sides' code that schema/test/fuzz.py has generated there.
compile_fuzzed() {
  local folder=$1
  (cd "$folder" && find csharp -name '*.cs' -printf '"'"$folder"'/%p"\n' | LC_ALL=C sort >sources.rsp)
  csc "$folder/TestSchemas.dll" "${GENERATED_CODE_SYMBOLS[@]}" "-r:$CSHARP/Collektive.FlatBuffers.dll" "-r:$CSHARP/Collektive.Bridge.dll" "@$folder/sources.rsp"
  cp "$CSHARP"/{RoundTrip.exe,Collektive.FlatBuffers.dll,Collektive.Bridge.dll} "$folder"
  mkdir -p "$folder/classes"
  compile_jvm "$LIBRARY_JAR" "$folder/jvm" "$folder/classes"
}
