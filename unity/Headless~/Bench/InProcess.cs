using System.Diagnostics;
using Collektive.Bridge;
using gradientascent;

namespace Collektive.Headless.Bench
{
    /// <summary>The product: C# fills the frame, the JVM runs all rounds in one call, and C# reads the answer in place.</summary>
    internal class InProcess : Variant
    {
        private readonly AllocationProbe probe;
        private double[] rounds = new double[0];
        private long tick;

        internal InProcess(BenchSettings settings, AllocationProbe probe, string name, string variant, int nodes, int threads)
            : base(name, variant, nodes == 0 ? "none" : "a", nodes, threads)
        {
            this.probe = probe;
            World = new GridWorld(nodes);
            Session = Session.Open(
                new SessionSettings { Seed = 1, Threads = threads, Jars = settings.Jars, Program = "gradient-ascent" }, new GradientAscentSchema());
        }

        protected GridWorld World { get; }

        protected Session Session { get; }

        /// <summary>Prevents dead-code elimination of the answers.</summary>
        internal float Sum { get; private set; }

        internal override int CallsPerTick => 1;

        internal override double[] Rounds => rounds;

        internal override long JvmBytes() => probe.Read();

        internal override void Run(int count, double[] times)
        {
            if (tick == 0) Prepare();
            if (rounds.Length < count) rounds = new double[count];
            for (var i = 0; i < count; i++)
            {
                Pause();
                var begin = Stopwatch.GetTimestamp();
                Sum += Tick(++tick);
                times[i] = Measurement.Micros(begin, Stopwatch.GetTimestamp());
                rounds[i] = Session.Answer.RoundMicros;
            }
        }

        public override void Dispose() => Session.Dispose();

        protected virtual void Prepare() => World.AddTo(Session.Request);

        protected virtual void Pause()
        {
        }

        protected virtual float Tick(long number)
        {
            World.Sense(Session.Request, number);
            Session.Step(Measurement.DeltaTime, Measurement.LimitMs);
            return GridWorld.Act(Session.Answer);
        }
    }

    /// <summary>The same with pauses as in a game, during which caches and cores cool down.</summary>
    internal sealed class PacedInProcess : InProcess
    {
        internal PacedInProcess(BenchSettings settings, AllocationProbe probe, int nodes, int threads)
            : base(settings, probe, "tick", "in-process, every 8 ms", nodes, threads)
        {
        }

        internal override bool IsPaced => true;

        protected override void Pause() => Measurement.Pause();
    }

    /// <summary>One call per node through the same shim, as in collektive.unity.</summary>
    internal sealed class PerNodeCall : InProcess
    {
        internal PerNodeCall(BenchSettings settings, AllocationProbe probe, int nodes, int threads)
            : base(settings, probe, "tick", "per-node-call", nodes, threads)
        {
        }

        internal override int CallsPerTick => World.Size;

        protected override float Tick(long number)
        {
            var sum = 0f;
            for (var node = 0; node < World.Size; node++)
            {
                Session.Request.ClearDue();
                Session.Request.Sensors.EnsureCapacity(1);
                World.Sense(Session.Request, node, 0, number);
                Session.Step(Measurement.DeltaTime, Measurement.LimitMs);
                sum += GridWorld.Act(Session.Answer);
            }
            return sum;
        }
    }

    /// <summary>Each tick adds all nodes with their links. All nodes leave again between two ticks.</summary>
    internal sealed class Spawn : InProcess
    {
        internal Spawn(BenchSettings settings, AllocationProbe probe, int nodes, int threads) : base(settings, probe, "spawn", "in-process", nodes, threads)
        {
        }

        /// <summary>Includes the tick in between.</summary>
        internal override int CallsPerTick => 2;

        protected override void Prepare()
        {
        }

        protected override void Pause()
        {
            if (Session.Tick > 0) World.RemoveFrom(Session.Request);
            Session.Request.ClearDue();
            Session.Step(Measurement.DeltaTime, Measurement.LimitMs);
        }

        protected override float Tick(long number)
        {
            World.AddTo(Session.Request);
            Session.Step(Measurement.DeltaTime, Measurement.LimitMs);
            return Session.Answer.EngineNodes;
        }
    }
}
