# ./collektive test bare: the demo and the quick tests in fresh roots of distributions, which debootstrap makes and which are thrown away.
# What is called in conditions here returns at its first error by itself; texts in single quotes are for programs inside the roots and for apt.
# shellcheck disable=SC2310,SC2016

# Name, debootstrap's suite.
BARE_ROOTS="
debian-12     bookworm
debian-13     trixie
ubuntu-24.04  noble"
# Debian has no package of Ubuntu's keys. This one is taken from Ubuntu's archive, and has to be this file.
UBUNTU_KEYRING_SHA256=36de43b15853ccae0028e9a767613770c704833f82586f28eb262f0311adb8a8

# test_bare [ROOT]...
test_bare() {
  local name suite names=
  while read -r name suite; do names+=" $name"; done <<<"$BARE_ROOTS"
  for name in "$@"; do [[ "$names " == *" $name "* ]] || fail "test bare: unknown root '$name'; known:$names"; done
  BARE_PROCESS=
  BARE_SKIPPED=0
  BARE_CODE=0
  BARE_RESULTS="$BUILD/results/bare"
  rm -rf "$BARE_RESULTS"
  mkdir -p "$BARE_RESULTS"
  if ! bare_possible; then
    BARE_SKIPPED=$(wc -w <<<"${*:-$names}")
  else
    [ -z "$(git -C "$ROOT" status --porcelain)" ] || say "the last commit is tested; the changes since then are not in it"
    mkdir -p "$BUILD/log"
    BARE_WORK=$(mktemp -d "$BUILD/bare.XXXXXX")
    trap bare_clean EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM HUP
    while read -r name suite; do
      if [ -n "$name" ] && { [ $# = 0 ] || [[ " $* " == *" $name "* ]]; }; then bare_root "$name" "$suite"; fi
    done <<<"$BARE_ROOTS"
  fi
  python3 "$ROOT/scripts/suites.py" sum "$BARE_RESULTS" "$BARE_CODE" "$BARE_SKIPPED"
}

# Says why not.
bare_possible() {
  if ! may_install; then say "skipped: fresh roots need root and apt-get"; return 1; fi
  if ! unshare --mount --pid --fork true; then say "skipped: this machine allows no mount namespace"; return 1; fi
  have debootstrap || logged "$BUILD/log/debootstrap.log" install_packages debootstrap debian-archive-keyring
}

# bare_namespace COMMAND...: runs it where what it mounts and starts ends with it. In the background, since the first process of a
# namespace and unshare itself ignore Ctrl-C.
bare_namespace() {
  local code=0
  unshare --mount --pid --fork --kill-child "$@" &
  BARE_PROCESS=$!
  wait "$BARE_PROCESS" || code=$?
  BARE_PROCESS=
  return "$code"
}

# All mounts are in namespaces that have ended: nothing is deleted through one.
bare_clean() {
  if [ -n "$BARE_PROCESS" ]; then
    kill -KILL "$BARE_PROCESS" 2>/dev/null || true
    wait "$BARE_PROCESS" 2>/dev/null || true
  fi
  rm -rf --one-file-system "$BARE_WORK"
}

# bare_root NAME SUITE: makes the root, runs the demo and the tests in it, removes it.
bare_root() {
  local name=$1 suite=$2 root="$BARE_WORK/$1" log="$BUILD/log/bare-$1.log" begin code=0 file
  begin=$(date +%s)
  mkdir "$root"
  say "$name: making the root"
  if ! bare_make "$suite" "$root" >"$log" 2>&1; then
    tail -n 3 "$log" >&2
    say "$name: skipped, its root cannot be made; the whole log is $BUILD/log/bare-$name.log"
    BARE_SKIPPED=$((BARE_SKIPPED + 1))
    rm -rf --one-file-system "$root"
    return 0
  fi
  bare_run "$name" "$root" ./collektive demo || code=$?
  python3 "$ROOT/scripts/bare_demo.py" "$root/root/collektive/out/demo-seed1" "$code" "$BARE_RESULTS/$name-demo.xml"
  bare_run "$name" "$root" ./collektive test --quick || code=$?
  while IFS= read -r -d '' file; do
    cp "$file" "$BARE_RESULTS/$name-$(basename "$(dirname "$file")")-$(basename "$file")"
  done < <(find "$root/root/collektive/build/results" -name '*.xml' -print0)
  if [ "$code" != 0 ]; then
    BARE_CODE=$code
    tail -n 60 "$log" >&2
  fi
  say "$name: done in $(($(date +%s) - begin)) s, $(du -smx "$root" | cut -f 1) MB"
  rm -rf --one-file-system "$root"
}

# bare_make SUITE ROOT: a minimal system with a clone of HEAD and the clients' settings of this machine.
bare_make() {
  local suite=$1 root=$2 mirror script=
  if [ "$suite" = noble ]; then
    mirror=$(bare_mirror Ubuntu)
    # Debian 12's debootstrap does not know it yet; Ubuntu's suites differ in nothing that matters here.
    [ -e "/usr/share/debootstrap/scripts/$suite" ] || script=/usr/share/debootstrap/scripts/jammy
    bare_ubuntu_keyring "$suite" "$mirror" "$script" || return 1
    bare_debootstrap "$suite" "$root" "$mirror" "$script" --keyring="$BARE_WORK/keyring/usr/share/keyrings/ubuntu-archive-keyring.gpg" || return 1
    # What each Ubuntu has switched on.
    sed -i "s/\(.*\) $suite main.*/\1 $suite main universe\n\1 $suite-updates main universe/" "$root/etc/apt/sources.list" || return 1
  else
    bare_debootstrap "$suite" "$root" "$(bare_mirror Debian)" "" || return 1
  fi
  bare_clients "$root" && git clone --quiet --no-hardlinks --depth 1 "file://$ROOT" "$root/root/collektive"
}

# bare_mirror LABEL: prints the mirror of this machine's own packages; nothing means debootstrap's.
bare_mirror() { apt-get indextargets --format '$(LABEL) $(REPO_URI)' | sed -n "s/^$1 //p" | head -n 1; }

# bare_debootstrap SUITE ROOT MIRROR SCRIPT [OPTIONS...]
bare_debootstrap() { bare_namespace debootstrap --variant=minbase "${@:5}" "${@:1:4}"; }

# bare_ubuntu_keyring SUITE MIRROR SCRIPT: Ubuntu's keys in $BARE_WORK/keyring.
bare_ubuntu_keyring() {
  local packages="$BARE_WORK/keyring-packages" package
  bare_debootstrap "$1" "$packages" "$2" "$3" --download-only --no-check-gpg || return 1
  package=$(echo "$packages"/var/cache/apt/archives/ubuntu-keyring_*.deb)
  echo "$UBUNTU_KEYRING_SHA256  $package" | sha256sum --check || return 1
  dpkg-deb --extract "$package" "$BARE_WORK/keyring" && rm -rf --one-file-system "$packages"
}

# The clients in the root reach the registries as those of this machine do: name servers, proxies, certificates, the user's settings.
bare_clients() {
  local root=$1 file
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/" || return 1
  apt-config dump | grep -E '^Acquire::' >"$root/etc/apt/apt.conf.d/00host" || true
  mkdir -p "$root/usr/local/share/ca-certificates" "$root/root/.m2" "$root/root/.cargo"
  cp /usr/local/share/ca-certificates/*.crt "$root/usr/local/share/ca-certificates/" 2>/dev/null || true
  for file in /etc/pip.conf "$HOME/.config/pip/pip.conf" "$HOME/.pip/pip.conf"; do
    [ ! -e "$file" ] || cat "$file" >>"$root/etc/pip.conf" || return 1
  done
  for file in .m2/settings.xml .m2/settings-security.xml .cargo/config .cargo/config.toml .cargo/credentials.toml; do
    [ ! -e "$HOME/$file" ] || cp -L "$HOME/$file" "$root/root/$file" || return 1
  done
  for file in "$(npm config get globalconfig 2>/dev/null)" "$HOME/.npmrc"; do
    [ ! -e "$file" ] || cat "$file" >>"$root/root/.npmrc"
  done
  # A bundle of certificates elsewhere than Debian's packages put theirs.
  while IFS= read -r file; do
    file=${file#*=}
    if [ -f "$file" ] && [[ $file != /etc/ssl/certs/* ]]; then mkdir -p "$root$(dirname "$file")" && cp -L "$file" "$root$file" || return 1; fi
  done < <(bare_environment)
}

# The variables of this machine that tell clients how to reach registries.
bare_environment() {
  local names='(https?|all|no)_proxy|(HTTPS?|ALL|NO)_PROXY|SSL_CERT_(FILE|DIR)|CURL_CA_BUNDLE|NODE_EXTRA_CA_CERTS|MAVEN_(OPTS|ARGS)'
  names+='|PIP_(CERT|INDEX_URL|EXTRA_INDEX_URL|TRUSTED_HOST)|(npm_config|NPM_CONFIG)_[^=]*|CARGO_(HTTP|NET|SOURCE|REGISTR)[^=]*'
  env | grep -E "^($names)=" || true
}

# bare_run NAME ROOT COMMAND...: runs a command in the clone inside the root; its output goes to the log, its steps are shown.
bare_run() {
  local name=$1 root=$2 log="$BUILD/log/bare-$1.log" variables=() code=0
  shift 2
  mapfile -t variables < <(bare_environment)
  say "$name: $*"
  bare_namespace bash -c '
    set -e
    root=$1
    shift
    mount -t proc proc "$root/proc"
    mount -t tmpfs -o mode=755 dev "$root/dev"
    mkdir "$root/dev/shm" "$root/dev/pts"
    mount -t tmpfs shm "$root/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=666 devpts "$root/dev/pts"
    for device in null:3 zero:5 full:7 random:8 urandom:9 tty:0; do
      mknod -m 666 "$root/dev/${device%:*}" c "$([ "$device" = tty:0 ] && echo 5 || echo 1)" "${device#*:}"
    done
    ln -s pts/ptmx "$root/dev/ptmx"
    ln -s /proc/self/fd "$root/dev/fd"
    exec chroot "$root" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"
  ' bare "$root" "${variables[@]}" sh -c 'cd /root/collektive && exec "$@"' sh "$@" </dev/null > >(bare_progress "$name" "$log") 2>&1 || code=$?
  # Until the log has the last lines.
  sleep 1
  return "$code"
}

# bare_progress NAME LOG: keeps its input in the log and shows the steps.
bare_progress() { tee -a "$2" | { grep --line-buffered -aE '^\[ *[0-9]+s\] |^collektive: |^[0-9]+ passed, ' || true; } | sed -u "s/^/$1 /" >&2; }
