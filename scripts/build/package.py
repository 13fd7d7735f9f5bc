"""Stages the Unity packages in a folder and packs them with npm."""
import os
import shutil
import subprocess
from pathlib import Path

from build import graph, jre, manifest, metas, places, platforms, sample_programs
from build.console import Failure, print_progress, run_logged
from build.places import BUILD, ROOT

GENERATED = BUILD / "generated"


def build_parts(all_platforms: bool) -> None:
    """Builds the content of the packages."""
    graph.build("runtime", "jvm_modules", "sample_code", "sample_programs")
    if all_platforms:
        platforms.build_platforms()
        for platform in platforms.FLATC_PLATFORMS:
            platforms.fetch_flatc(platform)


def core(work: Path, out: Path, with_jre: bool = False, all_platforms: bool = False, repository: str = "") -> Path:
    """Packs the package into `out` and returns the archive. `work` is an empty folder. If `repository` is given, the manifest links to its pages."""
    print_progress("stage-package ...")
    content = work / "content"
    _stage(content, all_platforms)
    if repository:
        manifest.write_links(content, repository)
    if with_jre:
        # jlink replaces identical licences with links, which npm omits. copytree copies the targets of the links.
        shutil.copytree(jre.link_jre(), content / "unity/Jvm~/linux-x64")
    return _pack(content, out, "-jre" if with_jre else "")


def jvm(work: Path, out: Path, platform: str, repository: str = "") -> Path:
    """Packs the package with a platform's JVM into `out` and returns the archive."""
    content = work / platform
    shutil.copytree(jre.reduce_jre(platform), content / "Jvm~" / platform)
    manifest.write_jvm(ROOT, platform, content)
    if repository:
        manifest.write_links(content, repository)
    if platform in manifest.WITH_LIBRARY:
        library = f"Plugins/{platform}/{platforms.PLATFORMS[platform].library}"
        _copy(platforms.shim_of(platform), content / library)
        for asset in ("Plugins", f"Plugins/{platform}", library):
            (content / f"{asset}.meta").write_text(metas.meta_of(content, asset, manifest.JVM_PACKAGE + platform))
    return _pack(content, out, "")


def _pack(content: Path, out: Path, suffix: str) -> Path:
    archives = content.with_name("archive")
    archives.mkdir(exist_ok=True)
    out.mkdir(parents=True, exist_ok=True)
    # The archive must not depend on the umask.
    for path in content.rglob("*"):
        path.chmod(0o755 if path.is_dir() or path.stat().st_mode & 0o100 else 0o644)
    command: list[str | Path] = ["npm", "pack", content, "--pack-destination", archives, "--ignore-scripts", "--silent"]
    packed = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if packed.returncode != 0:
        raise Failure(f"package: npm pack failed with code {packed.returncode}; is the disk of '{archives}' full?")
    name = packed.stdout.strip()
    target = out / f"{name.removesuffix('.tgz')}{suffix}.tgz"
    # The archives may be on another disk.
    part = out / f".{target.name}.{os.getpid()}.part"
    try:
        shutil.move(archives / name, part)
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)
    return target


def _stage(content: Path, all_platforms: bool) -> None:
    """Copies the package's content to a folder: the files that package.json lists, and the build outputs for all platforms or for this one."""
    for source in manifest.sources(ROOT):
        _copy(ROOT / source, content / source)
    unity = content / "unity"
    plugins, jars, tools = unity / "Runtime/Plugins", unity / "Jvm~", unity / "Tools~"
    _copy(places.CSHARP / "Collektive.FlatBuffers.dll", plugins / "Collektive.FlatBuffers.dll")
    _copy(GENERATED / "bridge", unity / "Runtime/Bridge/Generated")
    for jar in (places.HOST_JAR, places.LIBRARY_JAR, places.ADAPTER_JAR):
        _copy(jar, jars / jar.name)
    for file in (places.GENERATOR_JAR, places.TESTING_JAR, ROOT / "schema/types.fbs", places.LINKS / "Links.kt",
                 ROOT / "scripts/template/build.gradle.kts"):
        _copy(file, tools / file.name)
    _copy(places.compiler_plugin(), tools / "collektive-compiler-plugin.jar")
    _strip(places.FLATC, tools / "linux-x64/flatc")
    if all_platforms:
        for platform in platforms.PLATFORMS.keys() - manifest.WITH_LIBRARY.keys():
            library = platforms.shim_of(platform)
            _copy(library, plugins / platform / library.name)
        for platform in platforms.FLATC_PLATFORMS:
            _copy(platforms.fetch_flatc(platform), tools / platform)
    else:
        _strip(places.SHIM / "libcollektive_shim.so", plugins / "linux-x64/libcollektive_shim.so")
    for schema in (unity / "Samples~").glob("*/*.fbs"):
        sample = schema.parent
        _copy(GENERATED / "samples" / sample.name, sample / "Generated")
        library = schema.with_suffix(".clkprograms")
        _copy(places.SAMPLE_PROGRAMS / library.name, library)
        # The samples' Kotlin is compiled and tested in jvm-host/programs, so it is copied from there.
        for program in sample_programs.sources(schema):
            _copy(program, sample / "Programs" / program.name)
    metas.write_missing(content)


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        # Samples that were run or generated in their folders contain results, with paths of this computer, and earlier code.
        shutil.copytree(source, target, dirs_exist_ok=True, ignore=shutil.ignore_patterns("out", "Generated"))
    else:
        shutil.copy(source, target)


def _strip(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    run_logged("strip", ["strip", "--strip-unneeded", "-o", target, source])
