"""Draws the icons of components and assets as PNG files of 64 pixels: `icons.py FOLDER`. The repository contains them in unity/Editor/Icons.

The colours are visible in both the light and the dark theme of the editor.
"""
import itertools
import math
import struct
import sys
import zlib
from collections.abc import Callable
from pathlib import Path

SIZE = 64
SAMPLES = 4
BLUE = (82, 130, 235)
ORANGE = (240, 150, 40)
GREY = (140, 148, 165)

Colour = tuple[int, int, int]
Shape = tuple[Callable[[float, float], bool], Colour, float]


def disc(x: float, y: float, radius: float, colour: Colour = BLUE, opacity: float = 1) -> Shape:
    return lambda px, py: math.hypot(px - x, py - y) <= radius, colour, opacity


def ring(x: float, y: float, radius: float, width: float, colour: Colour = GREY) -> Shape:
    return lambda px, py: abs(math.hypot(px - x, py - y) - radius) <= width / 2, colour, 1


def line(x1: float, y1: float, x2: float, y2: float, width: float = 5, colour: Colour = GREY) -> Shape:
    length = (x2 - x1) ** 2 + (y2 - y1) ** 2

    def inside(px: float, py: float) -> bool:
        share = min(1, max(0, ((px - x1) * (x2 - x1) + (py - y1) * (y2 - y1)) / length))
        return math.hypot(px - x1 - share * (x2 - x1), py - y1 - share * (y2 - y1)) <= width / 2
    return inside, colour, 1


def box(x1: float, y1: float, x2: float, y2: float, colour: Colour = GREY) -> Shape:
    return lambda px, py: x1 <= px <= x2 and y1 <= py <= y2, colour, 1


def around(count: int, radius: float, start: float = -math.pi / 2) -> list[tuple[float, float]]:
    """Returns evenly spaced points on a circle in the middle of the icon."""
    return [(32 + radius * math.cos(start + 2 * math.pi * i / count), 32 + radius * math.sin(start + 2 * math.pi * i / count)) for i in range(count)]


def path(*points: tuple[float, float], width: float = 5, colour: Colour = GREY) -> list[Shape]:
    return [line(*start, *end, width, colour) for start, end in itertools.pairwise(points)]


TRIANGLE = around(3, 22)
ICONS: dict[str, list[Shape]] = {
    "SimulationManager": [*path(*TRIANGLE, TRIANGLE[0]), disc(*TRIANGLE[0], 10, ORANGE), disc(*TRIANGLE[1], 10), disc(*TRIANGLE[2], 10)],
    "Node": [ring(32, 32, 25, 5), disc(32, 32, 14)],
    "LinkView": [line(14, 48, 50, 16, 9, ORANGE), disc(14, 48, 10), disc(50, 16, 10)],
    "SmoothView": [disc(14, 46, 8, BLUE, 0.3), disc(28, 34, 10, BLUE, 0.6), disc(46, 22, 13)],
    "RadiusNeighbourhood": [ring(32, 32, 27, 4), line(32, 32, 47, 20), disc(32, 32, 10, ORANGE), disc(48, 19, 8)],
    "KNearestNeighbourhood": [*[line(32, 32, *end) for end in around(3, 24)], disc(32, 32, 10, ORANGE), *[disc(*place, 8) for place in around(3, 24)]],
    "LineOfSightNeighbourhood": [line(10, 14, 54, 14), line(10, 50, 27, 50), box(29, 28, 36, 62, ORANGE), *[disc(x, y, 8) for x in (10, 54) for y in (14, 50)]],
    "TriggerNeighbourhood": [*path((8, 8), (56, 8), (56, 56), (8, 56), (8, 8), colour=GREY), disc(32, 32, 11, ORANGE), disc(56, 32, 8)],
    "ExplicitNeighbourhood": [*path((10, 50), (24, 18), (42, 46), (54, 14)), *[disc(x, y, 8) for x, y in ((10, 50), (24, 18), (42, 46), (54, 14))]],
    "IntensitySource": [*[line(32 + (x - 32) * 0.66, 32 + (y - 32) * 0.66, x, y, 5, ORANGE) for x, y in around(8, 28)], disc(32, 32, 13, ORANGE)],
    "JvmSettingsAsset": [*[line(32, 32, x, y, 10) for x, y in around(8, 24)], disc(32, 32, 20, GREY), disc(32, 32, 9, ORANGE)],
    "ProgramLibrary": [box(10, 10, 22, 54), box(26, 10, 38, 54, ORANGE), *path((47, 12), (55, 52), width=10, colour=BLUE)],
    "AggregateProgram": [*path((22, 12), (6, 32), (22, 52), width=7, colour=BLUE), *path((42, 12), (58, 32), (42, 52), width=7, colour=BLUE),
                         disc(32, 32, 7, ORANGE)],
}


def pixel(shapes: list[Shape], x: int, y: int) -> bytes:
    """Returns the colour and opacity of a pixel, averaged over several samples. Transparent samples do not affect the colour."""
    total, weight = [0.0, 0.0, 0.0], 0.0
    for i in range(SAMPLES * SAMPLES):
        px, py = x + (i % SAMPLES + 0.5) / SAMPLES, y + (i // SAMPLES + 0.5) / SAMPLES
        top = next(((colour, opacity) for inside, colour, opacity in reversed(shapes) if inside(px, py)), None)
        if top:
            total = [sum_ + channel * top[1] for sum_, channel in zip(total, top[0])]
            weight += top[1]
    return bytes([*(round(channel / weight) if weight else 0 for channel in total), round(255 * weight / SAMPLES ** 2)])


def png(shapes: list[Shape]) -> bytes:
    rows = b"".join(b"\0" + b"".join(pixel(shapes, x, y) for x in range(SIZE)) for y in range(SIZE))

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


if __name__ == "__main__":
    for name, shapes in ICONS.items():
        Path(sys.argv[1], f"{name}.png").write_bytes(png(shapes))
