#!/usr/bin/env bash
# installed.sh ROOT PROJECT: compiles the package that lies in PROJECT/Packages as Unity would, and a player for it, into PROJECT/bin.
# Of the clone come only the stand-in of Unity with its physics and the player.
set -euo pipefail
ROOT=$1
. "$ROOT/scripts/lib.sh"
. "$ROOT/scripts/setup.sh"
. "$ROOT/scripts/build.sh"
package="$2/Packages/org.collektive.unity/unity"
bin="$2/bin"
mkdir -p "$bin"
cp "$package/Runtime/Plugins/Collektive.FlatBuffers.dll" "$NEWTONSOFT" "$BUILD/physics/libcollektive_physics.so" "$bin/"

# compiled NAME "REFERENCES" OPTION... SOURCES FOLDER...
compiled() {
  local name=$1 reference options=()
  for reference in $2; do options+=("-r:$bin/$reference"); done
  shift 2
  while [[ $1 = [-@]* ]]; do options+=("$1"); shift; done
  sources "$@" | sed 's/.*/"&"/' >"$bin/$name.rsp"
  csc "$bin/$name" -debug- "${options[@]}" "@$bin/$name.rsp"
  rm "$bin/$name.rsp"
}

bridge="Collektive.FlatBuffers.dll Collektive.Bridge.dll"
compiled UnityEngine.dll "" -unsafe+ "$ROOT/unity/Headless~/UnityEngine"
compiled Collektive.Bridge.dll Collektive.FlatBuffers.dll -unsafe+ "@$package/Runtime/Bridge/csc.rsp" "$package/Runtime/Bridge"
compiled Collektive.Unity.dll "$bridge UnityEngine.dll" "$package/Runtime/Unity"
compiled UnityEditor.dll UnityEngine.dll "$ROOT/unity/Headless~/UnityEditor"
compiled Collektive.Unity.Editor.dll "$bridge UnityEngine.dll Collektive.Unity.dll UnityEditor.dll" "$package/Editor"
compiled Collektive.Player.exe "$bridge UnityEngine.dll Collektive.Unity.dll $(basename "$NEWTONSOFT")" -target:exe "-r:$MONO_POSIX" \
  "$ROOT/unity/Headless~/Player" "$ROOT/unity/Headless~/Replay"
for sample in "$package/Samples~"/*/; do
  compiled "$(basename "$sample").dll" "$bridge UnityEngine.dll Collektive.Unity.dll" "$sample"
done
