# ./collektive test stress and --stress: races between threads (jcstress).

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
