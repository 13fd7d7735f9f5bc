#!/usr/bin/env bash
# installed.sh ROOT PROJECT: compiles the package that lies in PROJECT/Packages as Unity would, and a player for it, into PROJECT/bin.
# Of the clone come only the stand-in of Unity and the player.
set -euo pipefail
ROOT=$1
for part in lib setup build; do . "$ROOT/scripts/$part.sh"; done
package="$2/Packages/org.collektive.unity/unity"
bin="$2/bin"
mkdir -p "$bin"
cp "$package/Runtime/Plugins/Collektive.FlatBuffers.dll" "$NEWTONSOFT" "$bin/"

# compiled NAME "REFERENCES" SOURCES...
compiled() {
  local name=$1 reference references=()
  for reference in $2; do references+=("-r:$bin/$reference"); done
  shift 2
  csc "$bin/$name" -debug- "${references[@]}" "$@"
}

compiled UnityEngine.dll "" -unsafe+ $(sources "$ROOT/unity/Headless~/UnityEngine")
compiled Collektive.Bridge.dll "Collektive.FlatBuffers.dll" -unsafe+ "@$package/Runtime/Bridge/csc.rsp" $(sources "$package/Runtime/Bridge")
compiled Collektive.Unity.dll "Collektive.FlatBuffers.dll Collektive.Bridge.dll UnityEngine.dll" $(sources "$package/Runtime/Unity")
compiled UnityEditor.dll "UnityEngine.dll" $(sources "$ROOT/unity/Headless~/UnityEditor")
compiled Collektive.Unity.Editor.dll "Collektive.FlatBuffers.dll Collektive.Bridge.dll UnityEngine.dll Collektive.Unity.dll UnityEditor.dll" $(sources "$package/Editor")
compiled Collektive.Player.exe "Collektive.FlatBuffers.dll Collektive.Bridge.dll UnityEngine.dll Collektive.Unity.dll $(basename "$NEWTONSOFT")" \
  -target:exe -r:"$MONO_POSIX" $(sources "$ROOT/unity/Headless~/Player" "$ROOT/unity/Headless~/Replay")
for sample in "$package/Samples~"/*/; do
  compiled "$(basename "$sample").dll" "Collektive.FlatBuffers.dll Collektive.Bridge.dll UnityEngine.dll Collektive.Unity.dll" $(sources "$sample")
done
