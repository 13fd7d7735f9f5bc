"""Reads the recording inside a replay page; the format is unity/Headless~/Replay/FORMAT.md."""
import base64
import gzip
import json
import re
import struct


def read(path):
    """Metadata, and a list of frames: (time, {id: (x, y, z, scalar or None)}, set of links)."""
    text = open(path, encoding="utf-8").read()
    data = gzip.decompress(base64.b64decode(re.search(r'<script id="replay"[^>]*>([^<]*)</script>', text).group(1)))
    assert data[:4] == b"CLKR", "magic"
    version, length = struct.unpack_from("<II", data, 4)
    assert version == 1
    metadata = json.loads(data[12:12 + length])
    at = 12 + length
    frames, slots, links = [], [], set()
    while True:
        (size,) = struct.unpack_from("<I", data, at)
        at += 4
        if size == 0:
            assert at == len(data), "nothing follows the end"
            return metadata, frames
        frames.append(_frame(data[at:at + size], slots, links))
        at += size


def _frame(data, slots, links):
    (time,) = struct.unpack_from("<d", data, 0)
    (new,) = struct.unpack_from("<I", data, 8)
    slots.extend(struct.unpack_from(f"<{new}i", data, 12))
    at = 12 + 4 * new
    bits = data[at:at + (len(slots) + 7) // 8]
    at += len(bits)
    present = [slot for slot in range(len(slots)) if bits[slot >> 3] >> (slot & 7) & 1]
    low = struct.unpack_from("<4f", data, at)
    high = struct.unpack_from("<4f", data, at + 16)
    at += 32
    axes = []
    for axis in range(4):
        steps = 65535 if axis < 3 else 65534
        quanta = struct.unpack_from(f"<{len(present)}H", data, at)
        at += 2 * len(present)
        axes.append([None if axis == 3 and q == 65535 else low[axis] + q * (high[axis] - low[axis]) / steps for q in quanta])
    removed, at = _pairs(data, at)
    added, at = _pairs(data, at)
    assert at == len(data), "the frame's length"
    links -= set(removed)
    links |= set(added)
    nodes = {slots[slot]: values for slot, *values in zip(present, *axes)}
    return time, {node: tuple(values) for node, values in nodes.items()}, {(slots[a], slots[b]) for a, b in links}


def _pairs(data, at):
    (count,) = struct.unpack_from("<I", data, at)
    at += 4
    pairs, a, b = [], -1, 0
    for _ in range(count):
        step, at = _varint(data, at)
        rise, at = _varint(data, at)
        b = b + rise if step == 0 else a + step + rise
        a += step
        pairs.append((a, b))
    return pairs, at


def _varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at
