using System.Collections.Generic;
using Collektive.FlatBuffers;
using Frame = org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>Queries the host about the JVM itself, with frames that belong to no session. May be called from any thread. Each query allocates.</summary>
    internal static unsafe class JvmControl
    {
        /// <summary>Lock that is held while an answer is read. The next query, or the end of the JVM, would overwrite the answer.</summary>
        internal static readonly object Gate = new object();

        private const int InitialCapacity = 4096;
        private const int LimitMs = 10000;

        private static readonly string[] Flags =
        {
            "InitialHeapSize", "MaxHeapSize", "ReservedCodeCacheSize", "TieredCompilation", "TieredStopAtLevel", "CompileThresholdScaling",
            "UseSharedSpaces", "AutoCreateSharedArchive", "UseLibmIntrinsic", "UseG1GC", "UseSerialGC", "UseParallelGC", "UseZGC", "UseShenandoahGC",
        };

        internal static JvmStatus Send(Query query)
        {
            lock (Gate) return SendNow(query);
        }

        private static JvmStatus SendNow(Query query)
        {
            var slot = new SlotAllocator(InitialCapacity);
            try
            {
                var builder = new FlatBufferBuilder(new ByteBuffer(slot, 0));
                Write(builder, query);
                var offset = builder.DataBuffer.Position;
                var answer = new Shim.Answer { Size = (uint)sizeof(Shim.Answer) };
                Shim.Check(Shim.clk_control(slot.Slot, offset, builder.DataBuffer.Length - offset, LimitMs, &answer));
                var memory = new AnswerMemory();
                memory.Point(answer);
                return new JvmStatus(Frame.ControlResponse.GetRootAsControlResponse(new ByteBuffer(memory, answer.Offset)));
            }
            finally
            {
                slot.Release();
            }
        }

        private static void Write(FlatBufferBuilder builder, Query query)
        {
            var names = new List<StringOffset>();
            foreach (var flag in Flags) names.Add(builder.CreateString(flag));
            var flags = Frame.ControlRequest.CreateFlagsVector(builder, names.ToArray());
            var settings = builder.CreateString(query.Settings ?? "");
            var path = builder.CreateString(query.Path ?? "");
            builder.Finish(Frame.ControlRequest.CreateControlRequest(builder, flags, query.Collect, query.Recording, settings, path).Value);
        }

        internal struct Query
        {
            internal bool Collect;
            internal Frame.RecordingAction Recording;
            internal string Settings;
            internal string Path;
        }
    }
}
