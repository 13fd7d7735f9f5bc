# Shared by the parts of ./collektive: places, output, and "do it once" steps.
# Sourced, never run.

BUILD="$ROOT/build"
FLATC="$BUILD/flatc"
FLATBUFFERS="$BUILD/flatbuffers"
CSHARP="$BUILD/csharp"
STARTED=$(date +%s)

say() { printf '[%4ds] %s\n' "$(($(date +%s) - STARTED))" "$*" >&2; }
fail() { printf 'collektive: %s\n' "$*" >&2; exit 1; }

have() { command -v "$1" >/dev/null 2>&1; }

# logged NAME COMMAND...: runs a step with its output in build/log/NAME.log, shown only when it fails.
logged() {
  local name=$1 log="$BUILD/log/$1.log"
  shift
  mkdir -p "$BUILD/log"
  say "$name ..."
  if ! "$@" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    fail "$name failed; the whole log is build/log/$name.log"
  fi
}

# fingerprint PATH...: one hash over the contents of files and folders, build outputs left out.
fingerprint() {
  { find "$@" \( -name target -o -name node_modules -o -name .git \) -prune -o -type f -print0 | LC_ALL=C sort -z | xargs -0 -r sha256sum; } | sha256sum | cut -c1-32
}

# once NAME KEY COMMAND...: runs COMMAND unless it was done for this KEY (a hash of all that it depends on).
once() {
  local name=$1 key=$2 stamp="$BUILD/stamp/$1"
  shift 2
  if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$key" ]; then return 0; fi
  logged "$name" "$@"
  mkdir -p "$BUILD/stamp"
  printf '%s\n' "$key" >"$stamp"
}
