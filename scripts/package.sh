# ./collektive package: the Unity package as a tarball.

help_package() {
  cat <<'H'
usage: ./collektive package [--out DIR] [--jre | --all]

Makes org.collektive.unity-VERSION.tgz in --out (default: out): what Unity users install by Package Manager > Install package
from tarball. It holds the sources that Unity compiles, the native library, the jars and the tools, each with its .meta. The same
sources give the same bytes.

--jre adds a JVM of its own (the JDK at hand, trimmed by jlink, some 45 MB), so that users need none; the archive is then named
org.collektive.unity-VERSION-jre.tgz.

--all makes what is published: the package with the native library of every platform, and for each platform a package with its JVM,
org.collektive.unity.jvm.PLATFORM-VERSION.tgz, of which users install those that they need. Needs a JDK 25, and fetches a compiler and
JREs of other platforms from PyPI (0.6 GB).
H
}

cmd_package() {
  local out="$ROOT/out" jre="" all="" package platform
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --jre) jre=-jre; shift ;;
      --all) all=yes; shift ;;
      *) fail "package: unknown argument $1 (see ./collektive package --help)" ;;
    esac
  done
  if [ -n "$jre" ] && [ -n "$all" ]; then fail "package: --all makes packages of JVMs; it does not go with --jre"; fi
  setup_system
  build_all
  if [ -n "$all" ]; then build_all_platforms; fi
  # Each command makes the package in a folder of its own, so that several can do it at once.
  package=$(mktemp -d)
  # shellcheck disable=SC2064 # the folder of now
  trap "rm -rf '$package'" EXIT
  pack_core "$package" "$out" "$jre" "$all"
  [ -n "$all" ] || return 0
  for platform in $(platforms); do pack_jvm "$package" "$out" "$platform"; done
}

# What the package of all platforms has beside what this one's has.
build_all_platforms() {
  local platform
  build_platforms
  for platform in $FLATC_PLATFORMS; do setup_platform_flatc "$platform"; done
}

# pack_core WORK OUT -jre|"" yes|"": the package into OUT, with a JVM or not, for all platforms or this one; WORK is a folder for its parts.
pack_core() {
  mkdir "$1/content"
  logged "$BUILD/log/stage-package.log" stage_package "$1/content" "$4"
  if [ -n "$3" ]; then logged "$BUILD/log/stage-jre.log" stage_jre "$1/content"; fi
  pack "$1" content "$2" "$3"
}

# pack_jvm WORK OUT PLATFORM: the package with a platform's JVM.
pack_jvm() {
  cut_jre "$3"
  logged "$BUILD/log/stage-jvm-$3.log" stage_jvm_package "$1/$3" "$3"
  pack "$1" "$3" "$2" ""
}

# pack WORK NAME OUT SUFFIX: packs the folder WORK/NAME into OUT and prints the archive.
pack() {
  local archive
  mkdir -p "$1/archive" "$3"
  archive=$(npm pack "$1/$2" --pack-destination "$1/archive" --ignore-scripts --silent)
  mv "$1/archive/$archive" "$3/${archive%.tgz}$4.tgz"
  echo "$3/${archive%.tgz}$4.tgz"
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

# What the modules above need of a JRE beside its classes, by patterns for all platforms; and the modules that these need in turn.
JRE_FILES="bin/java bin/java.exe bin/jfr bin/jfr.exe bin/jcmd bin/jcmd.exe bin/api-ms-win-* bin/ucrtbase.dll bin/vcruntime* bin/msvcp*
  conf/logging.properties conf/net.properties conf/security lib/jvm.cfg lib/jexec lib/jspawnhelper lib/tzdb.dat lib/tzmappings lib/security
  lib/jfr lib/server bin/server"
JRE_LIBRARIES="attach dt_socket extnet instrument java jdwp jimage jli jsig management management_ext net nio syslookup verify zip"
JRE_ALL_MODULES="java.base java.logging java.management jdk.attach jdk.internal.jvmstat jdk.jcmd jdk.jdwp.agent jdk.jfr jdk.management jdk.unsupported"

# cut_jre PLATFORM: build/cut/PLATFORM, the platform's JRE with the classes and files of JRE_MODULES only.
cut_jre() {
  local jdk version
  setup_platform_jre "$1"
  jdk=$(find_jdk)
  version=$(jdk_version "$jdk")
  [ "$version" = 25 ] || fail "package: --all links JVMs of version 25, which only a JDK 25 can: set COLLEKTIVE_JAVA_HOME to one"
  once "cut-$1" "$JRE_MODULES $(cat "$BUILD/stamp/jre-$1") $(fingerprint "$jdk/release" "$ROOT/tools/jre") \
$(declare -f link_platform_jre copy_jre_files release_system | sha256sum) $JRE_FILES $JRE_LIBRARIES" \
    link_platform_jre "$1" "$jdk"
}

# jlink makes images of other platforms from modules in its own format; the JRE has them in its image only. Its libraries stay as they are: signed.
link_platform_jre() {
  local jre="$BUILD/jre-$1" jdk=$2 made="$BUILD/cut/$1.part" module modules=()
  rm -rf "$made"
  mkdir -p "$made/modules"
  "$jdk/bin/jimage" extract --dir "$made/classes" "$jre/lib/modules"
  for module in $JRE_ALL_MODULES; do modules+=("$made/classes/$module"); done
  "$jdk/bin/java" "$ROOT/tools/jre/WithoutHashes.java" "${modules[@]}"
  for module in $JRE_ALL_MODULES; do
    "$jdk/bin/jmod" create --target-platform "$(jmod_platform "$1")" --class-path "$made/classes/$module" "$made/modules/$module.jmod"
  done
  "$jdk/bin/jlink" --module-path "$made/modules" --add-modules "$JRE_MODULES" --disable-plugin generate-jli-classes --no-header-files --no-man-pages \
    --compress zip-9 --output "$made/image"
  # By these the shim refuses a JVM of another platform.
  printf 'OS_NAME="%s"\nOS_ARCH="%s"\n' "$(release_system "$1")" "$(case $1 in *arm64) echo aarch64 ;; *) echo x86_64 ;; esac)" >>"$made/image/release"
  copy_jre_files "$jre" "$made/image"
  rm -rf "$BUILD/cut/$1"
  mv "$made/image" "$BUILD/cut/$1"
  rm -rf "$made"
}

# release_system PLATFORM: the name of its system in the file release of a JVM.
release_system() {
  case $1 in
    win-*) echo Windows ;;
    mac-*) echo Darwin ;;
    *) echo Linux ;;
  esac
}

