"""
Runs the demo and the quick tests on freshly installed Linux distributions.

debootstrap creates a root folder with each distribution, and the script removes the folder afterwards. In the root `container`, the script follows the
Dockerfile instead, and then runs commands without a network.
"""
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from build import system
from build.console import Failure, print_progress
from build.places import BUILD, LOGS, ROOT
from tests import bare_demo, junit

# The names of the roots, and the suite that debootstrap installs in each.
CONTAINER = "container"
ROOTS = {"debian-12": "bookworm", "debian-13": "trixie", "ubuntu-24.04": "noble", CONTAINER: "bookworm"}
DOCKERFILE = ROOT / "experiments/Dockerfile"
STUDY = "experiments/gradients"
# Ubuntu's keys come from Ubuntu's archive, because Debian does not package them.
UBUNTU_KEYRING_SHA256 = "36de43b15853ccae0028e9a767613770c704833f82586f28eb262f0311adb8a8"
# Environment variables that configure how clients reach registries.
CLIENT_VARIABLES = re.compile(r"(https?|all|no)_proxy|(HTTPS?|ALL|NO)_PROXY|SSL_CERT_(FILE|DIR)|CURL_CA_BUNDLE|NODE_EXTRA_CA_CERTS|MAVEN_(OPTS|ARGS)|"
                              r"PIP_(CERT|INDEX_URL|EXTRA_INDEX_URL|TRUSTED_HOST)|(npm_config|NPM_CONFIG)_[^=]*|CARGO_(HTTP|NET|SOURCE|REGISTR)[^=]*")
# Files in the user's home folder with settings of the clients.
CLIENT_FILES = (".m2/settings.xml", ".m2/settings-security.xml", ".cargo/config", ".cargo/config.toml", ".cargo/credentials.toml")
# A script that prepares the root in its first argument, and runs the other arguments as a command inside the root.
ENTER = """
set -e
root=$1
shift
# As on any machine, / must be a mount point.
mount --bind "$root" "$root"
mount -t proc proc "$root/proc"
mount -t tmpfs -o mode=755 dev "$root/dev"
mkdir "$root/dev/shm" "$root/dev/pts"
mount -t tmpfs shm "$root/dev/shm"
mount -t devpts -o newinstance,ptmxmode=666 devpts "$root/dev/pts"
for device in null:1:3 zero:1:5 full:1:7 random:1:8 urandom:1:9 tty:5:0; do
  mknod -m 666 "$root/dev/${device%%:*}" c $(echo "${device#*:}" | tr : ' ')
done
ln -s pts/ptmx "$root/dev/ptmx"
ln -s /proc/self/fd "$root/dev/fd"
exec chroot "$root" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"
"""
PROGRESS = re.compile(r"\[ *\d+s\] |collektive: |\d+ passed, ")


class RootError(Exception):
    """A root cannot be created, for example without a network."""


def test(names: Sequence[str], results: Path) -> tuple[str, int]:
    """Tests the last commit in roots. Returns a description of the failures, which may be empty, and the number of skipped roots."""
    shutil.rmtree(results, ignore_errors=True)
    results.mkdir(parents=True)
    if not _is_possible():
        return "", len(names)
    if subprocess.run(["git", "-C", ROOT, "status", "--porcelain"], stdout=subprocess.PIPE, check=True).stdout:
        print_progress("testing the last commit; uncommitted changes are ignored")
    work = Path(tempfile.mkdtemp(prefix="bare.", dir=BUILD))
    failures, skipped = [], 0
    try:
        for name in names:
            try:
                if code := _test_root(name, work, results):
                    failures.append(f"{name} ended with code {code}")
            except RootError as error:
                print_progress(f"{name}: skipped, because its root cannot be created: {error}; the full log is {_log(name)}")
                skipped += 1
            finally:
                _remove(work / name)
    finally:
        _remove(work)
    return ", ".join(failures), skipped


def _is_possible() -> bool:
    """Returns whether roots can be created on this machine. If not, prints the reason."""
    if not system.can_install():
        print_progress("skipped: only root can create fresh roots, and only with apt-get")
        return False
    if subprocess.run(_namespace("true"), stderr=subprocess.DEVNULL).returncode != 0:
        print_progress("skipped: this machine does not allow mount namespaces")
        return False
    if not shutil.which("debootstrap"):
        try:
            system.install(["debootstrap", "debian-archive-keyring"], "debootstrap")
        except Failure:
            print_progress("skipped: debootstrap cannot be installed")
            return False
    return True


