"""Checks that each component in the menus and each asset type of the package has an icon."""
import re
from collections.abc import Iterator

from validator.assets import Assets


def problems(assets: Assets) -> Iterator[str]:
    for path in assets.with_ending(".cs"):
        if not path.startswith("unity/Runtime/Unity/") or not re.search(r"\[AddComponentMenu\(\"[^\"]|sealed class \w+ : ScriptableObject", assets.read(path)):
            continue
        icon = re.search(r"(?m)^  icon: \{fileID: 2800000, guid: (\w+), type: 3\}$", assets.read(path + ".meta"))
        if not icon or not assets.guids.get(icon[1], "").endswith(".png"):
            yield f"{path}.meta: the script has no icon; draw one with scripts/build/icons.py"
