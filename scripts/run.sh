# ./collektive run, repeat and demo: scenarios without Unity.

# A file for each jar that was run here, named by its SHA-256.
OWN_PROGRAMS="$BUILD/own-programs"
DEMO="$ROOT/unity/Samples~/GradientAscent/scenario.json"

help_run() {
  cat <<'H'
usage: ./collektive run SCENARIO.json [--seed K] [--seconds S] [--out DIR] [--overwrite] [--recording FILE.jfr] [--set KEY=VALUE]...
                       [--keep-going] [--trust-jvm]

Runs a scenario without Unity: compiles its C# scripts and Kotlin programs (only when they changed), plays its scene, writes its
outputs to --out (default: out/NAME-seedK below the current folder): manifest.json, metrics.csv, replay.html, pictures and
run.clkrec (all frames, for ./collektive replay and diff), as the scenario asks. A folder with results of a run is refused; --overwrite
removes them first. --set gives a key of the scenario another value: network.loss=0.1, parameters.PROGRAM.NAME=2; a name that is no key is a public
field of the scene builder: nodes=100. --recording makes a flight recording of the JVM.
A tick of which every round fails ends the run; with --keep-going it goes on.
--trust-jvm lets the file's JVM settings write files, open ports and load code, which else are refused: Documentation~/trust.md.
The scenario file's keys are described in Documentation~/headless.md.

Exit code: 0 the simulation reached its end; 1 it stopped early, or rounds, sensors or actuators failed; 130 Ctrl-C; any that a
script gives to Application.Quit.
H
}

