"""JVMs that packages contain: reduced to what the host and its programs use."""
import shutil
from collections.abc import Iterable
from pathlib import Path

from build import fetch, platforms
from build.console import Failure, logged
from build.jdk import feature_version, find_jdk
from build.places import ROOT

# jcmd and jfr attach to the JVM of the editor, jdwp lets debuggers in.
MODULES = "java.base,java.logging,java.management,jdk.management,jdk.jfr,jdk.unsupported,jdk.jcmd,jdk.jdwp.agent"
# These, and the modules that they need in turn.
ALL_MODULES = ("java.base", "java.logging", "java.management", "jdk.attach", "jdk.internal.jvmstat", "jdk.jcmd", "jdk.jdwp.agent", "jdk.jfr",
               "jdk.management", "jdk.unsupported")
# The files that the modules need beside their classes, by patterns for all platforms.
FILES = ("bin/java", "bin/java.exe", "bin/jfr", "bin/jfr.exe", "bin/jcmd", "bin/jcmd.exe", "bin/api-ms-win-*", "bin/ucrtbase.dll", "bin/vcruntime*",
         "bin/msvcp*", "conf/logging.properties", "conf/net.properties", "conf/security", "lib/jvm.cfg", "lib/jexec", "lib/jspawnhelper",
         "lib/tzdb.dat", "lib/tzmappings", "lib/security", "lib/jfr", "lib/server", "bin/server", "NOTICE")
LIBRARIES = ("attach", "dt_socket", "extnet", "instrument", "java", "jdwp", "jimage", "jli", "jsig", "management", "management_ext", "net", "nio",
             "syslookup", "verify", "zip")
# Names of systems: in the file release of a JVM, and for jmod.
RELEASE_SYSTEMS = {"win": "Windows", "mac": "Darwin", "linux": "Linux"}
JMOD_SYSTEMS = {"win": "windows", "mac": "macos", "linux": "linux"}


def linked() -> Path:
    """Returns the JVM of this machine's JDK with `MODULES` only."""
    jdk = find_jdk()

    def link(folder: Path) -> None:
        # The numbers of older JDKs have another name since 21.
        compression = "zip-9" if feature_version(jdk) >= 21 else "2"
        logged("jre", [jdk / "bin/jlink", "--add-modules", MODULES, "--strip-native-debug-symbols=exclude-debuginfo-files", "--no-header-files",
                       "--no-man-pages", "--compress", compression, "--generate-cds-archive", "--output", folder / "image"])

    return fetch.once("jre", fetch.key_of([jdk / "release", Path(__file__)]), link) / "image"


def reduced(platform: str) -> Path:
    """Returns the JRE of a platform with the classes and files of `MODULES` only."""
    jdk, jre = find_jdk(), platforms.fetch_jre(platform)
    if feature_version(jdk) != 25:
        raise Failure("package: --all links JVMs of version 25, which only a JDK 25 can: set COLLEKTIVE_JAVA_HOME to one")
    inputs = [jdk / "release", ROOT / "tools/jre", Path(__file__)]
    return fetch.once(f"cut-{platform}", fetch.key_of(inputs), lambda folder: _reduce(platform, jdk, jre, folder)) / "image"


def _reduce(platform: str, jdk: Path, jre: Path, folder: Path) -> None:
    """Makes the image of a reduced JVM in a folder.

    jlink makes images of other platforms from modules in its own format; the JRE has them in its image only. Its libraries stay as they are: signed.
    """
    log = f"cut-{platform}"
    system, processor = platform.split("-")
    classes, modules, image = folder / "classes", folder / "modules", folder / "image"
    modules.mkdir()
    logged(log, [jdk / "bin/jimage", "extract", "--dir", classes, jre / "lib/modules"])
    logged(log, [jdk / "bin/java", ROOT / "tools/jre/WithoutHashes.java", *(classes / module for module in ALL_MODULES)])
    target = f"{JMOD_SYSTEMS[system]}-{ {'x64': 'amd64', 'arm64': 'aarch64'}[processor]}"
    for module in ALL_MODULES:
        logged(log, [jdk / "bin/jmod", "create", "--target-platform", target, "--class-path", classes / module, modules / f"{module}.jmod"])
    logged(log, [jdk / "bin/jlink", "--module-path", modules, "--add-modules", MODULES, "--disable-plugin", "generate-jli-classes", "--no-header-files",
                 "--no-man-pages", "--compress", "zip-9", "--output", image])
    with (image / "release").open("a") as release:
        # By these the shim refuses a JVM of another platform.
        release.write(f'OS_NAME="{RELEASE_SYSTEMS[system]}"\nOS_ARCH="{ {"x64": "x86_64", "arm64": "aarch64"}[processor]}"\n')
    _copy(jre, image, [*FILES, *(file for name in LIBRARIES for file in (f"bin/{name}.dll", f"lib/lib{name}.so", f"lib/lib{name}.dylib")),
                       *(f"legal/{module}" for module in ALL_MODULES)])
    shutil.rmtree(classes)
    shutil.rmtree(modules)


def _copy(source: Path, target: Path, patterns: Iterable[str]) -> None:
    """Copies the files and folders that match; links become what they lead to."""
    for path in (path for pattern in patterns for path in source.glob(pattern)):
        copy = target / path.relative_to(source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            shutil.copytree(path, copy, dirs_exist_ok=True)
        else:
            shutil.copy(path, copy)
