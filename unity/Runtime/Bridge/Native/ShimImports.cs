#if UNITY_EDITOR || UNITY_STANDALONE || !UNITY_5_3_OR_NEWER
using System;
using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>Imports the library's functions, on platforms for which the library can exist.</summary>
    internal static unsafe partial class Shim
    {
        private const string Library = "collektive_shim";

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint clk_version();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* clk_error_text(int code);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_last_error(byte* buffer, int capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_start(JvmConfig* config);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_check(JvmConfig* config);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_state();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_description(byte* buffer, int capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_stop(int limitMs);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_slot_acquire(int capacity, ulong* slot, Memory* memory);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_slot_grow(ulong slot, int capacity, int keep, Memory* memory);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_slot_release(ulong slot);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_session_open(
            ulong slot, int offset, int length, int limitMs, ulong* session, Answer* answer);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_step(
            ulong session, ulong slot, int offset, int length, int limitMs, Answer* answer);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_session_wait(ulong session, int waitMs, Answer* answer);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_session_close(ulong session, int limitMs);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_control(ulong slot, int offset, int length, int limitMs, Answer* answer);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_log_read(int* level, byte* buffer, int capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_get_stats(Stats* stats);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr clk_neighbours_create();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void clk_neighbours_destroy(IntPtr neighbours);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_place(IntPtr neighbours, NodePoint* points, int count, float cell);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_within(IntPtr neighbours, float x, float y, float z, float inner, float outer, NearPoint** found);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_nearest(IntPtr neighbours, float x, float y, float z, int limit, float guess, NearPoint** found);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_add_rule(IntPtr neighbours);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void clk_neighbours_remove_rule(IntPtr neighbours, int rule);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_update(IntPtr neighbours, RuleSearch* searches, int count, int threads, int maxLinks);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_take(
            IntPtr neighbours, int rule, int centre, RuleNeighbour* list, int count, float tolerance, int both);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_hold(IntPtr neighbours, LinkRecord* link);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_release(IntPtr neighbours, int from, int to);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_has(IntPtr neighbours, int from, int to);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_know(IntPtr neighbours, int id, int known);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_drop(IntPtr neighbours, int* ids, int count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_neighbours_flush(IntPtr neighbours, LinkChanges* changes);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void clk_neighbours_pairs(IntPtr neighbours, LinkPairs* pairs);
    }
}
#endif
