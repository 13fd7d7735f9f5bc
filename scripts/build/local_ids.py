"""Computes the ids by which Unity's scenes and prefabs refer to objects that a scripted importer creates.

An id is the 64-bit xxHash of the object's native type and identifier. This was verified with `.inputactions` and `.shadergraph` assets of public
projects.
"""
_MASK = (1 << 64) - 1
_P1, _P2, _P3, _P4, _P5 = 0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5


def of_script(identifier: str) -> int:
    """Returns the id of a ScriptableObject that an importer created with an identifier."""
    return of("MonoBehaviour", identifier)


def of(native_type: str, identifier: str) -> int:
    """Returns the id of an object of a native type."""
    value = xxh64(f"Type:{native_type}->{identifier}0".encode())
    return value - (1 << 64) if value >> 63 else value


def xxh64(data: bytes) -> int:
    """Returns the 64-bit xxHash of data with seed 0."""
    at = 0
    value = _P5
    if len(data) >= 32:
        lanes = [(_P1 + _P2) & _MASK, _P2, 0, -_P1 & _MASK]
        while at <= len(data) - 32:
            lanes = [_round(lane, _number(data, at + 8 * i, 8)) for i, lane in enumerate(lanes)]
            at += 32
        value = sum(_rotate(lane, bits) for lane, bits in zip(lanes, (1, 7, 12, 18), strict=True)) & _MASK
        for lane in lanes:
            value = ((value ^ _round(0, lane)) * _P1 + _P4) & _MASK
    value = (value + len(data)) & _MASK
    while at <= len(data) - 8:
        value = (_rotate(value ^ _round(0, _number(data, at, 8)), 27) * _P1 + _P4) & _MASK
        at += 8
    if at <= len(data) - 4:
        value = (_rotate(value ^ _number(data, at, 4) * _P1 & _MASK, 23) * _P2 + _P3) & _MASK
        at += 4
    for byte in data[at:]:
        value = _rotate(value ^ byte * _P5 & _MASK, 11) * _P1 & _MASK
    value = (value ^ value >> 33) * _P2 & _MASK
    value = (value ^ value >> 29) * _P3 & _MASK
    return value ^ value >> 32


def _number(data: bytes, at: int, size: int) -> int:
    return int.from_bytes(data[at:at + size], "little")


def _round(lane: int, word: int) -> int:
    return _rotate((lane + word * _P2) & _MASK, 31) * _P1 & _MASK


def _rotate(value: int, bits: int) -> int:
    return (value << bits | value >> (64 - bits)) & _MASK
