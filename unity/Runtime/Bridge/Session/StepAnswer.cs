using System;
using System.Runtime.InteropServices;
using Collektive.FlatBuffers;
using Frame = org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>The JVM's answer to a step, read in place; valid until the session's next call. Not thread-safe.</summary>
    internal sealed class StepAnswer
    {
        /// <summary>VTable offset of <c>StepResponse.actuators</c>, its fourth field.</summary>
        private const int ActuatorsField = 4 + 3 * 2;

        /// <summary>VTable offset of <c>StepResponse.nodes</c>, its third field.</summary>
        private const int NodesField = 4 + 2 * 2;

        /// <summary>VTable offset of <c>StepResponse.messages</c>, its fifteenth field.</summary>
        private const int MessagesField = 4 + 14 * 2;

        private Frame.StepResponse response;
        private Table table;

        internal StepAnswer(ActuatorBuffer actuators)
        {
            Actuators = actuators;
        }

        /// <summary>The actuator data. Element i belongs to the i-th of the <see cref="Nodes"/>.</summary>
        public ActuatorBuffer Actuators { get; }

        /// <summary>Number of rounds that produced an answer.</summary>
        public int NodeCount => response.NodesLength;

        /// <summary>The tick that was run.</summary>
        public ulong Tick => response.Tick;

        /// <summary>First 8 bytes of the chained digest of all rounds so far.</summary>
        public ulong Digest => response.Digest;

        /// <summary>Rounds that failed in this tick.</summary>
        public int ErrorCount => response.ErrorsLength;

        /// <summary>Number of nodes in the engine.</summary>
        public int EngineNodes => response.NodeCount;

        /// <summary>Number of directed links in the engine.</summary>
        public int EngineLinks => response.LinkCount;

        /// <summary>Microseconds that the JVM spent on the step.</summary>
        public int HostMicros => response.HostMicros;

        /// <summary>Microseconds of <see cref="HostMicros"/> that the rounds took.</summary>
        public int RoundMicros => response.RoundMicros;

        /// <summary>Message counts of the step.</summary>
        public NetworkCounts Network => new NetworkCounts(response.Sent, response.Dropped, response.Delayed, response.Expired);

        /// <summary>Whether the step replaced the programs, or tried to.</summary>
        public bool HasReload => response.Reload != null;

        /// <summary>The outcome of the replacement. Allocates.</summary>
        public ReloadOutcome Reload
        {
            get
            {
                var reload = response.Reload.GetValueOrDefault();
                return new ReloadOutcome(reload.Error, reload.Stored, reload.Kept);
            }
        }

        /// <summary>The programs after the replacement.</summary>
        internal Frame.ReloadResponse ReloadedPrograms => response.Reload.GetValueOrDefault();

        /// <summary>Sizes of the messages of <see cref="Nodes"/>; empty unless requested.</summary>
        public Span<MessageSize> Messages => Vector<MessageSize>(MessagesField);

        /// <summary>Ids of the nodes with an answer, ascending. They are returned as a block, because a call for each id would take longer on Mono.</summary>
        public Span<int> Nodes => Vector<int>(NodesField);

        /// <summary>Number of metrics that <see cref="Metric"/> returns; 0 if the step did not request them.</summary>
        public int MetricCount => response.MetricsLength;

        /// <summary>Returns the value of a metric after the step. If the metric failed, the value is NaN and the error is set. Allocates.</summary>
        public (double Value, string Error) Metric(int index)
        {
            var metric = response.Metrics(index).GetValueOrDefault();
            return (metric.Value, metric.Error);
        }

        /// <summary>Id of the node that the step inspected, or -1.</summary>
        public int InspectedNode => response.Inspection?.Node ?? -1;

        /// <summary>
        /// Nanoseconds that the last round of <see cref="InspectedNode"/> took, or 0 if the node has had no round since its inspection began.
        /// </summary>
        public long InspectedRoundNanos => response.Inspection.GetValueOrDefault().RoundNanos;

        /// <summary>Number of stored values of <see cref="InspectedNode"/>. Call it only if that is not -1.</summary>
        public int StateCount => response.Inspection.GetValueOrDefault().StateLength;

        /// <summary>Returns the path and the text of a stored value of <see cref="InspectedNode"/>. Values are sorted by path. Allocates.</summary>
        public (string Path, string Value) State(int index)
        {
            var entry = response.Inspection.GetValueOrDefault().State(index).GetValueOrDefault();
            return (entry.Path, entry.Value);
        }

        /// <summary>Returns the node, the program and the error message of a failed round. Allocates.</summary>
        public (int Node, string Program, string Message) Error(int index)
        {
            var error = response.Errors(index).GetValueOrDefault();
            return (error.Node, error.Program, error.Message);
        }

        internal void Read(ByteBuffer answer)
        {
            response = Frame.StepResponse.GetRootAsStepResponse(answer);
            table = new Table(answer.GetInt(answer.Position) + answer.Position, answer);
            var field = table.__offset(ActuatorsField);
            if (field == 0) throw new BridgeException(BridgeError.Java, "the host's answer contains no actuator data");
            Actuators.Attach(answer, table.__indirect(table.bb_pos + field));
            if (Actuators.Count != NodeCount)
            {
                throw new BridgeException(
                    BridgeError.Java, "the host sent actuator data of " + Actuators.Count + " nodes instead of " + NodeCount + ": report an issue");
            }
        }

        private unsafe Span<T> Vector<T>(int field) where T : unmanaged
        {
            var offset = table.__offset(field);
            return offset == 0 ? default : MemoryMarshal.Cast<byte, T>(table.bb.ToSpan(table.__vector(offset), table.__vector_len(offset) * sizeof(T)));
        }
    }

    /// <summary>Number of values in a node's message to its neighbours, and their size in bytes. Has the layout of <c>MessageSizes</c> in the schema.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct MessageSize
    {
        internal int Values;
        internal int Bytes;
    }
}
