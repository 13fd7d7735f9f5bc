"""Builds the JVMs in packages, reduced to the modules that the host and programs use."""
import shutil
from collections.abc import Iterable
from pathlib import Path

from build import fetch, platforms
from build.console import Failure, run_logged
from build.jdk import feature_version, find_jdk
from build.places import ROOT

# jcmd and jfr attach to the editor's JVM; debuggers need jdwp.
MODULES = "java.base,java.logging,java.management,jdk.management,jdk.jfr,jdk.unsupported,jdk.jcmd,jdk.jdwp.agent"
# MODULES and their dependencies.
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


def link_jre() -> Path:
    """Returns the JVM of this machine's JDK with `MODULES` only."""
    jdk = find_jdk()

    def link(folder: Path) -> None:
        # JDK 21 renamed the compression levels.
        compression = "zip-9" if feature_version(jdk) >= 21 else "2"
        run_logged("jre", [jdk / "bin/jlink", "--add-modules", MODULES, "--strip-native-debug-symbols=exclude-debuginfo-files", "--no-header-files",
                       "--no-man-pages", "--compress", compression, "--generate-cds-archive", "--output", folder / "image"])

    return fetch.fill_once("jre", fetch.key_of([jdk / "release", Path(__file__)]), link) / "image"


def reduce_jre(platform: str) -> Path:
    """Returns the JRE of a platform with the classes and files of `MODULES` only."""
    jdk, jre = find_jdk(), platforms.fetch_jre(platform)
    if feature_version(jdk) != 25:
        raise Failure("package: --all needs JDK 25: set COLLEKTIVE_JAVA_HOME to one")
    inputs = [jdk / "release", ROOT / "tools/jre", Path(__file__)]
    return fetch.fill_once(f"cut-{platform}", fetch.key_of(inputs), lambda folder: _reduce(platform, jdk, jre, folder)) / "image"


def _reduce(platform: str, jdk: Path, jre: Path, folder: Path) -> None:
    """Makes the image of a reduced JVM in a folder.

    jlink links images of other platforms only from jmod files, which the JRE does not contain, so they are created from its image. Native
    libraries are copied unchanged and stay signed.
    """
    log = f"cut-{platform}"
    system, processor = platform.split("-")
    classes, modules, image = folder / "classes", folder / "modules", folder / "image"
    modules.mkdir()
    run_logged(log, [jdk / "bin/jimage", "extract", "--dir", classes, jre / "lib/modules"])
    run_logged(log, [jdk / "bin/java", ROOT / "tools/jre/RemoveModuleHashes.java", *(classes / module for module in ALL_MODULES)])
    target = f"{JMOD_SYSTEMS[system]}-{ {'x64': 'amd64', 'arm64': 'aarch64'}[processor]}"
    for module in ALL_MODULES:
        run_logged(log, [jdk / "bin/jmod", "create", "--target-platform", target, "--class-path", classes / module, modules / f"{module}.jmod"])
    run_logged(log, [jdk / "bin/jlink", "--module-path", modules, "--add-modules", MODULES, "--disable-plugin", "generate-jli-classes", "--no-header-files",
                 "--no-man-pages", "--compress", "zip-9", "--output", image])
    with (image / "release").open("a") as release:
        # The shim reads these to reject a JVM of another platform.
        release.write(f'OS_NAME="{RELEASE_SYSTEMS[system]}"\nOS_ARCH="{ {"x64": "x86_64", "arm64": "aarch64"}[processor]}"\n')
    _copy(jre, image, [*FILES, *(file for name in LIBRARIES for file in (f"bin/{name}.dll", f"lib/lib{name}.so", f"lib/lib{name}.dylib")),
                       *(f"legal/{module}" for module in ALL_MODULES)])
    shutil.rmtree(classes)
    shutil.rmtree(modules)


def _copy(source: Path, target: Path, patterns: Iterable[str]) -> None:
    """Copies the matching files and folders, following links."""
    for path in (path for pattern in patterns for path in source.glob(pattern)):
        copy = target / path.relative_to(source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            shutil.copytree(path, copy, dirs_exist_ok=True)
        else:
            shutil.copy(path, copy)