def _namespace(*command: str | Path) -> list[str | Path]:
    """Returns a command line that runs a command in a new namespace. The namespace's mounts and processes end with the command."""
    return ["unshare", "--mount", "--pid", "--fork", "--kill-child", *command]


def _remove(folder: Path) -> None:
    """Removes a folder. Its mounts must have ended."""
    subprocess.run(["rm", "-rf", "--one-file-system", folder], check=True)


def _log(name: str) -> Path:
    return LOGS / f"bare-{name}.log"


def _test_root(name: str, work: Path, results: Path) -> int:
    """Creates a root, and runs the demo and the tests in it. Returns the last exit code other than 0, or 0."""
    began, root = time.monotonic(), work / name
    print_progress(f"{name}: creating the root")
    _log(name).unlink(missing_ok=True)
    _make(name, work, root)
    code = _test_container(root, results) if name == CONTAINER else _test_distribution(name, root, results)
    if code != 0:
        print("".join(_log(name).read_text(errors="replace").splitlines(keepends=True)[-60:]), file=sys.stderr)
    size = subprocess.run(["du", "-smx", root], stdout=subprocess.PIPE, text=True, check=True).stdout.split()[0]
    print_progress(f"{name}: done in {time.monotonic() - began:.0f} s, {size} MB")
    return code


def _test_distribution(name: str, root: Path, results: Path) -> int:
    clone = root / "root/collektive"
    code = demo = _run(name, root, "./collektive", "demo")
    bare_demo.check(str(clone / "out/demo-seed1"), demo, str(results / f"{name}-demo.xml"))
    code = _run(name, root, "./collektive", "test", "--quick") or code
    for file in (clone / "build/results").glob("*/*.xml"):
        shutil.copy(file, results / f"{name}-{file.parent.name}-{file.name}")
    return code


def _test_container(root: Path, results: Path) -> int:
    """Runs the steps of the Dockerfile and then commands without a network, until a step fails."""
    commands = [(f"build step {number}", ["sh", "-c", step], True) for number, step in enumerate(_steps(DOCKERFILE.read_text()), 1)]
    commands += [(f"{words[0]} without a network", ["./collektive", *words], False) for words in (
        ["demo", "--overwrite"], ["run", f"{STUDY}/scenario.json", "--out", "/out/run"], ["check", STUDY],
        ["sweep", f"{STUDY}/experiment.json", "--out", "/out/study"], ["plot", "/out/study"])]
    cases, code = [], 0
    for title, words, has_network in commands:
        code = code or _run(CONTAINER, root, *words, has_network=has_network)
        cases.append(junit.Case(title, f"this step or an earlier one ended with {code}" if code else ""))
    figures = list((root / "out/study/figures").glob("*.pdf"))
    cases.append(junit.Case("the study has its figures", "" if len(figures) == 7 else f"{len(figures)} figures"))
    junit.write(str(results / f"{CONTAINER}.xml"), CONTAINER, cases)
    return code


def _steps(dockerfile: str) -> list[str]:
    """Returns the commands of the RUN instructions in a Dockerfile."""
    lines = re.sub(r"(?m)^#.*\n", "", dockerfile).replace("\\\n", "").splitlines()
    return [line.removeprefix("RUN ") for line in lines if line.startswith("RUN ")]


def _make(name: str, work: Path, root: Path) -> None:
    """Creates a minimal system with a clone of HEAD and this machine's client settings."""
    suite = ROOTS[name]
    if suite == "noble":
        # Debian 12's debootstrap does not support this suite. The script of another Ubuntu suite works, too, because they are identical.
        script = [] if Path("/usr/share/debootstrap/scripts", suite).exists() else ["/usr/share/debootstrap/scripts/jammy"]
        mirror = _mirror("Ubuntu")
        keyring = _ubuntu_keyring(name, work, suite, mirror, script)
        _debootstrap(name, root, suite, mirror, script, f"--keyring={keyring}")
        # These components are enabled by default in an installed Ubuntu, but not by debootstrap.
        sources = root / "etc/apt/sources.list"
        sources.write_text(re.sub(rf"(.*) {suite} main.*", rf"\1 {suite} main universe\n\1 {suite}-updates main universe", sources.read_text()))
    else:
        _debootstrap(name, root, suite, _mirror("Debian"), [])
    _add_clients(root)
    _logged(name, ["git", "clone", "--quiet", "--no-hardlinks", "--depth", "1", f"file://{ROOT}", root / "root/collektive"])


