#if UNITY_5_3_OR_NEWER && !UNITY_EDITOR && !UNITY_STANDALONE
using System;

namespace Collektive.Bridge
{
    /// <summary>
    /// Stubs for platforms without the native library. With them, players for such platforms can be built, and report the missing library at run time.
    /// </summary>
    internal static unsafe partial class Shim
    {
        private const int Unsupported = (int)BridgeError.Host;

        internal static uint clk_version() => Major << 16;

        internal static byte* clk_error_text(int code) => null;

        internal static int clk_last_error(byte* buffer, int capacity) => 0;

        internal static int clk_jvm_start(JvmConfig* config) => Unsupported;

        internal static int clk_jvm_check(JvmConfig* config) => Unsupported;

        internal static int clk_jvm_state() => 0;

        internal static int clk_jvm_description(byte* buffer, int capacity) => 0;

        internal static int clk_jvm_stop(int limitMs) => Unsupported;

        internal static int clk_slot_acquire(int capacity, ulong* slot, Memory* memory) => Unsupported;

        internal static int clk_slot_grow(ulong slot, int capacity, int keep, Memory* memory) => Unsupported;

        internal static int clk_slot_release(ulong slot) => Unsupported;

        internal static int clk_session_open(ulong slot, int offset, int length, int limitMs, ulong* session, Answer* answer) => Unsupported;

        internal static int clk_step(ulong session, ulong slot, int offset, int length, int limitMs, Answer* answer) => Unsupported;

        internal static int clk_session_wait(ulong session, int waitMs, Answer* answer) => Unsupported;

        internal static int clk_session_close(ulong session, int limitMs) => Unsupported;

        internal static int clk_control(ulong slot, int offset, int length, int limitMs, Answer* answer) => Unsupported;

        internal static int clk_log_read(int* level, byte* buffer, int capacity) => Unsupported;

        internal static int clk_get_stats(Stats* stats) => Unsupported;

        internal static IntPtr clk_neighbours_create() => IntPtr.Zero;

        internal static void clk_neighbours_destroy(IntPtr neighbours)
        {
        }

        internal static int clk_neighbours_place(IntPtr neighbours, NodePoint* points, int count, float cell) => Unsupported;

        internal static int clk_neighbours_within(IntPtr neighbours, float x, float y, float z, float inner, float outer, NearPoint** found) => Unsupported;

        internal static int clk_neighbours_nearest(IntPtr neighbours, float x, float y, float z, int limit, float guess, NearPoint** found) => Unsupported;

        internal static int clk_neighbours_add_rule(IntPtr neighbours) => Unsupported;

        internal static void clk_neighbours_remove_rule(IntPtr neighbours, int rule)
        {
        }

        internal static int clk_neighbours_update(IntPtr neighbours, RuleSearch* searches, int count, int threads, int maxLinks) => Unsupported;

        internal static int clk_neighbours_take(IntPtr neighbours, int rule, int centre, RuleNeighbour* list, int count, float tolerance, int both) =>
            Unsupported;

        internal static int clk_neighbours_hold(IntPtr neighbours, LinkRecord* link) => Unsupported;

        internal static int clk_neighbours_release(IntPtr neighbours, int from, int to) => Unsupported;

        internal static int clk_neighbours_has(IntPtr neighbours, int from, int to) => Unsupported;

        internal static int clk_neighbours_know(IntPtr neighbours, int id, int known) => Unsupported;

        internal static int clk_neighbours_drop(IntPtr neighbours, int* ids, int count) => Unsupported;

        internal static int clk_neighbours_flush(IntPtr neighbours, LinkChanges* changes) => Unsupported;

        internal static void clk_neighbours_pairs(IntPtr neighbours, LinkPairs* pairs)
        {
        }
    }
}
#endif
