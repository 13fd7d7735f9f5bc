#!/usr/bin/env python3
"""Makes one animated WebP of a folder of PNGs: `moving_picture.py FOLDER FILE.webp`. Twelve pictures a second, and the last one for two seconds."""
import glob
import os
import sys

from PIL import Image

SIZE = (720, 405)
MILLIS, LAST_MILLIS = 83, 2000


def main():
    folder, target = sys.argv[1:]
    pictures = [Image.open(path).convert("RGB").resize(SIZE, Image.Resampling.LANCZOS) for path in sorted(glob.glob(os.path.join(folder, "*.png")))]
    durations = [MILLIS] * (len(pictures) - 1) + [LAST_MILLIS]
    pictures[0].save(target, save_all=True, append_images=pictures[1:], duration=durations, loop=0, quality=60, method=4)


if __name__ == "__main__":
    main()
