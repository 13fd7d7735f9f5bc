# ./collektive package: the Unity package as a tarball.

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
  local archive package
  # Each command makes the package in a folder of its own, so that several can do it at once.
  package=$(mktemp -d)
  mkdir "$package/archive" "$package/content"
  # shellcheck disable=SC2064 # the folder of now
  trap "rm -rf '$package'" EXIT
  logged "$BUILD/log/stage-package.log" stage_package "$package/content"
  if [ -n "$jre" ]; then logged "$BUILD/log/stage-jre.log" stage_jre "$package/content"; fi
  mkdir -p "$out"
  archive=$(npm pack "$package/content" --pack-destination "$package/archive" --ignore-scripts --silent)
  mv "$package/archive/$archive" "$out/${archive%.tgz}$jre.tgz"
  echo "$out/${archive%.tgz}$jre.tgz"
}

# What the host and its programs use; jcmd and jfr attach to the JVM of the editor, jdwp lets debuggers in.
JRE_MODULES=java.base,java.logging,java.management,jdk.management,jdk.jfr,jdk.unsupported,jdk.jcmd,jdk.jdwp.agent

# stage_jre PACKAGE: a trimmed JVM into the package. npm drops links, so the licences that jlink links to are copied.
stage_jre() {
  local jdk jre="$BUILD/jre" target="$1/unity/Jvm~/linux-x64"
  jdk=$(find_jdk)
  once jre "$JRE_MODULES $(fingerprint "$jdk/release") $(declare -f link_jre | sha256sum)" link_jre "$jdk" "$jre"
  cp -RL "$jre" "$target"
}

link_jre() {
  local jdk=$1 jre=$2 compress=2 version
  # The numbers of older JDKs have another name since 21.
  version=$(jdk_version "$jdk")
  if [ "$version" -ge 21 ]; then compress=zip-9; fi
  rm -rf "$jre"
  "$jdk/bin/jlink" --add-modules "$JRE_MODULES" --strip-native-debug-symbols=exclude-debuginfo-files --no-header-files --no-man-pages \
    --compress "$compress" --generate-cds-archive --output "$jre"
}

# stage_package PACKAGE: makes the whole package, from the allow-list of package.json and what was built.
stage_package() {
  local path sample sources unity="$1/unity"
  sources=$(python3 "$ROOT/scripts/package_json.py" "$ROOT" --sources)
  while read -r path; do (cd "$ROOT" && cp -R --parents "$path" "$1"); done <<<"$sources"

  mkdir -p "$unity/Runtime/Plugins/linux-x64" "$unity/Jvm~" "$unity/Tools~/linux-x64"
  cp "$CSHARP/Collektive.FlatBuffers.dll" "$unity/Runtime/Plugins/"
  strip --strip-unneeded -o "$unity/Runtime/Plugins/linux-x64/libcollektive_shim.so" "$SHIM/libcollektive_shim.so"
  cp "$HOST_JAR" "$LIBRARY_JAR" "$ADAPTER_JAR" "$unity/Jvm~/"
  cp "$SAMPLES_JAR" "$unity/Jvm~/collektive-samples.jar"

  cp "$GENERATOR_JAR" "$TESTING_JAR" "$ROOT/schema/types.fbs" "$unity/Tools~/"
  cp "$LINKS/org/collektive/links/Links.kt" "$unity/Tools~/"
  cp "$COMPILER_PLUGIN" "$unity/Tools~/collektive-compiler-plugin.jar"
  strip --strip-unneeded -o "$unity/Tools~/linux-x64/flatc" "$FLATC"

  # A sample's Kotlin lies in the reactor, where it is compiled and tested.
  for sample in "$unity/Samples~"/*/; do
    path="$ROOT/jvm-host/programs/src/main/kotlin/$(basename "$sample" | tr '[:upper:]' '[:lower:]')"
    if [ -d "$path" ]; then
      mkdir -p "$sample/Programs"
      cp "$path"/*.kt "$sample/Programs/"
    fi
  done
  python3 "$ROOT/scripts/metas.py" "$1"
}

# Modules whose jars are in the package.
SHIPPED=host,generator,compiler-plugin,testing,programs
CYCLONEDX=org.cyclonedx:cyclonedx-maven-plugin:2.9.1

# bill_of_materials FOLDER: what a release consists of, as CycloneDX: FOLDER/bom.json.
bill_of_materials() {
  local work
  setup_flatbuffers
  work=$(mktemp -d)
  mvn -B -ntp -q -f "$ROOT/jvm-host/pom.xml" -pl "$SHIPPED" -am "$CYCLONEDX:makeAggregateBom" -DincludeTestScope=false -DincludeProvidedScope=false \
    -DoutputFormat=json -DoutputDirectory="$work" -DoutputName=maven
  python3 "$ROOT/scripts/bill_of_materials.py" "$work/maven.json" "$(find_jdk)" >"$work/bom.json"
  mv "$work/bom.json" "$1/bom.json"
  rm -rf "$work"
}
