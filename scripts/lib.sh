# Shared by the parts of ./collektive: places, output, the lock, and "do it once" steps.
# Sourced, never run.

BUILD="$ROOT/build"
# What Python, Mono and Node run with.
STACK_KB=1024
FLATC="$BUILD/flatc"
FLATBUFFERS="$BUILD/flatbuffers"
PHYSX="$BUILD/physx"
CSHARP="$BUILD/csharp"
export COLLEKTIVE_STARTED=${COLLEKTIVE_STARTED:-$(date +%s)}

say() { printf '[%4ds] %s\n' "$(($(date +%s) - COLLEKTIVE_STARTED))" "$*" >&2; }
fail() { printf 'collektive: %s\n' "$*" >&2; exit 1; }

# is_closed DESCRIPTOR: whether the caller closed it. Bash then has the command's own file there.
is_closed() { [ ! -e "/proc/self/fd/$1" ] || [ "/proc/self/fd/$1" -ef "$ROOT/collektive" ]; }

# surroundings: what the tools rely on, whatever the caller's shell is like.
surroundings() {
  # A closed descriptor is taken by the next file that is opened. Messages without a place go to the results.
  # shellcheck disable=SC2310 # looks only
  if is_closed 0; then exec 0</dev/null; fi
  # shellcheck disable=SC2310
  if is_closed 1; then exec 1>/dev/null; fi
  # shellcheck disable=SC2310
  if is_closed 2; then exec 2>&1; fi
  # Other encodings have no form for some file names.
  if [ "$(locale charmap 2>/dev/null)" != UTF-8 ]; then export LC_ALL=C.UTF-8; fi
  local stack
  stack=$(ulimit -s)
  if [ "$stack" != unlimited ] && [ "$stack" -lt "$STACK_KB" ]; then
    fail "the stack of processes is limited to $stack KB, and the tools need $STACK_KB: ulimit -s 8192"
  fi
}

have() { command -v "$1" >/dev/null 2>&1; }

# pom_value NAME: a version of the JVM side, by the name of its element in the parent POM.
pom_value() { sed -n "/<$1>/{s:.*<$1>\(.*\)</$1>.*:\1:p;q}" "$ROOT/jvm-host/pom.xml"; }

# lock -s|-x: locks the outputs of this checkout until the process ends: shared to use them, exclusive to change them. Processes started
# by the holder share its lock. Waits for other commands, and says so.
lock() {
  # The lock is on the folder itself: `clean` removes every file that could carry it.
  [ /proc/self/fd/9 -ef "$ROOT" ] || exec 9<"$ROOT"
  if flock -n "$1" 9; then return 0; fi
  say "waiting for another collektive command that uses build/ ..."
  flock "$1" 9
}

# unlock: for what runs other commands beside each other; each of them locks by itself.
unlock() { exec 9<&-; }

# attended COMMAND...: runs a command in a process group of its own and passes SIGINT, SIGTERM and SIGHUP on to all of it, so that no process of it
# is left behind. A command that a signal ended has the exit code that shells give it.
attended() {
  local group code lifeline signal=0
  set -m
  "$@" &
  group=$!
  set +m
  # shellcheck disable=SC2064 # the group of now
  {
    trap "signal=2; kill -INT -- -$group 2>/dev/null" INT
    trap "signal=15; kill -TERM -- -$group 2>/dev/null" TERM
    trap "signal=1; kill -TERM -- -$group 2>/dev/null" HUP
  }
  # Nobody can forward SIGKILL: when this process is gone, so is its end of the pipe.
  exec {lifeline}> >(trap '' INT TERM HUP; cat >/dev/null; kill -TERM -- "-$group" 2>/dev/null)
  # A signal ends `wait`, not what it waits for.
  while code=0; wait "$group" || code=$?; kill -0 "$group" 2>/dev/null; do :; done
  # The first process may be gone before those that it started.
  while kill -0 -- "-$group" 2>/dev/null; do sleep 0.05; done
  exec {lifeline}>&-
  if [ "$signal" != 0 ] && [ "$code" != 0 ]; then code=$((128 + signal)); fi
  return "$code"
}

# logged LOG FUNCTION ARGUMENT...: runs a step with its output in a file, shown only when it fails. A step is a function in a process of its own:
# there `set -e` holds, while bash ignores it in all that an `if`, `&&` or `||` calls.
logged() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  say "$(basename "$log" .log) ..."
  if "$ROOT/collektive" step "$@" >"$log" 2>&1; then return 0; fi
  # What compilers say first matters most, and what other tools say last.
  if [ "$(wc -l <"$log")" -le 60 ]; then cat "$log" >&2; else { head -n 30 "$log"; echo "..."; tail -n 30 "$log"; } >&2; fi
  printf 'collektive: %s failed; the whole log is %s\n' "$(basename "$log" .log)" "$log" >&2
  return 1
}

# fingerprint PATH...: one hash over the contents of files and folders, build outputs left out. Files count by their places in the folder, not by
# where that lies: checkouts can be moved, and copies of a project share what is compiled.
fingerprint() {
  local path
  for path in "$@"; do
    if [ -d "$path" ]; then
      (cd "$path" && find . \( -name target -o -name node_modules -o -name .git \) -prune -o -type f -print0 | LC_ALL=C sort -z | xargs -0 -r sha256sum)
    else
      sha256sum <"$path"
    fi
  done | sha256sum | cut -c1-32
}

# once NAME KEY COMMAND...: runs COMMAND as a step unless it was done for this KEY (a hash of all that it depends on). A step that starts
# over after it was killed finds INTERRUPTED=yes: what it left behind may be incomplete.
once() {
  local name=$1 key=$2 stamp="$BUILD/stamp/$1" INTERRUPTED= code=0
  shift 2
  if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$key" ]; then return 0; fi
  lock -x
  if [ ! -f "$stamp" ] || [ "$(cat "$stamp")" != "$key" ]; then
    mkdir -p "$BUILD/stamp"
    if [ -f "$stamp.started" ]; then INTERRUPTED=yes; fi
    export INTERRUPTED
    rm -f "$stamp"
    : >"$stamp.started"
    # shellcheck disable=SC2310 # what can fail in it is the step, a process
    logged "$BUILD/log/$name.log" "$@" || code=$?
    rm -f "$stamp.started"
    if [ "$code" != 0 ]; then exit "$code"; fi
    printf '%s\n' "$key" >"$stamp.part"
    mv "$stamp.part" "$stamp"
  fi
  lock -s
}