# jmod_platform PLATFORM: jmod's name of it.
jmod_platform() {
  local system=${1%-*} processor=${1#*-}
  system=${system/win/windows}
  system=${system/mac/macos}
  processor=${processor/#x64/amd64}
  echo "$system-${processor/arm64/aarch64}"
}

# copy_jre_files JRE IMAGE
copy_jre_files() {
  local pattern file name
  cd "$1" || return 1
  for pattern in $JRE_FILES; do
    for file in $pattern; do [ ! -e "$file" ] || cp -RL --parents "$file" "$2"; done
  done
  for name in $JRE_LIBRARIES; do
    for file in "bin/$name.dll" "lib/lib$name.so" "lib/lib$name.dylib"; do [ ! -e "$file" ] || cp -L --parents "$file" "$2"; done
  done
  for name in $JRE_ALL_MODULES; do [ ! -d "legal/$name" ] || cp -RL --parents "legal/$name" "$2"; done
  [ ! -f NOTICE ] || cp NOTICE "$2"
}

# stage_jvm_package PACKAGE PLATFORM: a package with nothing but the platform's JVM.
stage_jvm_package() {
  mkdir -p "$1/Jvm~"
  cp -RL "$BUILD/cut/$2" "$1/Jvm~/$2"
  python3 "$ROOT/scripts/package_json.py" "$ROOT" --jvm "$2" "$1"
}

# stage_package PACKAGE yes|"": makes the whole package, from the allow-list of package.json and what was built, for all platforms or this one.
stage_package() {
  local path sample sources unity="$1/unity" platform
  sources=$(python3 "$ROOT/scripts/package_json.py" "$ROOT" --sources)
  while read -r path; do (cd "$ROOT" && cp -R --parents "$path" "$1"); done <<<"$sources"

  mkdir -p "$unity/Runtime/Plugins/linux-x64" "$unity/Jvm~" "$unity/Tools~/linux-x64"
  cp "$CSHARP/Collektive.FlatBuffers.dll" "$unity/Runtime/Plugins/"
  if [ -n "${2:-}" ]; then
    for platform in $(platforms); do
      mkdir -p "$unity/Runtime/Plugins/$platform"
      cp "$(shim_of "$platform")" "$unity/Runtime/Plugins/$platform/"
    done
  else
    strip --strip-unneeded -o "$unity/Runtime/Plugins/linux-x64/libcollektive_shim.so" "$SHIM/libcollektive_shim.so"
  fi
  cp "$HOST_JAR" "$LIBRARY_JAR" "$ADAPTER_JAR" "$unity/Jvm~/"
  cp "$SAMPLES_JAR" "$unity/Jvm~/collektive-samples.jar"

  cp "$GENERATOR_JAR" "$TESTING_JAR" "$ROOT/schema/types.fbs" "$unity/Tools~/"
  cp "$LINKS/org/collektive/links/Links.kt" "$unity/Tools~/"
  cp "$COMPILER_PLUGIN" "$unity/Tools~/collektive-compiler-plugin.jar"
  strip --strip-unneeded -o "$unity/Tools~/linux-x64/flatc" "$FLATC"
  if [ -n "${2:-}" ]; then
    for platform in $FLATC_PLATFORMS; do cp -R "$BUILD/flatc-$platform" "$unity/Tools~/$platform"; done
  fi

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
