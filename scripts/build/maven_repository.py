"""Repairs Maven's local repository. Maven verifies a file only when it downloads it, so a file that is damaged later stays damaged."""
import hashlib
import os
import re
from pathlib import Path

from build.console import print_progress


def repair() -> bool:
    """Removes jars that do not match the checksum of their download, so that Maven fetches them again. Returns whether it removed any."""
    damaged = [jar for jar in _location().rglob("*.jar") if _differs(jar, jar.with_name(f"{jar.name}.sha1")) and not _is_installed(jar)]
    for jar in damaged:
        print_progress(f"removing {jar}, which is damaged; Maven will fetch it again")
        jar.unlink()
    return bool(damaged)


def _differs(jar: Path, stored: Path) -> bool:
    # A crash of the system can leave an empty file.
    checksum = stored.read_text().split()[:1] if stored.exists() else []
    return bool(checksum) and hashlib.sha1(jar.read_bytes(), usedforsecurity=False).hexdigest() != checksum[0].lower()


def _is_installed(jar: Path) -> bool:
    """Returns whether `mvn install` has written a jar. Maven then keeps the checksum of an earlier download."""
    origins = jar.with_name("_remote.repositories")
    return origins.is_file() and f"{jar.name}>=" in origins.read_text(errors="replace").splitlines()


def _location() -> Path:
    settings = Path.home() / ".m2/settings.xml"
    text = re.sub("<!--.*?-->", "", settings.read_text(), flags=re.DOTALL) if settings.exists() else ""
    named = re.search(r"-Dmaven\.repo\.local=(\S+)", os.environ.get("MAVEN_OPTS", "")) or (
        re.search(r"<localRepository>\s*(.+?)\s*</localRepository>", text))
    return Path(named[1].replace("${user.home}", str(Path.home()))) if named else Path.home() / ".m2/repository"
