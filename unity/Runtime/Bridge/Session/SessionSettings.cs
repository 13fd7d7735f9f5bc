using System.Collections.Generic;
using Collektive.FlatBuffers;
using Frame = org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>Settings of a session.</summary>
    internal sealed class SessionSettings
    {
        /// <summary>Version of <c>frame.fbs</c>, which must be the same in C# and on the JVM.</summary>
        private const uint Protocol = 1;

        /// <summary>Seed of all random numbers.</summary>
        public ulong Seed { get; set; }

        /// <summary>Number of JVM threads that run rounds, 1..256. It does not affect results.</summary>
        public int Threads { get; set; } = 1;

        /// <summary>Order of rounds, and the messages that a round receives.</summary>
        public Schedule Schedule { get; set; }

        /// <summary>Loss and delay of messages.</summary>
        public NetworkModel Network { get; set; } = new NetworkModel();

        /// <summary>Paths of the jars with programs; read into memory when the session opens, and then closed.</summary>
        public IReadOnlyList<string> Jars { get; set; } = new string[0];

        /// <summary>Program of the nodes that do not select one.</summary>
        public string Program { get; set; } = "";

        /// <summary>
        /// Path of the file in which all frames are recorded, for <c>./collektive replay</c>. An existing file is overwritten. Empty: no record.
        /// </summary>
        public string Record { get; set; } = "";

        /// <summary>Runtime of the programs.</summary>
        public AggregateRuntime Runtime { get; set; }

        /// <summary>Folder of the jars of <see cref="AggregateRuntime.Collektive"/>.</summary>
        public string RuntimeJars { get; set; } = "";

        /// <summary>Names of the metrics of programs that <see cref="StepRequest.Measures"/> requests.</summary>
        public IReadOnlyList<string> Metrics { get; set; } = new string[0];

        /// <summary>Time limit for opening and closing the session, in milliseconds.</summary>
        public int OpenLimitMs { get; set; } = 30000;

        /// <summary>Writes the request that opens a session.</summary>
        internal void Write(FlatBufferBuilder builder, DataSchema schema)
        {
            builder.Clear();
            var types = schema.Types;
            var jars = new StringOffset[Jars.Count];
            for (var i = 0; i < jars.Length; i++) jars[i] = builder.CreateString(Jars[i]);
            var fingerprints = new Offset<Frame.TypeFingerprint>[types.Count];
            for (var i = 0; i < fingerprints.Length; i++)
            {
                fingerprints[i] = Frame.TypeFingerprint.CreateTypeFingerprint(
                    builder, builder.CreateString(types[i].Key), types[i].Value);
            }
            var metrics = new StringOffset[Metrics.Count];
            for (var i = 0; i < metrics.Length; i++) metrics[i] = builder.CreateString(Metrics[i]);
            builder.Finish(Frame.OpenRequest.CreateOpenRequest(
                builder, Protocol, Seed, Threads, (Frame.Schedule)Schedule,
                Frame.OpenRequest.CreateJarsVector(builder, jars), builder.CreateString(schema.Name),
                Frame.OpenRequest.CreateTypesVector(builder, fingerprints),
                builder.CreateString(Program ?? ""),
                Frame.Network.CreateNetwork(
                    builder, Network.loss, Network.lossPerMetre, Network.lossPerAttenuation, Network.delay, Network.jitter, Network.retention,
                    Network.burstShare, Network.burstLength, Network.burstLoss),
                builder.CreateString(Record ?? ""),
                (Frame.AggregateRuntime)Runtime, builder.CreateString(RuntimeJars ?? ""),
                Frame.OpenRequest.CreateMetricsVector(builder, metrics)).Value);
        }
    }
}
