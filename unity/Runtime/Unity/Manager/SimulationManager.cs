using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Runs the simulation of a scene. In each tick, it runs the sensors, makes one call into the JVM, runs the actuators, and advances physics. While it
    /// is paused, it runs no ticks. Call all members from the main thread.
    ///
    /// One manager serves all loaded scenes, and the nodes of all loaded scenes take part. Nodes join when their scene is loaded, and leave when it is
    /// unloaded. A second manager, for instance in an additive scene, disables itself with an error. The simulation ends when the manager's own scene is
    /// unloaded. The remaining nodes then wait for the next manager and start afresh.
    /// </summary>
    [AddComponentMenu("Collektive/Simulation Manager")]
    [DisallowMultipleComponent]
    [DefaultExecutionOrder(-1000)]
    [HelpPage("way-of-a-tick.md")]
    public sealed class SimulationManager : MonoBehaviour
    {
        /// <summary>Maximum number of ticks per frame. Time that would need more ticks is dropped.</summary>
        private const int MaxTicksPerFrame = 4;

        /// <summary>Tolerance for rounded frame times. For example, ten frames of 0.02 s must run two ticks of 0.1 s.</summary>
        private const double RoundingTolerance = 1 - 1e-6;

        [SerializeField]
        [Tooltip("Settings for the start of the simulation.")]
        private SimulationSettings settings = new SimulationSettings();

        [SerializeField]
        [Tooltip("Stops rounds, physics and simulated time.")]
        private bool paused;

        private readonly SceneGlobals globals = new SceneGlobals();
        private readonly TickHandlers handlers = new TickHandlers();
        private Simulation simulation;
        private SimulationMode modeBefore;
        private double accumulated;
        private bool stepping;

        /// <summary>
        /// A function that is called after each tick and pauses the simulation by returning true. To continue, set <see cref="Paused"/> to false. An
        /// exception counts as an error, and the simulation continues.
        /// </summary>
        public Func<SimulationManager, bool> StopCondition { get; set; }

        /// <summary>Whether the simulation reached its duration or its stop condition.</summary>
        public bool Finished { get; private set; }

        /// <summary>
        /// Raised after each tick, when physics has advanced. An exception in a handler counts as an error, and the simulation continues. A handler that
        /// fails 10 times in a row is removed. Add handlers in <c>OnEnable</c>, because they are lost when scripts are compiled during play.
        /// </summary>
        public event Action<SimulationManager> Ticked
        {
            add => handlers.Add(value);
            remove => handlers.Remove(value);
        }

        /// <summary>Raised for each line of the JVM's log, after the line was written to Unity's log. An exception in a handler is logged.</summary>
        public event Action<HostLogLevel, string> Logged;

        /// <summary>The scene's manager, or null.</summary>
        public static SimulationManager Current { get; private set; }

        /// <summary>Settings for the start of the simulation.</summary>
        public SimulationSettings Settings => settings;

        /// <summary>Whether the simulation is paused.</summary>
        public bool Paused
        {
            get => paused;
            set => paused = value;
        }

        /// <summary>The error that stopped the simulation, or an empty string.</summary>
        public string Failure => Simulation.Failure;

        /// <summary>Random numbers for the scene. They depend only on the seed.</summary>
        public RandomStream Random => Simulation.Random;

        /// <summary>The programs of the session; empty before the first frame.</summary>
        public IReadOnlyList<ProgramInfo> Programs => Simulation.Programs;

        /// <summary>Participating nodes, ascending by id.</summary>
        public IReadOnlyList<Node> Nodes => Simulation.Nodes;

        /// <summary>Number of completed ticks.</summary>
        public ulong Tick => Simulation.Tick;

        /// <summary>Simulated time in seconds.</summary>
        public double SimulatedTime => Simulation.Time;

        /// <summary>
        /// The fraction of the delta time that has passed since the last tick, 0 to 1, for drawing between ticks. While the simulation is paused, the
        /// fraction is 1, so that the state after the last tick is drawn.
        /// </summary>
        public float TickFraction => paused ? 1 : (float)Math.Min(accumulated / settings.deltaTime, 1);

        /// <summary>First 8 bytes of the digest over all rounds so far.</summary>
        public ulong Digest => Simulation.Digest;

        /// <summary>Number of directed links.</summary>
        public int LinkCount => Simulation.PresentLinks.Count;

        /// <summary>Errors of rounds, sensors, actuators, rules and handlers of <see cref="Ticked"/> so far.</summary>
        public long ErrorCount => Simulation.Errors.Count;

        /// <summary>The same errors by node and source.</summary>
        public IReadOnlyList<NodeErrors> Errors => Simulation.Errors.All;

        /// <summary>Duration of the last tick's phases.</summary>
        public TickTimes Times => Simulation.Times;

        /// <summary>Microseconds that the last step took in the JVM, and in rounds.</summary>
        public (int Host, int Rounds) HostMicros => Simulation.HostMicros;

        /// <summary>Message counts of the last tick.</summary>
        public NetworkCounts Network => Simulation.Network;

        /// <summary>The simulation that began when the manager was last enabled. A disabled manager keeps it, so that its errors can still be read.</summary>
        internal Simulation Simulation => simulation ?? (simulation = new Simulation(settings, globals, this));

        /// <summary>
        /// Links two nodes until <see cref="RemoveLink"/>. Node <paramref name="b"/> receives messages from <paramref name="a"/>, and vice versa unless
        /// <paramref name="directed"/> is true. The link keeps the present distance of the nodes as its length. Scripts may call this from any message
        /// method, for instance <c>OnTriggerEnter</c>; the link takes effect at the next tick. If a node is not in the simulation, the call is ignored,
        /// with one warning per node.
        /// </summary>
        public void AddLink(int a, int b, bool directed = false) => Simulation.ScriptLinks.Add(a, b, directed);

        /// <summary>
        /// Removes a link added by <see cref="AddLink"/>. Links of neighbourhood rules are not affected. Links of nodes that left were already removed.
        /// </summary>
        public void RemoveLink(int a, int b, bool directed = false) => Simulation.ScriptLinks.Remove(a, b, directed);

        /// <summary>
        /// Changes the scene's global data, which programs read as <c>device.globals</c> from the next tick on. May be called at any time, also several
        /// times in a tick. When the next tick begins, <paramref name="write"/> is called with the data of earlier calls.
        /// </summary>
        /// <typeparam name="T">The generated draft class of the schema's <c>GlobalData</c>.</typeparam>
        public void SetGlobals<T>(Action<T> write) => globals.Set(write ?? throw new ArgumentNullException(nameof(write)));

        /// <summary>Returns whether <paramref name="to"/> receives messages from <paramref name="from"/>.</summary>
        public bool HasLink(int from, int to) => Simulation.PresentLinks.Has(from, to);

        /// <summary>Replaces the content of <paramref name="target"/> with all directed links.</summary>
        public void CopyLinks(List<LinkRecord> target) => Simulation.PresentLinks.CopyTo(target);

        /// <summary>Returns the node with that id, or null.</summary>
        public Node Find(int id) => Simulation.Find(id);

        /// <summary>
        /// Finds the nodes within <paramref name="radius"/> metres of a point, sorted by id, with their distances. The search uses the positions at the
        /// beginning of this tick, and is up to date while neighbourhood rules run.
        /// </summary>
        public void FindNodes(Vector3 centre, float radius, List<Node> found, List<float> distances) =>
            Simulation.Context.Grid.Copy(Simulation.Context.Grid.Find(centre, radius), found, distances);

        /// <summary>
        /// Finds at most <paramref name="count"/> nodes nearest to a point, sorted by distance and then by id. The search uses the positions at the
        /// beginning of this tick, and is up to date while neighbourhood rules run.
        /// </summary>
        public void FindNearestNodes(Vector3 centre, int count, List<Node> found, List<float> distances)
        {
            Simulation.Context.Grid.Copy(Simulation.Context.Grid.FindNearest(centre, count, 0), found, distances);
        }

        /// <summary>Runs one tick now, even while paused. If a debugger stops the JVM, the tick is completed in a later frame.</summary>
        public void Step()
        {
            if (!isActiveAndEnabled || !Simulation.IsOpen)
            {
                Debug.LogError(Failure.Length > 0 ? "the simulation has stopped: " + Failure
                    : "the simulation has not started: call Step in play mode, from Update or later", this);
                return;
            }
            if (stepping) throw new InvalidOperationException("Step was called during a tick: call it between ticks, for example in Update");
            stepping = true;
            try
            {
                using (TickMarkers.Tick.Auto())
                {
                    if (!Simulation.TryTick()) return;
                    handlers.Run(this);
                    if (Simulation.IsOpen && !Finished && IsAtEnd()) Finish();
                }
            }
            finally
            {
                stepping = false;
            }
        }

        /// <summary>
        /// Loads the programs again before the next tick, for example after their jars were rebuilt. A node keeps its state and messages at each path that
        /// the old and the new program share, unless a value's class is in the jars and cannot be copied by Java serialization. A node whose first round
        /// with the new program fails starts afresh. The outcome is logged. If the new programs are invalid, the nodes continue with the previous ones.
        /// </summary>
        public void ReloadPrograms() => Simulation.ReloadPrograms();

        /// <summary>
        /// Stops the simulation with an error, and disables the manager. The editor and the JVM keep running. Clicking the message selects <paramref
        /// name="context"/>, or the manager if that is null.
        /// </summary>
        public void Fail(string message, UnityEngine.Object context = null) => Simulation.Fail(message, context);

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void ResetStatics() => Current = null;

        private void OnEnable()
        {
            var former = simulation;
            simulation = new Simulation(PlayerArguments.Apply(settings), globals, this);
            if (former != null) simulation.TakeRequests(former);
            if (Current != null && Current != this)
            {
                Debug.LogError("'" + name + "' is a second Simulation Manager; '" + Current.name + "' already runs the simulation. Remove one of them", this);
                enabled = false;
                return;
            }
            Current = this;
            // The end of the previous simulation paused the manager.
            if (Finished) paused = false;
            Finished = false;
            accumulated = 0;
            modeBefore = Physics.simulationMode;
            Physics.simulationMode = SimulationMode.Script;
            BatchPlayer.Begin(settings);
            var waiting = Node.All;
            for (var i = 0; i < waiting.Count && Failure.Length == 0; i++) simulation.Join(waiting[i]);
        }

        private void OnDisable()
        {
            if (Current != this) return;
            Current = null;
            globals.Clear();
            Physics.simulationMode = modeBefore;
            simulation.End();
            simulation.Log?.ShowRest(Logged);
            if (Failure.Length > 0) BatchPlayer.End(settings, false);
        }

        private void Update()
        {
            if (!simulation.IsOpen && !simulation.TryOpen()) return;
            simulation.Log.Show(Logged);
            if (simulation.IsPending) Step();
            if (paused || simulation.IsPending || !simulation.CheckSettings()) return;
            accumulated = Math.Min(accumulated + Time.deltaTime, MaxTicksPerFrame * (double)settings.deltaTime);
            while (accumulated >= settings.deltaTime * RoundingTolerance && isActiveAndEnabled && !paused && !simulation.IsPending)
            {
                accumulated -= settings.deltaTime;
                Step();
            }
        }

        // After a long time, the tolerance would otherwise exceed a tick. Ticks such as 1/30 s are rounded too, so the nearest tick is the last one.
        private double EndTime => Math.Max(settings.stopAfter * RoundingTolerance, SimulatedSeconds.Exact(settings.stopAfter) - 0.5 * settings.deltaTime);

        private bool IsAtEnd() =>
            settings.stopAfter > 0 && SimulatedTime >= EndTime || StopCondition != null && TickHandlers.IsTrue(StopCondition, this);

        private void Finish()
        {
            Finished = true;
            paused = true;
            Debug.Log("The simulation ended after " + SimulatedTime + " s and is paused", this);
            BatchPlayer.End(settings, ErrorCount == 0);
        }
    }
}
