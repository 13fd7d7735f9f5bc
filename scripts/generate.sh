# ./collektive generate: code of a user schema, for both sides.

help_generate() {
  cat <<'H'
usage: ./collektive generate SCHEMA.fbs [--csharp DIR] [--jvm DIR]

Makes the code of a user schema: C# into --csharp (default: Generated beside the schema) and Java and Kotlin into --jvm (default: not made;
`./collektive run` makes it for programs by itself). Schemas may include "types.fbs" (Vector3 and friends).
H
}

# generator SCHEMA [--csharp DIR] [--jvm DIR]
generator() {
  local schema=$1
  shift
  "$(find_jdk)/bin/java" -XX:+UseSerialGC -XX:TieredStopAtLevel=1 -jar "$GENERATOR_JAR" --flatc "$FLATC" --include "$ROOT/schema" --schema "$schema" "$@"
}

cmd_generate() {
  local schema= csharp= jvm=
  while [ $# -gt 0 ]; do
    case $1 in
      --csharp) csharp=${2:?--csharp needs a folder}; shift 2 ;;
      --jvm) jvm=${2:?--jvm needs a folder}; shift 2 ;;
      -*) fail "generate: unknown option $1 (see ./collektive generate --help)" ;;
      *) [ -z "$schema" ] || fail "generate: one schema at a time"; schema=$1; shift ;;
    esac
  done
  [ -n "$schema" ] || fail "generate: name a schema file (see ./collektive generate --help)"
  [ -f "$schema" ] || fail "generate: there is no file '$schema'"
  [ -n "$csharp" ] || [ -n "$jvm" ] || csharp="$(dirname "$schema")/Generated"
  setup_system
  build_jvm
  generator "$schema" ${csharp:+--csharp "$csharp"} ${jvm:+--jvm "$jvm"}
  say "generated${csharp:+ C# into $csharp}${jvm:+ Java and Kotlin into $jvm}"
}
