# ./collektive package: the Unity package as a tarball.

PACKAGE="$BUILD/package"

help_package() {
  cat <<'H'
usage: ./collektive package [--out DIR] [--jre]

Makes org.collektive.unity-VERSION.tgz in --out (default: out): what Unity users install by Package Manager > Install package
from tarball. It holds the sources that Unity compiles, the native library, the jars and the tools, each with its .meta. The same
sources give the same bytes.

--jre adds a JVM of its own (the JDK at hand, trimmed by jlink, some 45 MB), so that users need none; the archive is then named
org.collektive.unity-VERSION-jre.tgz.
H
}

cmd_package() {
  local out="$ROOT/out" jre=
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --jre) jre=-jre; shift ;;
      *) fail "package: unknown argument $1 (see ./collektive package --help)" ;;
    esac
  done
  setup_system
  build_native
  build_jvm
  build_csharp
  logged stage-package stage_package
  [ -z "$jre" ] || logged stage-jre stage_jre
  mkdir -p "$out"
  local archive
  archive=$(npm pack "$PACKAGE" --pack-destination "$out" --ignore-scripts --silent) || fail "npm could not pack $PACKAGE"
  if [ -n "$jre" ]; then
    mv "$out/$archive" "$out/${archive%.tgz}$jre.tgz"
    archive="${archive%.tgz}$jre.tgz"
  fi
  echo "$out/$archive"
}

# What the host and its programs use; jcmd and jfr attach to the JVM of the editor, jdwp lets debuggers in.
JRE_MODULES=java.base,java.logging,java.management,jdk.management,jdk.jfr,jdk.unsupported,jdk.jcmd,jdk.jdwp.agent

# stage_jre: a trimmed JVM into build/package. npm drops links, so the licences that jlink links to are copied.
stage_jre() {
  local jdk jre="$BUILD/jre" target="$PACKAGE/unity/Jvm~/linux-x64"
  jdk=$(find_jdk) || return 1
  once jre "$JRE_MODULES $(fingerprint "$jdk/release") $(declare -f link_jre | sha256sum)" link_jre "$jdk" "$jre" || return 1
  rm -rf "$target"
  cp -RL "$jre" "$target"
}

link_jre() {
  local jdk=$1 jre=$2 compress=2
  # The numbers of older JDKs have another name since 21.
  [ "$(sed -n 's/^JAVA_VERSION="\([0-9]*\).*/\1/p' "$jdk/release")" -lt 21 ] || compress=zip-9
  rm -rf "$jre"
  "$jdk/bin/jlink" --add-modules "$JRE_MODULES" --strip-native-debug-symbols=exclude-debuginfo-files --no-header-files --no-man-pages \
    --compress "$compress" --generate-cds-archive --output "$jre"
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
