"""Creates the animations in the README: `moving_picture.py PAGE FILE.webp`.

PAGE is the replay page of a demo, or the address that `./collektive live --no-browser --set nodes=300` prints, whose program is then edited. Run
`./collektive setup npm site-tools` first, and run this script with build/site-tools/bin/python. The animation has twelve pictures per second, and
shows the last one for two seconds.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image  # type: ignore[import-not-found]

HERE = Path(__file__).resolve().parent
REPLAY = ("moving_picture.mjs", 90, (720, 405))
LIVE = ("live_picture.mjs", 54, (900, 506))
MILLIS, LAST_MILLIS = 83, 2000


def main(page: str, target: str) -> None:
    """Captures the frames in a browser and joins them to an animation."""
    script, frames, size = LIVE if page.startswith("http:") else REPLAY
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["node", HERE / script, page, folder, str(frames)], check=True,
                       env={**os.environ, "COLLEKTIVE_NODE_MODULES": str(HERE.parents[2] / "build/npm/node_modules")})
        pictures = [Image.open(path).convert("RGB").resize(size, Image.Resampling.LANCZOS) for path in sorted(Path(folder).glob("*.png"))]
    durations = [MILLIS] * (len(pictures) - 1) + [LAST_MILLIS]
    pictures[0].save(target, save_all=True, append_images=pictures[1:], duration=durations, loop=0, quality=60, method=4)


if __name__ == "__main__":
    main(*sys.argv[1:])
