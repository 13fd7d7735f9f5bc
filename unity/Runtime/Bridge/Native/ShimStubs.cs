#if UNITY_5_3_OR_NEWER && !UNITY_EDITOR && !UNITY_STANDALONE
namespace Collektive.Bridge
{
    /// <summary>
    /// Stubs for platforms without the native library. Their players can be built, and report the missing library at run time.
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
    }
}
#endif
