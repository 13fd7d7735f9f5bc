"""Reads the recording inside a replay page, in the format of unity/Headless~/Replay/FORMAT.md."""
import base64
import gzip
import json
import re
import struct


def read(path):
    """Returns the metadata, a list of frames, and the set of links (from, to) in the last one. A frame is (time, {id: (x, y, z, first field or None)})."""
    text = open(path, encoding="utf-8").read()
    lines = re.search(r'<script id="replay"[^>]*>([^<]*)</script>', text).group(1).split("\n")
    header = json.loads(_unpack(lines[0]))
    assert header["version"] == 6
    assert header["length"] == sum(1 + len(line) for line in lines[1:])
    times, frames = iter(header["times"]), []
    for line in lines[1:]:
        segment = _Segment(_unpack(line), header)
        while segment.at < len(segment.data):
            frames.append((next(times), segment.frame()))
    assert len(frames) == len(header["times"])
    return header["metadata"], frames, {(segment.ids[a], segment.ids[b]) for a, b in segment.links}


def _unpack(text):
    return gzip.decompress(base64.b64decode(text))


class _Segment:
    def __init__(self, data, header) -> None:
        self.data, self.at = data, 0
        self.ranges = [self.range() if field["kind"] == "number" else None for field in header["fields"]]
        self.ids, self.step = [], header["positionStep"]
        for _ in range(self.number()):
            self.ids.append((self.ids[-1] if self.ids else 0) + self.signed())
        self.last = [[0] * len(self.ids) for _ in range(3 + len(self.ranges))]
        self.motion = [[0] * len(self.ids) for _ in range(3 + len(self.ranges))]
        self.seen, self.links = set(), set()

    def frame(self):
        slots = self.number()
        bits = self.data[self.at:self.at + (slots + 7) // 8]
        self.at += len(bits)
        present = [slot for slot in range(slots) if bits[slot >> 3] >> (slot & 7) & 1]
        for last, motion in zip(self.last, self.motion):
            for slot in present:
                moved = _wrapped(motion[slot] + self.signed())
                last[slot] = _wrapped(last[slot] + moved)
                if slot in self.seen:
                    motion[slot] = moved
        self.seen.update(present)
        nodes = {self.ids[slot]: (*(axis[slot] * self.step for axis in self.last[:3]), self.value(0, self.last[3][slot])) for slot in present}
        self.number()  # skips the total number of links
        self.links -= set(self.pairs())
        self.links |= set(self.pairs())
        return nodes

    def range(self):
        self.at += 16
        return struct.unpack_from("<2d", self.data, self.at - 16)

    def value(self, field, steps):
        if steps == 0:
            return None
        if self.ranges[field] is None:
            return (steps - 1) >> 1 ^ -((steps - 1) & 1)
        low, high = self.ranges[field]
        return low + (steps - 1) * (high - low) / 65534

    def pairs(self):
        pairs, a, b = [], -1, 0
        for _ in range(self.number()):
            step = self.number()
            rest = self.number()
            b = (b if step == 0 else a + step) + (rest >> 2)
            a += step
            pairs += [(a, b)] * (rest & 1) + [(b, a)] * (rest >> 1 & 1)
        return pairs

    def signed(self):
        coded = self.number()
        return coded >> 1 ^ -(coded & 1)

    def number(self):
        value = shift = 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value


def _wrapped(value):
    return (value + 0x80000000) % 0x100000000 - 0x80000000
