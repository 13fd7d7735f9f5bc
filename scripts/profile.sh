# ./collektive profile: where a scenario's time goes on the JVM.

help_profile() {
  cat <<'H'
usage: ./collektive profile SCENARIO.json [--seed K] [--seconds S] [--out DIR] [--overwrite] [--set KEY=VALUE]... [--trust-jvm]

Runs a scenario as ./collektive run does, with a flight recording of the JVM, and prints what it tells: times of ticks, for each program
its rounds and the methods where their time goes, allocation, and pauses. The recording is profile.jfr in --out (default:
out/NAME-profile, where it replaces the former one); JDK Mission Control and the JDK's jfr command open it.
H
}

cmd_profile() {
  local scenario= out= arguments=()
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --overwrite | --keep-going | --trust-jvm) arguments+=("$1"); shift ;;
      --seed | --seconds | --set) [ $# -ge 2 ] || fail "profile: $1 needs a value"; arguments+=("$1" "$2"); shift 2 ;;
      -*) fail "profile: unknown option $1 (see ./collektive profile --help)" ;;
      *) [ -z "$scenario" ] || fail "profile: one scenario at a time"; scenario=$1; shift ;;
    esac
  done
  [ -n "$scenario" ] || fail "profile: name a scenario file (see ./collektive profile --help)"
  if [ -z "$out" ]; then
    out="out/$(basename "$scenario" .json)-profile"
    arguments+=(--overwrite)
  fi
  local recording="$out/profile.jfr" code=0
  rm -f "$recording"
  # A run whose rounds failed has a recording too, and that one is wanted most.
  "$ROOT/collektive" run "$scenario" --out "$out" --recording "$recording" "${arguments[@]}" || code=$?
  if [ ! -f "$recording" ]; then return "$code"; fi
  "$(find_jdk)/bin/java" -XX:+UseSerialGC -cp "$TOOLS_JAR:$HOST_JAR" org.collektive.tools.profile.ProfileReport "$recording"
  return "$code"
}
