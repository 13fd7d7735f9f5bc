# ./collektive bench: measurements.

BENCH_JAR="$ROOT/jvm-host/bench/target/collektive-bench.jar"

help_bench() {
  cat <<'H'
usage: ./collektive bench rounds [--quick]
       ./collektive bench tick [--quick] [--nodes N,N...] [--out FILE]
       ./collektive bench scene [--quick] [--nodes N,N...] [--out FILE]

rounds What a round of aggregate programs costs on the engine, time and garbage, beside plain loops; measured with JMH. Prints a table
       and writes build/bench/rounds.json. About eight minutes, three with --quick.
tick   What a tick costs, all in one run and in turn: in-process (this product), the same shim with a call for each node, the same
       frames over a TCP socket, the rounds without the boundary, plain loops; then an empty tick and the addition of nodes. Prints a
       table and what is promised, and writes build/bench/tick.json. --quick takes under two minutes on two idle cores; without it
       there are more ticks and a run of 20,000 (pauses, memory). Times of a busy machine mean little.
scene  What whole ticks of a scene cost, physics included: the case study with 500 to 50,000 bodies, each size in a process of its own, on a field
       that grows with the swarm. Prints a table with the phases of a tick, memory, and the growth of a node's cost over that of the first size,
       and writes build/bench/scene.json. About two minutes on two idle cores; --quick measures half as long.
H
}

build_bench() {
  build_all
  assembly Collektive.Headless.Bench.exe "$ROOT/unity/Headless~/Bench" "$ROOT/unity/Headless~/Player/Quantiles.cs" \
    "$ROOT/unity/Samples~/GradientAscent/Generated" -- "${GENERATED_CODE_SYMBOLS[@]}" "-r:$CSHARP/Collektive.FlatBuffers.dll" \
    "-r:$CSHARP/Collektive.Bridge.dll" "-r:$NEWTONSOFT" -target:exe
}

cmd_bench() {
  case ${1:-} in
    rounds) shift; bench_rounds "$@" ;;
    tick) shift; bench_tick "$@" ;;
    scene) shift; bench_scene "$@" ;;
    *) fail "bench: name what to measure: rounds, tick or scene (see ./collektive bench --help)" ;;
  esac
}

bench_tick() {
  local out="$BUILD/bench/tick.json" arguments=()
  while [ $# -gt 0 ]; do
    case $1 in
      --quick) arguments+=(--quick); shift ;;
      --nodes) [ $# -ge 2 ] || fail "bench tick: --nodes needs numbers with commas between them"; arguments+=(--nodes "$2"); shift 2 ;;
      --out) out=${2:?--out needs a file}; shift 2 ;;
      *) fail "bench tick: unknown argument $1 (see ./collektive bench --help)" ;;
    esac
  done
  setup_system
  build_bench
  managed mono-sgen "$CSHARP/Collektive.Headless.Bench.exe" --java-home "$(find_jdk)" --host-jar "$HOST_JAR" --jar "$SAMPLES_JAR" --jar "$BENCH_JAR" \
    --out "$out" "${arguments[@]}"
  say "wrote $out"
}

bench_scene() {
  local out="$BUILD/bench/scene.json" arguments=() sample="$ROOT/unity/Samples~/GradientAscent"
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a file}; shift 2 ;;
      *) arguments+=("$1"); shift ;;
    esac
  done
  setup_system
  build_all
  # Before the runs: their memory is measured with that of all processes that they start.
  scripts_dll "$sample/gradient_ascent.fbs" "$sample" >/dev/null
  python3 "$ROOT/scripts/bench_scene.py" "$out" "${arguments[@]}"
  say "wrote $out"
}

bench_rounds() {
  case ${1:-} in "" | --quick) ;; *) fail "bench rounds: unknown argument $1 (see ./collektive bench --help)" ;; esac
  setup_system
  build_jvm
  mkdir -p "$BUILD/bench"
  local java quiet=()
  java="$(find_jdk)/bin/java"
  # JMH uses what newer JVMs warn of, in each process that it starts.
  "$java" --sun-misc-unsafe-memory-access=allow -version >/dev/null 2>&1 && quiet=(--sun-misc-unsafe-memory-access=allow)
  "$java" "${quiet[@]}" -cp "$BENCH_JAR:$ROOT/jvm-host/bench/target/lib/*:$HOST_JAR:$LIBRARY_JAR:$SAMPLES_JAR" org.collektive.bench.rounds.RoundsKt \
    "$BUILD/bench/rounds.json" "$@"
  say "wrote $BUILD/bench/rounds.json"
}
