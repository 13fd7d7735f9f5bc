# ./collektive package: the Unity package as a tarball.

PACKAGE="$BUILD/package"

help_package() {
  cat <<'H'
usage: ./collektive package [--out DIR]

Makes org.collektive.unity-VERSION.tgz in --out (default: out): what Unity users install by Package Manager > Add package from
tarball. It holds the sources that Unity compiles, the native library, the jars and the tools, each with its .meta. The same
sources give the same bytes.
H
}

cmd_package() {
  local out="$ROOT/out"
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      *) fail "package: unknown argument $1 (see ./collektive package --help)" ;;
    esac
  done
  setup_system
  build_native
  build_jvm
  build_csharp
  logged stage-package stage_package
  mkdir -p "$out"
  local archive
  archive=$(npm pack "$PACKAGE" --pack-destination "$out" --ignore-scripts --silent) || fail "npm could not pack $PACKAGE"
  echo "$out/$archive"
}

# stage_package: makes the whole package in build/package, from the allow-list of package.json and what was built.
stage_package() {
  local path sample unity="$PACKAGE/unity"
  rm -rf "$PACKAGE"
  mkdir -p "$PACKAGE"
  python3 "$ROOT/scripts/package_json.py" "$ROOT" --sources | while read -r path; do
    (cd "$ROOT" && cp -R --parents "$path" "$PACKAGE") || exit 1
  done || return 1

  mkdir -p "$unity/Runtime/Plugins/linux-x64" "$unity/Jvm~" "$unity/Tools~/linux-x64"
  cp "$CSHARP/Collektive.FlatBuffers.dll" "$unity/Runtime/Plugins/" || return 1
  strip --strip-unneeded -o "$unity/Runtime/Plugins/linux-x64/libcollektive_shim.so" "$SHIM/libcollektive_shim.so" || return 1
  cp "$HOST_JAR" "$unity/Jvm~/collektive-host.jar" || return 1
  cp "$SAMPLES_JAR" "$unity/Jvm~/collektive-samples.jar" || return 1

  cp "$GENERATOR_JAR" "$ROOT/schema/types.fbs" "$unity/Tools~/" || return 1
  cp "$COMPILER_PLUGIN" "$unity/Tools~/collektive-compiler-plugin.jar" || return 1
  strip --strip-unneeded -o "$unity/Tools~/linux-x64/flatc" "$FLATC" || return 1

  # A sample's Kotlin lies in the reactor, where it is compiled and tested.
  for sample in "$unity/Samples~"/*/; do
    path="$ROOT/jvm-host/programs/src/main/kotlin/$(basename "$sample" | tr '[:upper:]' '[:lower:]')"
    [ -d "$path" ] || continue
    mkdir -p "$sample/Programs" && cp "$path"/*.kt "$sample/Programs/" || return 1
  done
  python3 "$ROOT/scripts/metas.py" "$PACKAGE"
}
