#!/usr/bin/env bash
# Sends random data of the test schemas from C# to Kotlin and back; each side compares what it reads with what the other wrote.
# Needs what ./collektive test builds: flatc, the C# compiler, jvm-host/generator with its test classes.
# Usage: schema/test/roundtrip.sh [RECORDS [SEED]]
set -euo pipefail
ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$ROOT/scripts/lib.sh"
. "$ROOT/scripts/setup.sh"

records=${1:-500} seed=${2:-1}
out="$BUILD/roundtrip"
modules="$ROOT/jvm-host"
symbols='-define:UNSAFE_BYTEBUFFER;ENABLE_SPAN_T'
classes="$out/classes:$modules/generator/target/test-classes:$modules/generator/target/collektive-generator.jar:$modules/api/target/classes"

rm -rf "$out"
mkdir -p "$out/classes"
for schema in blocks features globals; do
  java -jar "$modules/generator/target/collektive-generator.jar" --flatc "$FLATC" --include "$ROOT/schema" \
    --schema "$ROOT/schema/test/$schema.fbs" --csharp "$out/csharp" --java "$out/java"
done
find "$out/java" -name '*.java' -print0 | xargs -0 javac -Xlint:all -Werror -d "$out/classes" -cp "$classes"

# The schema part of the bridge stands alone, so this needs no shim.
find "$ROOT/unity/Runtime/Bridge/Schema" "$ROOT/unity/Runtime/Bridge/Generated" "$ROOT/unity/Runtime/Bridge/BridgeException.cs" \
  -name '*.cs' >"$out/bridge.rsp"
find "$out/csharp" -name '*.cs' >"$out/schemas.rsp"
csc "$out/Collektive.FlatBuffers.dll" -unsafe+ "$symbols" "$FLATBUFFERS"/net/FlatBuffers/*.cs
csc "$out/Collektive.Bridge.dll" -unsafe+ "$symbols" -r:"$out/Collektive.FlatBuffers.dll" "@$out/bridge.rsp"
csc "$out/TestSchemas.dll" -r:"$out/Collektive.FlatBuffers.dll" -r:"$out/Collektive.Bridge.dll" "@$out/schemas.rsp"
csc "$out/RoundTrip.exe" -target:exe -r:"$out/Collektive.FlatBuffers.dll" -r:"$out/Collektive.Bridge.dll" \
  "$ROOT"/unity/Headless~/Tests/Schema/{Dump,RandomData,RoundTrip}.cs

lines=$out/results
: >"$lines"
for name in blocks.Blocks features.Features globals.Globals; do
  schema="test.${name}Schema"
  mono-sgen "$out/RoundTrip.exe" write "$schema" "$out/sensors" "$records" "$seed"
  java -cp "$classes" org.collektive.generator.RoundTrip read "$schema" "$out/sensors" | tee -a "$lines"
  java -cp "$classes" org.collektive.generator.RoundTrip write "$schema" "$out/actuators" "$records" "$seed"
  mono-sgen "$out/RoundTrip.exe" read "$schema" "$out/actuators" | tee -a "$lines"
done
# A test is a schema and a direction, not a record.
awk '$(NF - 1) == 0 && $(NF - 3) > 0 { passed++ } END { print passed + 0 " passed, " 6 - passed " failed"; exit passed < 6 }' "$lines"