def _mirror(label: str) -> str:
    """Returns the package mirror of this machine, or an empty string for debootstrap's default."""
    command = ["apt-get", "indextargets", "--format", "$(LABEL) $(REPO_URI)"]
    lines = subprocess.run(command, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    return next((line.removeprefix(f"{label} ") for line in lines if line.startswith(f"{label} ")), "")


def _debootstrap(name: str, root: Path, suite: str, mirror: str, script: list[str], *options: str) -> None:
    _logged(name, _namespace("debootstrap", "--variant=minbase", *options, suite, root, mirror, *script))


def _ubuntu_keyring(name: str, work: Path, suite: str, mirror: str, script: list[str]) -> Path:
    """Downloads the file with Ubuntu's keys, checks its hash and returns its path."""
    packages = work / "keyring-packages"
    _debootstrap(name, packages, suite, mirror, script, "--download-only", "--no-check-gpg")
    package = next((packages / "var/cache/apt/archives").glob("ubuntu-keyring_*.deb"))
    if hashlib.sha256(package.read_bytes()).hexdigest() != UBUNTU_KEYRING_SHA256:
        raise RootError(f"the SHA-256 of {package.name} is not the expected one")
    _logged(name, ["dpkg-deb", "--extract", package, work / "keyring"])
    _remove(packages)
    return work / "keyring/usr/share/keyrings/ubuntu-archive-keyring.gpg"


def _logged(name: str, command: Sequence[str | Path]) -> None:
    with _log(name).open("ab") as file:
        if subprocess.run(command, stdin=subprocess.DEVNULL, stdout=file, stderr=file).returncode != 0:
            raise RootError(" ".join(map(str, command[:6])) + " failed")


def _add_clients(root: Path) -> None:
    """Copies this machine's name servers, proxies, certificates and client settings to the root."""
    home = Path.home()
    for file in ("resolv.conf", "hosts"):
        shutil.copy(Path("/etc", file), root / "etc" / file)
    settings = subprocess.run(["apt-config", "dump"], stdout=subprocess.PIPE, text=True, check=True).stdout
    (root / "etc/apt/apt.conf.d/00host").write_text("".join(line for line in settings.splitlines(keepends=True) if line.startswith("Acquire::")))
    certificates = [*Path("/usr/local/share/ca-certificates").glob("*.crt")]
    # Bundles of certificates that the environment variables name, unless Debian has a bundle at the same path.
    bundles = [Path(value) for value in _client_variables().values() if os.path.isfile(value) and not value.startswith("/etc/ssl/certs/")]
    for source, target in [*((file, root / str(file).lstrip("/")) for file in [*certificates, *bundles]),
                           *((home / file, root / "root" / file) for file in CLIENT_FILES if (home / file).exists())]:
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)
    npm = subprocess.run(["npm", "config", "get", "globalconfig"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.strip()
    for name, sources in {"etc/pip.conf": [Path("/etc/pip.conf"), home / ".config/pip/pip.conf", home / ".pip/pip.conf"],
                            "root/.npmrc": [Path(npm), home / ".npmrc"]}.items():
        text = "".join(file.read_text() for file in sources if file.is_file())
        if text:
            (root / name).write_text(text)


def _client_variables() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if CLIENT_VARIABLES.fullmatch(name)}


def _run(name: str, root: Path, *command: str, has_network: bool = True) -> int:
    """Runs a command in the clone inside the root. Writes its output to the log, and prints its progress messages.

    Without a network, the command has only the loopback interface.
    """
    print_progress(f"{name}: {' '.join(command)}")
    variables = [f"{key}={value}" for key, value in _client_variables().items()]
    inside = ["sh", "-c", 'cd /root/collektive && exec "$@"', "sh", *command]
    network, enter = ([], ENTER) if has_network else (["unshare", "--net"], "ip link set lo up\n" + ENTER)
    process = subprocess.Popen([*network, *_namespace("bash", "-c", enter, "bare", root, *variables, *inside)], stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    assert process.stdout is not None
    try:
        with _log(name).open("a") as log:
            for line in process.stdout:
                log.write(line)
                if PROGRESS.match(line):
                    print(f"{name} {line}", end="", file=sys.stderr, flush=True)
        return process.wait()
    except BaseException:
        # This process must be killed, because unshare and the first process of a namespace ignore Ctrl-C.
        process.kill()
        process.wait()
        raise
