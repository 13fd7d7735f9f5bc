# ./collektive replay and ./collektive diff: recorded runs, on a plain JVM.

help_replay() {
  cat <<'H'
usage: ./collektive replay FILE [--trust] [--programs JAR]... [--runtime builtIn|collektive] [--runtime-jars DIR] [--out RECORD]
       ./collektive replay FILE --programs DIR --schema SCHEMA.fbs [--runtime-plugin JAR] ...

Runs the programs of a recorded run on its input, without Unity, and compares the digest of every tick with the record's. With
--programs, runs these jars instead of the recorded ones and says where their answers part from the record's. A record is what
"outputs": { "record": true } of a scenario writes, or "Record" in the Simulation Manager's settings.
Programs that ./collektive run has not run here, such as those in a record of somebody else, run only with --trust: they have your rights.

--runtime runs the record on the other runtime, collektive with the jars in --runtime-jars. Each runtime has a compiler of its own, so the
programs must be others too: a jar, or a folder of Kotlin with its schema, which is compiled here, for collektive with --runtime-plugin.
--out records the replay, so that ./collektive diff compares the two.
Exit code: 0 every digest is that of the record; 1 a digest differs; 2 the record or a jar cannot be used, or not to its end.
H
}

help_diff() {
  cat <<'H'
usage: ./collektive diff A B

Names the first tick, node and field in which two recorded runs differ: what went in first, then what came out. No code of the records runs.
Exit code: 0 nothing differs; 1 something does; 2 a record cannot be used, or not to its end.
H
}

# records COMMAND ARGUMENTS...: the host's own reader of records; its exit code is the command's.
records() {
  setup_system
  build_jvm
  "$(find_jdk)/bin/java" -cp "$TOOLS_JAR:$HOST_JAR" org.collektive.tools.record.RecordsKt "$@"
}

cmd_replay() {
  # Those of the samples may have run in Unity.
  build_jvm
  own_programs "$SAMPLES_JAR"
  local runtime= jars= plugin= schema= arguments=() programs=() kotlin= jar
  while [ $# -gt 0 ]; do
    case $1 in
      --trust) arguments+=("$1"); shift ;;
      --*) [ $# -ge 2 ] || unusable "$1 needs a value" ;;&
      --programs) if [ -d "$2" ]; then kotlin=$2; else programs+=(--programs "$2"); fi; shift 2 ;;
      --schema) schema=$2; shift 2 ;;
      --runtime) runtime=$2; shift 2 ;;
      --runtime-jars) jars=$(realpath -m "$2"); arguments+=("$1" "$jars"); shift 2 ;;
      --runtime-plugin) plugin=$2; shift 2 ;;
      *) arguments+=("$1"); shift ;;
    esac
  done
  if [ -n "$kotlin" ]; then
    [ -f "$schema" ] || unusable "--programs '$kotlin' is a folder: name its schema with --schema"
    [ "$runtime" = collektive ] || jars=
    [ -z "$jars" ] || [ -f "$plugin" ] || unusable "programs for collektive are compiled with its plugin: name it with --runtime-plugin"
    # shellcheck disable=SC2310 # its result is that of its last command
    jar=$(programs_jar "$schema" "$kotlin" "$jars" "$plugin") || exit 2
    programs+=(--programs "$jar")
  fi
  arguments+=(--own "$OWN_PROGRAMS")
  records replay "${arguments[@]}" "${programs[@]}" ${runtime:+--runtime "$runtime"}
}
# unusable WORDS: ends a replay with the exit code of what cannot be used.
unusable() { printf 'collektive: replay: %s\n' "$*" >&2; exit 2; }

cmd_diff() { records diff "$@"; }
