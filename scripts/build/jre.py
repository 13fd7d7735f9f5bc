"""Builds the JVMs in packages, reduced to the modules that the host and programs use."""
import shutil
from collections.abc import Iterable
from pathlib import Path

from build import fetch, platforms
from build.console import Failure, run_logged
from build.jdk import feature_version, find_jdk
from build.places import ROOT

# Users attach jcmd and jfr to the editor's JVM, and debuggers need jdwp.
MODULES = "java.base,java.logging,java.management,jdk.management,jdk.jfr,jdk.unsupported,jdk.jcmd,jdk.jdwp.agent"
# The modules of MODULES and their dependencies.
ALL_MODULES = ("java.base", "java.logging", "java.management", "jdk.attach", "jdk.internal.jvmstat", "jdk.jcmd", "jdk.jdwp.agent", "jdk.jfr",
               "jdk.management", "jdk.unsupported")
# Patterns of the files that the modules need in addition to their classes, for all platforms.
FILES = ("bin/java", "bin/java.exe", "bin/jfr", "bin/jfr.exe", "bin/jcmd", "bin/jcmd.exe", "bin/api-ms-win-*", "bin/ucrtbase.dll", "bin/vcruntime*",
         "bin/msvcp*", "conf/logging.properties", "conf/net.properties", "conf/security", "lib/jvm.cfg", "lib/jexec", "lib/jspawnhelper",
         "lib/tzdb.dat", "lib/tzmappings", "lib/security", "lib/jfr", "lib/server", "bin/server", "NOTICE")
LIBRARIES = ("attach", "dt_socket", "extnet", "instrument", "java", "jdwp", "jimage", "jli", "jsig", "management", "management_ext", "net", "nio",
             "syslookup", "verify", "zip")
# Names of the systems in the file `release` of a JVM, and in options of jmod.
RELEASE_SYSTEMS = {"win": "Windows", "mac": "Darwin", "linux": "Linux"}
JMOD_SYSTEMS = {"win": "windows", "mac": "macos", "linux": "linux"}


def link_jre() -> Path:
    """Returns a JVM that contains only `MODULES` of this machine's JDK, and links it if necessary."""
    jdk = find_jdk()

    def link(folder: Path) -> None:
        # The compression levels have new names since JDK 21.
        compression = "zip-9" if feature_version(jdk) >= 21 else "2"
        run_logged("jre", [jdk / "bin/jlink", "--add-modules", MODULES, "--strip-native-debug-symbols=exclude-debuginfo-files", "--no-header-files",
                       "--no-man-pages", "--compress", compression, "--generate-cds-archive", "--output", folder / "image"])

    return fetch.fill_once("jre", fetch.key_of([jdk / "release", Path(__file__)]), link) / "image"


def reduce_jre(platform: str) -> Path:
    """Returns a JRE of a platform that contains only the classes and files of `MODULES`, and creates it if necessary."""
    jdk, jre = find_jdk(), platforms.fetch_jre(platform)
    if feature_version(jdk) != 25:
        raise Failure("package: --all needs JDK 25: set COLLEKTIVE_JAVA_HOME to one")
    inputs = [jdk / "release", ROOT / "tools/jre", Path(__file__)]
    return fetch.fill_once(f"cut-{platform}", fetch.key_of(inputs), lambda folder: _reduce(platform, jdk, jre, folder)) / "image"


def _reduce(platform: str, jdk: Path, jre: Path, folder: Path) -> None:
    """Creates the image of a reduced JVM in a folder.

    jlink needs jmod files to link an image for another platform. The JRE does not contain any, so this function creates them from the image of the JRE.
    Native libraries are copied unchanged and therefore stay signed.
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
        # The shim reads these properties to reject a JVM of another platform.
        release.write(f'OS_NAME="{RELEASE_SYSTEMS[system]}"\nOS_ARCH="{ {"x64": "x86_64", "arm64": "aarch64"}[processor]}"\n')
    _copy(jre, image, [*FILES, *(file for name in LIBRARIES for file in (f"bin/{name}.dll", f"lib/lib{name}.so", f"lib/lib{name}.dylib")),
                       *(f"legal/{module}" for module in ALL_MODULES)])
    shutil.rmtree(classes)
    shutil.rmtree(modules)


def _copy(source: Path, target: Path, patterns: Iterable[str]) -> None:
    """Copies the files and folders that match the patterns, and the targets of links."""
    for path in (path for pattern in patterns for path in source.glob(pattern)):
        copy = target / path.relative_to(source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            shutil.copytree(path, copy, dirs_exist_ok=True)
        else:
            shutil.copy(path, copy)