help_repeat() {
  cat <<'H'
usage: ./collektive repeat MANIFEST.json [--out DIR] [--overwrite] [--folder DIR] [--trust-jvm]

Runs again what a run's manifest.json tells of, from the manifest alone, and compares ticks, digest and the metrics at the end. Scripts, schema
and programs are found where they were, or in --folder: the folder of the run's scenario file. One line names each of them, and the JVM, that is
not as it was. Writes the same outputs to --out (default: the manifest's folder with -repeated behind its name).
Exit code: 0 the run came out as the former; 1 it did not, could not be done, or had rounds that failed, as the former's.
H
}

help_demo() {
  cat <<'H'
usage: ./collektive demo [--nodes N] [--seconds S] [--seed K] [--out DIR] [--overwrite]

Runs the case study, environment-aware gradient ascent: 500 bodies (--nodes) climb towards a source around obstacles for 60
simulated seconds (--seconds). Writes manifest.json, metrics.csv, replay.html (open it in a browser) and three pictures to --out
(default: out/demo-seedK, where it replaces those of a former demo).
H
}

# limited FOLDER: refuses a folder that can hardly be one of sources. Hashing all of a disk would seem to hang.
limited() {
  local count
  count=$(find "$1" -type f 2>/dev/null | head -n 10001 | wc -l || true)
  [ "$count" -le 10000 ] || fail "the folder '$1' has more than 10,000 files: name the one that has the sources of this scenario alone"
}

setup_kotlin() {
  once kotlin-compiler "$(fingerprint "$ROOT/jvm-host/pom.xml" "$ROOT/tools/kotlinc")" fetch_kotlin
}

fetch_kotlin() {
  local made="$BUILD/kotlinc.part"
  rm -rf "$made"
  mvn -B -ntp -f "$ROOT/tools/kotlinc/pom.xml" -Dkotlin.version="$(pom_value kotlin.version)" dependency:copy-dependencies -DoutputDirectory="$made"
  rm -rf "$BUILD/kotlinc"
  mv "$made" "$BUILD/kotlinc"
}

# made FOLDER FILE FUNCTION ARGUMENT...: prints the path of a FILE that FUNCTION makes in an empty folder, its last argument. The FOLDER is named
# after all that it depends on, so what is there is right: two commands may make it at once, and the first is kept.
made() {
  local folder=$1 file=$2 work="$1.$$"
  shift 2
  if [ ! -d "$folder" ]; then
    rm -rf "$work"
    mkdir -p "$work"
    logged "$work/${1//_/-}.log" "$@" "$work"
    grep -aE ': warning: ' "$work"/*.log >&2 || true
    mv -T "$work" "$folder" 2>/dev/null || rm -rf "$work"
  fi
  printf '%s\n' "$folder/$file"
}

# own_programs JAR: notes a jar that the user runs. ./collektive replay runs those again without a question.
own_programs() {
  mkdir -p "$OWN_PROGRAMS"
  : >"$OWN_PROGRAMS/$(sha256sum <"$1" | cut -d ' ' -f 1)"
}

# programs_jar SCHEMA PROGRAMS [RUNTIME_JARS PLUGIN]: prints the jar of a folder of Kotlin, compiled when it changed; a jar is printed as it is.
# RUNTIME_JARS is the folder of Collektive's jars, PLUGIN its compiler plugin; without them programs are compiled for the built-in runtime.
programs_jar() {
  local schema=$1 programs=$2 jars=${3:-} plugin=${4:-} inputs
  if [ -f "$programs" ]; then printf '%s\n' "$programs"; return 0; fi
  limited "$programs"
  setup_kotlin
  inputs=("$LIBRARY_JAR" "$COMPILER_PLUGIN")
  if [ -n "$jars" ]; then inputs=("$jars" "$plugin" "$LINKS"); fi
  made "$BUILD/programs/$(fingerprint "$schema" "$programs" "$ROOT/schema" "$HOST_JAR" "$GENERATOR_JAR" "${inputs[@]}")" programs.jar \
    compile_programs "$schema" "$programs" "$jars" "$plugin"
}

# What programs know of their links: part of the library of the built-in runtime, compiled with the programs for another one.
LINKS="$ROOT/jvm-host/stdlib/src/main/kotlin/org/collektive/links"

# compile_programs SCHEMA PROGRAMS RUNTIME_JARS PLUGIN WORK
compile_programs() {
  local schema=$1 programs=$2 jars=$3 plugin=$4 work=$5 mark=builtIn sources=() library=$LIBRARY_JAR
  mkdir -p "$work/generated" "$work/classes"
  if [ -n "$jars" ]; then
    require_plugin "$plugin"
    mark="collektive $(runtime_hash "$jars")"
    library=$(printf '%s:' "$jars"/*.jar)
    sources=(-P "plugin:it.unibo.collektive.collektive-compiler-plugin:collektiveEnabled=true" "$LINKS")
  fi
  generator "$schema" --jvm "$work/generated"
  compile_jvm "$library" "$work/generated" "$work/classes" "-Xplugin=${plugin:-$COMPILER_PLUGIN}" "${sources[@]}" "$programs"
  # The host refuses programs of another runtime by this.
  printf 'Collektive-Runtime: %s\n' "$mark" >"$work/mark"
  "$(find_jdk)/bin/jar" --create --file "$work/programs.jar" --manifest "$work/mark" -C "$work/classes" .
}

# runtime_hash FOLDER: SHA-256 of its jars one after the other, by name.
runtime_hash() { (cd "$1" && printf '%s\0' *.jar | LC_ALL=C sort -z | xargs -0 cat | sha256sum | cut -c1-64); }

# require_plugin JAR: fails unless it is a plugin of the Kotlin compiler, since the compiler ignores what is not one.
require_plugin() {
  local jdk entries
  jdk=$(find_jdk)
  entries=$("$jdk/bin/jar" --list --file "$1")
  grep -q '^META-INF/services/org.jetbrains.kotlin.compiler.plugin.CompilerPluginRegistrar$' <<<"$entries" ||
    fail "$1 is no plugin of the Kotlin compiler: name Collektive's compiler-plugin as 'runtimePlugin'"
}

# compile_jvm LIBRARY GENERATED CLASSES [OPTION OR SOURCE]...: flatc's Java first, then the generated Kotlin and the sources.
compile_jvm() {
  local library=$1 generated=$2 classes=$3 jdk sources version quiet=() code=0
  shift 3
  jdk=$(find_jdk)
  mapfile -d '' -t sources < <(find "$generated" -name '*.java' -print0)
  "$jdk/bin/javac" --release 17 -nowarn -proc:none -cp "$HOST_JAR" -d "$classes" "${sources[@]}"
  # Newer JVMs warn of what the compiler uses.
  version=$(jdk_version "$jdk")
  if [ "$version" -ge 24 ]; then quiet=(--enable-native-access=ALL-UNNAMED --sun-misc-unsafe-memory-access=allow); fi
  "$jdk/bin/java" -Xmx1g -XX:+UseSerialGC "${quiet[@]}" -cp "$BUILD/kotlinc/*" org.jetbrains.kotlin.cli.jvm.K2JVMCompiler \
    -no-stdlib -no-reflect -jvm-target 17 -cp "$HOST_JAR:$library:$classes" -d "$classes" "$generated" "$@" || code=$?
  # The compiler's code for an exception of its own, which is a plugin's more often.
  if [ "$code" = 2 ]; then
    fail "the Kotlin compiler $(pom_value kotlin.version) broke off, see above: the compiler plugin may be made for another version of it"
  fi
  [ "$code" = 0 ] || return "$code"
  cp -R "$generated/META-INF" "$classes/"
}

# scripts_dll SCHEMA SCRIPTS: prints the assembly of a folder of C# and the schema's generated code, compiled when they changed.
# Folders named Generated are left out: the code is generated anew.
scripts_dll() {
  local schema=$1 scripts=$2
  limited "$scripts"
  made "$BUILD/scripts/$(fingerprint "$schema" "$scripts" "$ROOT/schema" "$GENERATOR_JAR" "$CSHARP"/*.dll)-$(place "$scripts")" Scenario.dll \
    compile_scripts "$schema" "$scripts"
}

# place FOLDER: a hash of where it lies, which traces of exceptions tell.
place() { readlink -f "$1" | sha256sum | cut -c1-8; }

compile_scripts() {
  local schema=$1 scripts=$2 work=$3
  mkdir -p "$work/generated"
  generator "$schema" --csharp "$work/generated"
  # The compiler takes quotes in paths away.
  case $scripts in *'"'*) ln -s "$scripts" "$work/scripts"; scripts="$work/scripts" ;; esac
  find "${scripts%/}/" "$work/generated" -name '*.cs' -type f -not -path '*/Generated/*' -printf '"%p"\n' | LC_ALL=C sort >"$work/sources.rsp"
  csc "$work/Scenario.dll" "${GENERATED_CODE_SYMBOLS[@]}" -warnaserror- "${PACKAGE_REFERENCES[@]}" "@$work/sources.rsp"
}

cmd_run() {
  local scenario= out= seed= overwrite=() reading=() arguments=()
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --overwrite) overwrite=(--overwrite); shift ;;
      --seed) seed=${2:?--seed needs a number}; arguments+=(--seed "$2"); shift 2 ;;
      --folder) [ $# -ge 2 ] || fail "run: --folder needs a folder"; reading+=(--folder "$2"); shift 2 ;;
      --trust-jvm) reading+=(--trust-jvm); shift ;;
      --keep-going) arguments+=("$1"); shift ;;
      --set) [ $# -ge 2 ] || fail "run: --set needs a value"; reading+=(--set "$2"); shift 2 ;;
      --seconds | --recording) [ $# -ge 2 ] || fail "run: $1 needs a value"; arguments+=("$1" "$2"); shift 2 ;;
      -*) fail "run: unknown option $1 (see ./collektive run --help)" ;;
      *) [ -z "$scenario" ] || fail "run: one scenario at a time"; scenario=$1; shift ;;
    esac
  done
  [ -n "$scenario" ] || fail "run: name a scenario file (see ./collektive run --help)"
  setup_system
  build_all
  local plan schema programs scripts replay pictures jars plugin jar dll template=()
  plan=$(managed mono-sgen "$CSHARP/Collektive.Player.exe" plan "$scenario" "${reading[@]}")
  schema=$(planned "$plan" schema)
  programs=$(planned "$plan" programs)
  scripts=$(planned "$plan" scripts)
  jars=$(planned "$plan" runtime_jars)
  plugin=$(planned "$plan" runtime_plugin)
  jar=$(programs_jar "$schema" "$programs" "$jars" "$plugin")
  dll=$(scripts_dll "$schema" "$scripts")
  replay=$(planned "$plan" replay)
  if [ "$replay" = yes ]; then
    build_replay_page
    template=(--template "$BUILD/replay.html")
  fi
  [ -n "$out" ] || out="out/$(basename "$scenario" .json)-seed${seed:-$(planned "$plan" seed)}"
  claim "$out" "${overwrite[@]}"
  own_programs "$jar"
  say "running $scenario"
  managed mono-sgen "$CSHARP/Collektive.Player.exe" run "$scenario" --scripts "$dll" --jar "$jar" --host-jar "$HOST_JAR" \
    --java-home "$(find_jdk)" --out "$out" "${template[@]}" "${reading[@]}" "${arguments[@]}"
  pictures=$(planned "$plan" pictures)
  if [ "$pictures" = yes ]; then
    logged "$BUILD/log/pictures.log" make_pictures "$out"
  fi
  python3 "$ROOT/scripts/summary.py" "$out"
}

# claim FOLDER [--overwrite]: makes the folder that a run writes to, and locks it until the process and its children end.
claim() {
  local problem
  problem=$(mkdir -p -- "$1" 2>&1) || fail "the outputs have no place: ${problem#mkdir: }; name another folder with --out"
  exec 8<"$1"
  flock -n 8 || fail "another run writes to '$1': name another folder with --out"
  python3 "$ROOT/scripts/outputs.py" "$@"
}

# planned PLAN KEY: a value of the player's plan.
planned() { printf '%s\n' "$1" | sed -n "s/^$2=//p"; }

make_pictures() {
  COLLEKTIVE_NODE_MODULES="$BUILD/npm/node_modules" node "$ROOT/unity/Headless~/Replay/pictures.mjs" "$1/replay.html" "$1"
}

cmd_repeat() {
  local manifest= out= arguments=()
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --overwrite | --trust-jvm) arguments+=("$1"); shift ;;
      --folder) [ $# -ge 2 ] || fail "repeat: --folder needs a folder"; arguments+=(--folder "$2"); shift 2 ;;
      -*) fail "repeat: unknown option $1 (see ./collektive repeat --help)" ;;
      *) [ -z "$manifest" ] || fail "repeat: one manifest at a time"; manifest=$1; shift ;;
    esac
  done
  [ -n "$manifest" ] || fail "repeat: name the manifest.json of a run (see ./collektive repeat --help)"
  [ -f "$manifest" ] || fail "repeat: there is no file '$manifest'"
  grep -q '"folder":' "$manifest" || fail "repeat: '$manifest' is no manifest of a run: ./collektive run runs scenario files"
  cmd_run "$manifest" --out "${out:-$(realpath "$(dirname "$manifest")")-repeated}" "${arguments[@]}"
}

cmd_demo() {
  local arguments=() out= seed=1
  while [ $# -gt 0 ]; do
    case $1 in
      --nodes) [[ ${2:-} =~ ^[0-9]+$ ]] || fail "demo: --nodes needs a whole number"; arguments+=(--set "nodes=$2"); shift 2 ;;
      --seed) seed=${2:?--seed needs a number}; shift 2 ;;
      --seconds) [ $# -ge 2 ] || fail "demo: --seconds needs a number"; arguments+=(--seconds "$2"); shift 2 ;;
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --overwrite) arguments+=(--overwrite); shift ;;
      *) fail "demo: unknown argument $1 (see ./collektive demo --help)" ;;
    esac
  done
  if [ -z "$out" ]; then
    out="out/demo-seed$seed"
    arguments+=(--overwrite)
  fi
  cmd_run "$DEMO" --seed "$seed" --out "$out" "${arguments[@]}"
}
