# Builds: the native shim, the JVM side, the C# assemblies. Each step runs only when something it depends on changed.

SHIM="$BUILD/cmake/native-shim"
HOST_JAR="$ROOT/jvm-host/host/target/collektive-host.jar"
# What programs link to and the host does not. Lies beside the host's jar, as in the package.
LIBRARY_JAR="$ROOT/jvm-host/host/target/collektive-library.jar"
ADAPTER_JAR="$ROOT/jvm-host/host/target/collektive-adapter.jar"
TESTING_JAR="$ROOT/jvm-host/testing/target/collektive-testing.jar"
TOOLS_JAR="$ROOT/jvm-host/tools/target/collektive-tools.jar"
SAMPLES_JAR="$ROOT/jvm-host/programs/target/collektive-programs.jar"
GENERATOR_JAR="$ROOT/jvm-host/generator/target/collektive-generator.jar"
COMPILER_PLUGIN="$ROOT/jvm-host/compiler-plugin/target/compiler-plugin-$(pom_value version).jar"
NEWTONSOFT="$BUILD/roslyn/Newtonsoft.Json.dll"
# What Unity compiles the bridge with; FlatBuffers' own code needs the same symbols.
GENERATED_CODE_SYMBOLS=("$(cat "$ROOT/unity/Runtime/Bridge/csc.rsp")" -unsafe+)
# References of what is compiled against the package.
PACKAGE_REFERENCES=("-r:$CSHARP/Collektive.FlatBuffers.dll" "-r:$CSHARP/Collektive.Bridge.dll" "-r:$CSHARP/UnityEngine.dll"
  "-r:$CSHARP/Collektive.Unity.dll")

# What runs scenes.
build_all() {
  build_native
  build_jvm
  build_csharp
}

build_native() {
  setup_flatc
  once native-shim "$(fingerprint "$ROOT/native-shim" "$ROOT/CMakeLists.txt")-$(find_jdk)" build_shim
}

build_shim() {
  cmake_configure
  cmake --build "$BUILD/cmake" --target collektive_shim -j 2
}

jvm_fingerprint() {
  fingerprint "$ROOT"/jvm-host/pom.xml "$ROOT"/jvm-host/*/{pom.xml,src} "$ROOT/schema" "$ROOT"/unity/Samples~/*/*.fbs
  cat "$BUILD/stamp/flatbuffers"
}

build_jvm() {
  setup_flatc
  [ -f "$HOST_JAR" ] && [ -f "$LIBRARY_JAR" ] && [ -f "$ADAPTER_JAR" ] && [ -f "$TOOLS_JAR" ] && [ -f "$GENERATOR_JAR" ] || rm -f "$BUILD/stamp/jvm-host"
  once jvm-host "$(jvm_fingerprint)" package_jvm -Dmaven.test.skip=true
}

# package_jvm [OPTION]...: Maven's package phase of all modules. What was made of sources that are gone would be packed, too.
package_jvm() {
  rm -rf "$ROOT"/jvm-host/target "$ROOT"/jvm-host/*/target
  mvn -B -ntp -T 2 -f "$ROOT/jvm-host/pom.xml" package "$@"
}

# sources DIR...: the C# files below folders, generated bridge code included.
sources() { find "$@" -name '*.cs' -not -path '*/obj/*' | LC_ALL=C sort; }

# assembly NAME SOURCES... [-- OPTIONS...]: compiles build/csharp/NAME when its sources, its options or its references (-r:FILE) changed.
assembly() {
  local name=$1 inputs=() option
  shift
  while [ $# -gt 0 ] && [ "$1" != -- ]; do inputs+=("$1"); shift; done
  [ $# = 0 ] || shift
  local folders=("${inputs[@]}")
  for option in "$@"; do
    case $option in -r:*) inputs+=("${option#-r:}") ;; esac
  done
  [ -f "$CSHARP/$name" ] || rm -f "$BUILD/stamp/$name"
  once "$name" "$(fingerprint "${inputs[@]}" "$ROOT/tools/roslyn") ${*//"$ROOT/"/}" compile_assembly "$name" "$@" -- "${folders[@]}"
}

