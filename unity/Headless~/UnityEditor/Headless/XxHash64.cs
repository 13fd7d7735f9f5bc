using System;

namespace UnityEditor.Headless
{
    /// The 64-bit xxHash with seed 0.
    static class XxHash64
    {
        const ulong P1 = 0x9E3779B185EBCA87, P2 = 0xC2B2AE3D27D4EB4F, P3 = 0x165667B19E3779F9, P4 = 0x85EBCA77C2B2AE63, P5 = 0x27D4EB2F165667C5;

        internal static ulong Of(byte[] data)
        {
            var at = 0;
            var hash = P5;
            if (data.Length >= 32)
            {
                var lanes = new[] { unchecked(P1 + P2), P2, 0UL, unchecked(0UL - P1) };
                for (; at <= data.Length - 32; at += 32)
                    for (var i = 0; i < 4; i++) lanes[i] = Round(lanes[i], BitConverter.ToUInt64(data, at + 8 * i));
                hash = Rotate(lanes[0], 1) + Rotate(lanes[1], 7) + Rotate(lanes[2], 12) + Rotate(lanes[3], 18);
                foreach (var lane in lanes) hash = (hash ^ Round(0, lane)) * P1 + P4;
            }
            hash += (ulong)data.Length;
            for (; at <= data.Length - 8; at += 8) hash = Rotate(hash ^ Round(0, BitConverter.ToUInt64(data, at)), 27) * P1 + P4;
            for (; at <= data.Length - 4; at += 4) hash = Rotate(hash ^ BitConverter.ToUInt32(data, at) * P1, 23) * P2 + P3;
            for (; at < data.Length; at++) hash = Rotate(hash ^ data[at] * P5, 11) * P1;
            hash = (hash ^ (hash >> 33)) * P2;
            hash = (hash ^ (hash >> 29)) * P3;
            return hash ^ (hash >> 32);
        }

        static ulong Round(ulong lane, ulong input) => Rotate(lane + input * P2, 31) * P1;
        static ulong Rotate(ulong value, int bits) => value << bits | value >> (64 - bits);
    }
}
