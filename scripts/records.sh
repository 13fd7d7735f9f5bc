# ./collektive replay and ./collektive diff: recorded runs, on a plain JVM.

help_replay() {
  cat <<'H'
usage: ./collektive replay FILE [--trust] [--programs JAR]...

Runs the programs of a recorded run on its input, without Unity, and compares the digest of every tick with the record's. With
--programs, runs these jars instead of the recorded ones and says where their answers part from the record's. A record is what
"outputs": { "record": true } of a scenario writes, or "Record" in the Simulation Manager's settings.
Programs that ./collektive run has not run here, such as those in a record of somebody else, run only with --trust: they have your rights.
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
  records replay "$@" --own "$OWN_PROGRAMS"
}
cmd_diff() { records diff "$@"; }
