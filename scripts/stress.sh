# ./collektive test stress, --stress and fuzz: races between threads (jcstress) and frames of any bytes (Jazzer).

# Under a minute on two idle processors, with some hundred thousand tries of each race: the server compiler alone, one fork each. Threads of
# a pool must not inherit the one processor that jcstress gives an actor.
STRESS_SHORT=(-f 1 -fsm 1 -iters 3 -time 200 -sc false -af NONE -jvmArgs -XX:-TieredCompilation)

# test_stress RESULTS [OPTION OF jcstress]...
test_stress() {
  local results=$1 modules="$ROOT/jvm-host/stress/target" java
  shift
  java="$(find_jdk)/bin/java"
  [ $# -gt 0 ] || set -- "${STRESS_SHORT[@]}"
  mkdir -p "$BUILD/stress"
  # It writes its own results into the working folder.
  cd "$BUILD/stress"
  "$java" -cp "$modules/collektive-stress.jar:$modules/lib/*" org.collektive.stress.Main "$results/stress.xml" -r "$BUILD/stress/report" "$@"
}

stress_at_length() {
  lock -s
  build_jvm
  test_stress "$BUILD/results/stress-at-length" -m default -af NONE
}

# test_fuzz [MINUTES]: open, step and control, each for so long.
test_fuzz() {
  local minutes=${1:-5} entry java findings failed=0
  [[ $# -le 1 && $minutes =~ ^[1-9][0-9]*$ ]] || fail "test fuzz: name whole minutes (see ./collektive test --help)"
  java="$(find_jdk)/bin/java"
  lock -x
  setup_flatc
  package_jvm -q -pl host -am -Pfuzz -DskipTests
  lock -s
  for entry in open step control; do
    mkdir -p "$BUILD/fuzz/$entry/corpus" "$BUILD/fuzz/$entry/findings"
    say "fuzz $entry for $minutes min ..."
    # shellcheck disable=SC2310 # returns at its first error
    fuzz "$entry" "$java" $((60 * minutes)) >"$BUILD/log/fuzz-$entry.log" 2>&1 || failed=1
    findings=$(find "$BUILD/fuzz/$entry/findings" -type f | wc -l)
    say "fuzz $entry: $(grep -aE '^Done [0-9]+ runs' "$BUILD/log/fuzz-$entry.log" || echo "ended early"), $findings findings in $BUILD/fuzz/$entry/findings"
  done
  [ "$failed" = 0 ] || fail "test fuzz: see $BUILD/log/fuzz-*.log; mend the defect and copy its input to jvm-host/host/src/test/corpus"
}

# fuzz ENTRY JAVA SECONDS: Jazzer on one entry of the host. What it learns stays in build/fuzz for the next time.
fuzz() {
  local work="$BUILD/fuzz/$1"
  cd "$ROOT/jvm-host/host"
  "$2" -Xmx768m -XX:+EnableDynamicAgentLoading -Dcollektive.root="$ROOT" -Dcollektive.flatc="$BUILD/flatc" \
    -cp "target/test-classes:target/classes:target/fuzz/*" \
    com.code_intelligence.jazzer.Jazzer "--target_class=org.collektive.host.fuzz.${1^}Fuzzer" \
    --instrumentation_includes='org.collektive.**:com.google.flatbuffers.**' --instrumentation_excludes='org.collektive.generator.**' \
    --custom_hook_includes='org.collektive.**' --custom_hook_excludes='org.collektive.generator.**' --keep_going=20 \
    --reproducer_path="$work" -artifact_prefix="$work/findings/" -max_total_time="$3" -timeout=60 -rss_limit_mb=4000 "$work/corpus" "src/test/corpus/$1"
}
