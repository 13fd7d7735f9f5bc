using System;
using System.Collections.Generic;
using Collektive.FlatBuffers;
using Frame = org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>
    /// The changes since the last tick, and the due nodes. The owner of the session fills the request. <see cref="Session.Step"/> writes it to the request
    /// slot, and clears it when the step succeeds. Not thread-safe; no allocation in steady state.
    /// </summary>
    internal sealed class StepRequest
    {
        private readonly GrowingArray<int> nodesRemoved = new GrowingArray<int>();
        private readonly List<NewNode> nodesAdded = new List<NewNode>();
        private readonly List<NewNode> nodesChanged = new List<NewNode>();
        private readonly GrowingArray<int> due = new GrowingArray<int>();
        private IReadOnlyList<string> reloadedJars;
        private bool hasSentGlobals;

        internal StepRequest(SensorBuffer sensors, GlobalBuffer globals)
        {
            Sensors = sensors;
            Globals = globals;
        }

        /// <summary>Sensor data of the due nodes. Element i belongs to the node of the i-th call of <see cref="AddDue"/>.</summary>
        public SensorBuffer Sensors { get; }

        /// <summary>Global data, or null if the schema has none.</summary>
        public GlobalBuffer Globals { get; }

        /// <summary>Whether the next step sends <see cref="Globals"/>.</summary>
        public bool GlobalsChanged { get; set; }

        /// <summary>Whether answers contain the sizes of messages.</summary>
        public bool MeasuresMessages { get; set; }

        /// <summary>Whether answers contain <see cref="StepAnswer.Metric"/>.</summary>
        public bool Measures { get; set; }

        /// <summary>Id of the node that <see cref="StepAnswer.InspectedNode"/> describes, or -1.</summary>
        public int Inspected { get; set; } = -1;

        /// <summary>Directed links added or changed since the last step.</summary>
        internal GrowingArray<LinkRecord> Links { get; } = new GrowingArray<LinkRecord>();

        /// <summary>Directed links removed since the last step.</summary>
        internal GrowingArray<LinkEnds> LinksRemoved { get; } = new GrowingArray<LinkEnds>();

        /// <summary>Number of nodes that are due in the next step.</summary>
        public int DueCount => due.Count;

        /// <summary>Returns the id of a due node.</summary>
        public int Due(int index) => due.Items[index];

        /// <summary>Adds a node. The request refers to <paramref name="parameters"/> until the step.</summary>
        public void AddNode(int id, string program, IReadOnlyList<KeyValuePair<string, string>> parameters)
        {
            nodesAdded.Add(new NewNode(id, program, parameters));
        }

        /// <summary>Replaces the parameters of an existing node. The program must be the one passed to <see cref="AddNode"/>.</summary>
        public void ChangeNode(int id, string program, IReadOnlyList<KeyValuePair<string, string>> parameters)
        {
            nodesChanged.Add(new NewNode(id, program, parameters));
        }

        /// <summary>Removes a node and its links. The step applies removals before additions.</summary>
        public void RemoveNode(int id)
        {
            nodesRemoved.Add(id);
        }

        /// <summary>Adds or updates a directed link.</summary>
        public void SetLink(LinkRecord link)
        {
            Links.Add(link);
        }

        /// <summary>Removes a directed link between two nodes that remain in the session.</summary>
        public void RemoveLink(LinkEnds link)
        {
            LinksRemoved.Add(link);
        }

        /// <summary>Replaces the programs of all nodes before the next step, with the programs in the jars at the given paths.</summary>
        public void Reload(IReadOnlyList<string> jars)
        {
            reloadedJars = jars;
            // The new programs read the global data with new classes, so it must be sent again.
            GlobalsChanged |= hasSentGlobals;
        }

        /// <summary>Schedules a round of a node in the next step. Call in ascending order of ids.</summary>
        public void AddDue(int id)
        {
            due.Add(id);
        }

        /// <summary>Clears the due nodes, but keeps the changes.</summary>
        public void ClearDue()
        {
            due.Clear();
        }

        internal void Clear()
        {
            nodesRemoved.Clear();
            nodesAdded.Clear();
            nodesChanged.Clear();
            LinksRemoved.Clear();
            Links.Clear();
            due.Clear();
            hasSentGlobals |= GlobalsChanged;
            GlobalsChanged = false;
            reloadedJars = null;
        }

        internal unsafe void Write(FlatBufferBuilder builder, ulong tick, double time, double deltaTime)
        {
            var sensors = Sensors.Write(builder, due.Count);
            var globals = GlobalsChanged ? Globals.Write(builder) : 0;
            var dueVector = Block(builder, due, sizeof(int));
            var linksVector = Block(builder, Links, sizeof(LinkRecord));
            var linksRemovedVector = Block(builder, LinksRemoved, sizeof(LinkEnds));
            var reload = reloadedJars == null ? default : WriteReload(builder);
            var nodesAddedVector = WriteNodes(builder, nodesAdded);
            var nodesChangedVector = WriteNodes(builder, nodesChanged);
            var nodesRemovedVector = Block(builder, nodesRemoved, sizeof(int));
            builder.Finish(Frame.StepRequest.CreateStepRequest(
                builder, tick, time, deltaTime, nodesRemovedVector, nodesAddedVector, linksRemovedVector, linksVector, dueVector,
                new Offset<Frame.Opaque>(sensors), new Offset<Frame.Opaque>(globals), reload, MeasuresMessages, Measures, nodesChangedVector, Inspected).Value);
        }

        private Offset<Frame.ReloadRequest> WriteReload(FlatBufferBuilder builder)
        {
            var paths = new StringOffset[reloadedJars.Count];
            for (var i = 0; i < paths.Length; i++) paths[i] = builder.CreateString(reloadedJars[i]);
            return Frame.ReloadRequest.CreateReloadRequest(builder, Frame.ReloadRequest.CreateJarsVector(builder, paths));
        }

        private static unsafe VectorOffset Block<T>(FlatBufferBuilder builder, GrowingArray<T> array, int elementSize)
            where T : unmanaged
        {
            if (array.Count == 0) return default;
            builder.StartVector(elementSize, array.Count, sizeof(int));
            fixed (T* items = array.Items) builder.Put<byte>((IntPtr)items, array.Count * elementSize);
            return builder.EndVector();
        }

        private static VectorOffset WriteNodes(FlatBufferBuilder builder, List<NewNode> nodes)
        {
            if (nodes.Count == 0) return default;
            var offsets = new Offset<Frame.NodeAdded>[nodes.Count];
            for (var i = 0; i < offsets.Length; i++)
            {
                var node = nodes[i];
                var parameters = WriteParameters(builder, node.Parameters);
                var program = string.IsNullOrEmpty(node.Program) ? default : builder.CreateSharedString(node.Program);
                offsets[i] = Frame.NodeAdded.CreateNodeAdded(builder, node.Id, program, parameters);
            }
            return Frame.StepRequest.CreateNodesAddedVector(builder, offsets);
        }

        private static VectorOffset WriteParameters(
            FlatBufferBuilder builder, IReadOnlyList<KeyValuePair<string, string>> parameters)
        {
            if (parameters == null || parameters.Count == 0) return default;
            var offsets = new Offset<Frame.Parameter>[parameters.Count];
            for (var i = 0; i < offsets.Length; i++)
            {
                offsets[i] = Frame.Parameter.CreateParameter(
                    builder, builder.CreateSharedString(parameters[i].Key), builder.CreateSharedString(parameters[i].Value));
            }
            return Frame.NodeAdded.CreateParametersVector(builder, offsets);
        }

        private readonly struct NewNode
        {
            internal readonly int Id;
            internal readonly string Program;
            internal readonly IReadOnlyList<KeyValuePair<string, string>> Parameters;

            internal NewNode(int id, string program, IReadOnlyList<KeyValuePair<string, string>> parameters)
            {
                Id = id;
                Program = program;
                Parameters = parameters;
            }
        }
    }
}
