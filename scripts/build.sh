# Builds: the native shim, the JVM side, the C# assemblies. Each step runs only when something it depends on changed.

SHIM="$BUILD/cmake/native-shim"
HOST_JAR="$ROOT/jvm-host/host/target/collektive-host.jar"
SAMPLES_JAR="$ROOT/jvm-host/programs/target/collektive-programs.jar"
GENERATOR_JAR="$ROOT/jvm-host/generator/target/collektive-generator.jar"
COMPILER_PLUGIN="$ROOT/jvm-host/compiler-plugin/target/compiler-plugin-0.1.0.jar"
NEWTONSOFT="$BUILD/roslyn/Newtonsoft.Json.dll"
# What Unity compiles the bridge with; FlatBuffers' own code needs the same symbols.
GENERATED_CODE_SYMBOLS="$(cat "$ROOT/unity/Runtime/Bridge/csc.rsp") -unsafe+"

build_native() {
  setup_flatc
  once native-shim "$(fingerprint "$ROOT/native-shim" "$ROOT/CMakeLists.txt")-$(find_jdk)" build_shim
}

build_shim() { cmake_configure && cmake --build "$BUILD/cmake" --target collektive_shim -j 2; }

jvm_fingerprint() {
  printf '%s-%s' "$(fingerprint "$ROOT/jvm-host" "$ROOT/schema" "$ROOT"/unity/Samples~/*/*.fbs)" "$(cat "$BUILD/stamp/flatbuffers")"
}

build_jvm() {
  setup_flatc
  [ -f "$HOST_JAR" ] && [ -f "$GENERATOR_JAR" ] || rm -f "$BUILD/stamp/jvm-host"
  once jvm-host "$(jvm_fingerprint)" maven package -Dmaven.test.skip=true
}

# Maven of the reactor; progress is one line per module in the log.
maven() { mvn -B -ntp -f "$ROOT/jvm-host/pom.xml" "$@"; }

# sources DIR...: the C# files below folders, generated bridge code included.
sources() { find "$@" -name '*.cs' -not -path '*/obj/*' | LC_ALL=C sort; }

# assembly NAME DEPENDENCIES SOURCES... [-- OPTIONS...]: compiles build/csharp/NAME when its inputs changed.
assembly() {
  local name=$1 dependencies=$2 folders=() references=() dependency key
  shift 2
  while [ $# -gt 0 ] && [ "$1" != -- ]; do folders+=("$1"); shift; done
  [ $# -gt 0 ] && shift
  for dependency in $dependencies; do references+=("-r:$dependency"); done
  key=$(fingerprint "${folders[@]}" "$ROOT/tools/roslyn" $dependencies)
  [ -f "$CSHARP/$name" ] || rm -f "$BUILD/stamp/$name"
  once "$name" "$key $*" csc "$CSHARP/$name" "${references[@]}" "$@" $(sources "${folders[@]}" | sed "s/ /?/g")
}

build_csharp() {
  setup_roslyn
  setup_flatbuffers
  mkdir -p "$CSHARP"
  cp "$NEWTONSOFT" "$CSHARP/"
  local unity="$ROOT/unity"
  assembly Collektive.FlatBuffers.dll "" "$FLATBUFFERS/net/FlatBuffers" -- $GENERATED_CODE_SYMBOLS -warnaserror- -nowarn:1570,1572,1573,1587,1591,0618 -debug-
  assembly Collektive.Bridge.dll "$CSHARP/Collektive.FlatBuffers.dll" "$unity/Runtime/Bridge" -- $GENERATED_CODE_SYMBOLS
  assembly UnityEngine.dll "" "$unity/Headless~/UnityEngine" -- -unsafe+
  assembly Collektive.Unity.dll "$CSHARP/Collektive.FlatBuffers.dll $CSHARP/Collektive.Bridge.dll $CSHARP/UnityEngine.dll" "$unity/Runtime/Unity"
  assembly Collektive.Player.exe \
    "$CSHARP/Collektive.FlatBuffers.dll $CSHARP/Collektive.Bridge.dll $CSHARP/UnityEngine.dll $CSHARP/Collektive.Unity.dll $NEWTONSOFT $MONO_POSIX" \
    "$unity/Headless~/Player" "$unity/Headless~/Replay" -- -target:exe
}

# Prints what Unity would serialise of all components, those of the samples too.
serialized_fields() {
  local references="$CSHARP/Collektive.FlatBuffers.dll $CSHARP/Collektive.Bridge.dll $CSHARP/UnityEngine.dll $CSHARP/Collektive.Unity.dll"
  assembly Collektive.Samples.dll "$references" "$ROOT/unity/Samples~"
  assembly Collektive.SerializedFields.exe "$CSHARP/UnityEngine.dll" "$ROOT/unity/Headless~/SerializedFields" -- -target:exe
  managed mono-sgen "$CSHARP/Collektive.SerializedFields.exe" "$CSHARP/Collektive.Unity.dll" "$CSHARP/Collektive.Samples.dll"
}

build_replay_page() {
  setup_npm
  once replay-page "$(fingerprint "$ROOT/unity/Headless~/Replay" "$ROOT/tools/npm/package.json")" \
    env COLLEKTIVE_NODE_MODULES="$BUILD/npm/node_modules" node "$ROOT/unity/Headless~/Replay/build.mjs" "$BUILD/replay.html"
}

# managed RUNTIME PROGRAM ARGUMENTS...: runs a .NET program with the shim in reach.
managed() {
  local runtime=$1
  shift
  LD_LIBRARY_PATH="$SHIM${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "$runtime" --debug "$@"
}