# compile_assembly NAME OPTIONS... -- SOURCES...
compile_assembly() {
  local name=$1 options=()
  shift
  while [ "$1" != -- ]; do options+=("$1"); shift; done
  shift
  mkdir -p "$CSHARP"
  sources "$@" | sed 's/.*/"&"/' >"$CSHARP/$name.rsp"
  csc "$CSHARP/$name" "${options[@]}" "@$CSHARP/$name.rsp"
}

# library FILE: puts an assembly of others beside ours. Under the lock: a process that has it in its memory would crash.
library() { once "$(basename "$1")" "$(fingerprint "$1")" copy_library "$1"; }

copy_library() {
  local copy
  copy="$CSHARP/$(basename "$1")"
  mkdir -p "$CSHARP"
  cp "$1" "$copy.part"
  mv "$copy.part" "$copy"
}

build_csharp() {
  setup_roslyn
  setup_flatbuffers
  setup_physics
  library "$NEWTONSOFT"
  # Mono has it in a place of its own; CoreCLR looks beside the program.
  library "$MONO_POSIX"
  # Mono looks for native libraries beside the assembly that calls them.
  library "$BUILD/physics/libcollektive_physics.so"
  local unity="$ROOT/unity"
  assembly Collektive.FlatBuffers.dll "$FLATBUFFERS/net/FlatBuffers" -- "${GENERATED_CODE_SYMBOLS[@]}" -warnaserror- \
    -nowarn:1570,1572,1573,1587,1591,0618 -debug-
  assembly Collektive.Bridge.dll "$unity/Runtime/Bridge" -- "${GENERATED_CODE_SYMBOLS[@]}" "-r:$CSHARP/Collektive.FlatBuffers.dll"
  assembly UnityEngine.dll "$unity/Headless~/UnityEngine" -- -unsafe+
  assembly Collektive.Unity.dll "$unity/Runtime/Unity" -- "-r:$CSHARP/Collektive.FlatBuffers.dll" "-r:$CSHARP/Collektive.Bridge.dll" \
    "-r:$CSHARP/UnityEngine.dll"
  assembly Collektive.Player.exe "$unity/Headless~/Player" "$unity/Headless~/Replay" -- "${PACKAGE_REFERENCES[@]}" "-r:$NEWTONSOFT" \
    "-r:$MONO_POSIX" -target:exe
}

# Prints what Unity would serialise of all components, those of the samples too.
serialized_fields() {
  assembly Collektive.Samples.dll "$ROOT/unity/Samples~" -- "${PACKAGE_REFERENCES[@]}"
  assembly Collektive.SerializedFields.exe "$ROOT/unity/Headless~/SerializedFields" -- "-r:$CSHARP/UnityEngine.dll" -target:exe
  managed mono-sgen "$CSHARP/Collektive.SerializedFields.exe" "$CSHARP/Collektive.Unity.dll" "$CSHARP/Collektive.Samples.dll"
}

build_replay_page() {
  setup_npm
  once replay-page "$(fingerprint "$ROOT/unity/Headless~/Replay" "$ROOT/tools/npm/package.json")" make_replay_page
}

make_replay_page() {
  COLLEKTIVE_NODE_MODULES="$BUILD/npm/node_modules" node "$ROOT/unity/Headless~/Replay/build.mjs" "$BUILD/replay.html"
}

# The command coreclr.
export PATH="$ROOT/tools/coreclr:$PATH"

# managed RUNTIME PROGRAM ARGUMENTS...: runs a .NET program with the shim in reach, on mono-sgen, mono-boehm or coreclr.
managed() {
  local runtime=$1
  shift
  LD_LIBRARY_PATH="$SHIM${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" COLLEKTIVE_RUNTIME="$runtime" "$runtime" --debug "$@"
}
