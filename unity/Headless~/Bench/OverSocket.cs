using System.Diagnostics;
using Collektive.Bridge;
using gradientascent;
using Collektive.FlatBuffers;

namespace Collektive.Headless.Bench
{
    /// <summary>Sends the same frames to a second process over TCP on loopback, with TCP_NODELAY, and with one write and one read per tick.</summary>
    internal sealed class OverSocket : Variant
    {
        private readonly Peer peer;
        private readonly bool paced;
        private readonly int id;
        private readonly GridWorld world;
        private readonly StepRequest request;
        private readonly StepAnswer answer;
        private readonly FlatBufferBuilder builder = new FlatBufferBuilder(1 << 16);
        private ulong tick;

        internal OverSocket(BenchSettings settings, Peer peer, int nodes, int threads, bool paced)
            : base("tick", paced ? "socket, every 8 ms" : "socket", "a", nodes, threads)
        {
            this.peer = peer;
            this.paced = paced;
            id = peer.NewId();
            world = new GridWorld(nodes);
            var schema = new GradientAscentSchema();
            request = new StepRequest(schema.CreateSensors(), null);
            answer = new StepAnswer(schema.CreateActuators());
            var open = new SessionSettings { Seed = 1, Threads = threads, Jars = settings.Jars, Program = "gradient-ascent" };
            open.Write(builder, schema);
            peer.Call(PeerRequest.Open, id, builder);
        }

        /// <summary>Prevents dead-code elimination of the answers.</summary>
        internal float Sum { get; private set; }

        internal override bool IsPaced => paced;

        internal override long JvmBytes()
        {
            peer.Call(PeerRequest.Report, 0);
            return peer.Number(0);
        }

        internal override void Run(int count, double[] times)
        {
            if (tick == 0) world.AddTo(request);
            for (var i = 0; i < count; i++)
            {
                if (paced) Measurement.Pause();
                var begin = Stopwatch.GetTimestamp();
                Sum += Tick();
                times[i] = Measurement.Micros(begin, Stopwatch.GetTimestamp());
            }
        }

        public override void Dispose() => peer.Call(PeerRequest.Close, id);

        private float Tick()
        {
            tick++;
            world.Sense(request, (long)tick);
            builder.Clear();
            request.Write(builder, tick, tick * Measurement.DeltaTime, Measurement.DeltaTime);
            peer.Call(PeerRequest.Step, id, builder);
            request.Clear();
            answer.Read(peer.Answer);
            return GridWorld.Act(answer);
        }
    }

    /// <summary>Ticks that run entirely in the second process: rounds without the boundary, or plain loops.</summary>
    internal sealed class OnJvm : Variant
    {
        private readonly Peer peer;
        private readonly PeerRequest kind;
        private readonly int id;
        private bool isOpen;

        private OnJvm(Peer peer, string variant, PeerRequest kind, int nodes, int threads) : base("tick", variant, "a", nodes, threads)
        {
            this.peer = peer;
            this.kind = kind;
            id = peer.NewId();
        }

        internal override bool IsManaged => false;

        internal static OnJvm Engine(Peer peer, int nodes, int threads) => new OnJvm(peer, "engine-only", PeerRequest.Engine, nodes, threads);

        internal static OnJvm Loops(Peer peer, int nodes) => new OnJvm(peer, "hand-written", PeerRequest.Loops, nodes, 1);

        internal override long JvmBytes()
        {
            peer.Call(PeerRequest.Report, 0);
            return peer.Number(0);
        }

        internal override void Run(int count, double[] times)
        {
            if (!isOpen) peer.Call(kind, id, Row.Nodes, Row.Threads);
            isOpen = true;
            peer.Call(PeerRequest.Run, id, count);
            for (var i = 0; i < count; i++) times[i] = peer.Number(i) / 1000.0;
        }

        public override void Dispose() => peer.Call(PeerRequest.Close, id);
    }
}
