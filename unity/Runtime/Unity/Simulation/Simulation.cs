using System;
using System.Collections.Generic;
using System.Diagnostics;
using Collektive.Bridge;
using UnityEngine;
using Debug = UnityEngine.Debug;

namespace Collektive.Unity
{
    /// <summary>
    /// One simulation with its nodes, links, ticks and errors. It does not need a scene: its owner calls <see cref="TryOpen"/>, then <see cref="TryTick"/>
    /// for each tick, and finally <see cref="End"/>. Call all members from the main thread.
    /// </summary>
    internal sealed class Simulation
    {
        /// <summary>Prefix of the error message that stops a simulation.</summary>
        internal const string StopPrefix = "Simulation stopped: ";

        /// <summary>Tolerance of times as a fraction of the delta time, because sums of delta times are not exact.</summary>
        private const double Tolerance = 1e-3;

        /// <summary>Maximum number of links. No tick could handle more in a reasonable time, and memory would run out soon after.</summary>
        private const int MaxLinks = 1 << 24;

        private const int BatchWaitMs = 1000;
        private const double ReportedStopSeconds = 1;

        private readonly NodeRegistry registry = new NodeRegistry();
        private readonly SceneGlobals globals;
        // The nodes that were present when the tick began. Users' code may add and remove nodes during a tick. Added nodes run from the next tick on, and
        // removed nodes are skipped.
        private Node[] present = Array.Empty<Node>();
        private int presentCount;
        private readonly GrowingArray<(Node Node, int Id)> due = new GrowingArray<(Node Node, int Id)>();
        // Indices in the array of present nodes.
        private readonly GrowingArray<int> withOwnRules = new GrowingArray<int>();
        private Session session;
        private bool isTicking;
        private bool isReloadRequested;
        private readonly HashSet<string> changedPrograms = new HashSet<string>();
        private bool isStopReported;
        private long pendingSince;
        private double retention;
        private (long Start, long QueriesEnd, long RulesEnd, long SenseEnd) timestamps;

        /// <param name="settings">The settings. They are read when the simulation opens, except for times, which are read in each tick.</param>
        /// <param name="globals">The scene's global data, which each tick sends if it changed.</param>
        /// <param name="manager">The manager, which messages select when they are clicked; null without a scene.</param>
        internal Simulation(SimulationSettings settings, SceneGlobals globals, SimulationManager manager)
        {
            Settings = settings;
            Manager = manager;
            this.globals = globals;
            Context = new TickContext(this);
            ScriptLinks = new ScriptLinks(this);
            Seed = settings.seed;
            Random = new RandomStream(Seed, 0, RandomPurpose.Scene);
        }

        internal SimulationSettings Settings { get; }

        internal SimulationManager Manager { get; }

        /// <summary>Seed of all random numbers.</summary>
        internal ulong Seed { get; }

        /// <summary>The schedule of all nodes.</summary>
        internal Schedule Schedule { get; private set; }

        /// <summary>Name of the program of the nodes that do not select one; null before the simulation opens.</summary>
        internal string Program { get; private set; }

        /// <summary>Random numbers for the scene.</summary>
        internal RandomStream Random { get; }

        /// <summary>Whether the session is open.</summary>
        internal bool IsOpen { get; private set; }

        /// <summary>
        /// Whether a debugger stops the JVM during <see cref="TryOpen"/> or <see cref="TryTick"/>. Calling the method again continues the opening or the tick.
        /// </summary>
        internal bool IsPending { get; private set; }

        /// <summary>The error that ended the simulation, or an empty string.</summary>
        internal string Failure { get; private set; } = "";

        internal IReadOnlyList<ProgramInfo> Programs => IsOpen ? session.Programs : Array.Empty<ProgramInfo>();

        /// <summary>Number of completed ticks.</summary>
        internal ulong Tick => IsOpen ? session.Tick : 0;

        /// <summary>The current or last tick.</summary>
        internal ulong TickInProgress { get; private set; }

        /// <summary>Simulated seconds.</summary>
        internal double Time => IsOpen ? session.Time : 0;

        /// <summary>Simulated seconds of the current or last tick. A change of the settings during a tick takes effect in the next one.</summary>
        internal float DeltaTime { get; private set; }

        /// <summary>Longest physics sub-step of the current or last tick, in seconds.</summary>
        internal float PhysicsStep { get; private set; }

        /// <summary>Simulated seconds at the next tick. Until the rounds of a tick have run, this is the tick after it.</summary>
        internal double NextTickTime => TickInProgress > Tick ? Time + SimulatedSeconds.Exact(DeltaTime) : Time;

        /// <summary>First 8 bytes of the digest over all rounds so far.</summary>
        internal ulong Digest { get; private set; }

        /// <summary>Whether the last tick had rounds, and each of them failed.</summary>
        internal bool AllRoundsFailed { get; private set; }

        internal TickTimes Times { get; private set; }

        internal (int Host, int Rounds) HostMicros { get; private set; }

        internal NetworkCounts Network { get; private set; }

        /// <summary>The JVM's log; null before <see cref="TryOpen"/>.</summary>
        internal JvmLog Log { get; private set; }

        internal ErrorCounts Errors { get; } = new ErrorCounts();

        /// <summary>Participating nodes, ascending by id.</summary>
        internal List<Node> Nodes => registry.Nodes;

        /// <summary>A number that is greater than all ids.</summary>
        internal int IdCapacity => registry.IdCapacity;

        /// <summary>Called with each node and its parameters when they are sent to the JVM.</summary>
        internal Action<Node, List<NodeParameter>> NodeJoined
        {
            get => registry.Joined;
            set => registry.Joined = value;
        }

        /// <summary>All links, and searches for near nodes.</summary>
        internal NeighbourSearch Links => Context.Links;

        internal ScriptLinks ScriptLinks { get; }

        /// <summary>All links between participating nodes. <see cref="Links"/> also contains the links of nodes that left, until the next tick.</summary>
        internal NeighbourSearch PresentLinks
        {
            get
            {
                registry.DropLinksOfDeparted(Links);
                return Links;
            }
        }

        /// <summary>The services that parts use during a tick.</summary>
        internal TickContext Context { get; }

        /// <summary>Buffer for sensors in a tick.</summary>
        internal SensorBuffer SensorData => session.Request.Sensors;

        /// <summary>Buffer for actuators in a tick.</summary>
        internal ActuatorBuffer Answered => session.Answer.Actuators;

        /// <summary>The answer of the last tick. Its nodes are sorted by id.</summary>
        internal StepAnswer Answer => session.Answer;

        /// <summary>Whether answers contain the sizes of messages.</summary>
        internal bool MeasuresMessages { get; set; }

        /// <summary>Whether answers contain the metrics of programs.</summary>
        internal bool Measures { get; set; }

        /// <summary>Id of the node that answers describe, or -1.</summary>
        internal int Inspected { get; set; } = -1;

        /// <summary>Makes the requests of the former simulation of the same manager.</summary>
        internal void TakeRequests(Simulation former)
        {
            NodeJoined = former.NodeJoined;
            (MeasuresMessages, Measures, Inspected) = (former.MeasuresMessages, former.Measures, former.Inspected);
        }

        /// <summary>Number of nodes with a round in the last tick.</summary>
        internal int DueCount => due.Count;

        /// <summary>Returns the id of the node whose sensor data is at the given index of <see cref="SensorData"/>.</summary>
        internal int DueId(int index) => due.Items[index].Id;

        /// <summary>Starts the JVM if needed and opens a session, or continues a pending opening.</summary>
        /// <returns>False if the opening is pending or failed. A simulation that failed is not opened again, because each later frame would fail too.</returns>
        internal bool TryOpen()
        {
            try
            {
                Log = Log ?? new JvmLog(Manager);
                if (!IsPending)
                {
                    if (Settings.seed != Seed) throw new BridgeException(BridgeError.Argument, "seed is " + Settings.seed
                        + ", but the Simulation Manager was enabled with seed " + Seed + ": set the seed while the manager is disabled");
                    Schedule = Settings.schedule;
                    Program = Settings.ProgramName;
                    retention = Settings.network.retention;
                    session = SessionStart.Begin(Settings, Manager);
                }
                Finish();
                IsOpen = !IsPending;
            }
            catch (Exception error)
            {
                IsPending = false;
                Fail(error, "the start failed: ");
            }
            return IsOpen;
        }

        /// <summary>Runs one tick, or continues a pending tick.</summary>
        /// <returns>Whether the tick was completed. If not, it is pending, or the simulation has ended.</returns>
        internal bool TryTick()
        {
            isTicking = true;
            try
            {
                DoTick();
            }
            catch (Exception error)
            {
                IsPending = false;
                Fail(error, "tick " + TickInProgress + " failed: ");
            }
            isTicking = false;
            if (!IsOpen) CloseSession();
            return IsOpen && !IsPending;
        }

        /// <summary>
        /// Loads the programs again before the next tick. Nodes keep their state and messages at paths that the old and the new program share.
        /// </summary>
        internal void ReloadPrograms()
        {
            isReloadRequested = true;
        }

        /// <summary>Sets a parameter from the next tick on, for all nodes that run a program and do not set the parameter themselves.</summary>
        internal void SetParameter(string program, string name, string value)
        {
            if (!Settings.ProgramParameters.TryGetValue(program, out var values)) Settings.ProgramParameters.Add(program, values = new List<NodeParameter>());
            values.RemoveAll(parameter => parameter.name == name);
            values.Add(new NodeParameter(name, value));
            changedPrograms.Add(program);
        }

        /// <summary>Ends the simulation if a script has set values with which no tick can run.</summary>
        /// <returns>Whether the values are valid.</returns>
        internal bool CheckSettings()
        {
            var problem = Settings.FindTickProblem();
            if (problem != null) Fail(problem);
            return problem == null;
        }

        /// <summary>Ends the simulation with an error. Clicking the message selects <paramref name="context"/>, or the manager if that is null.</summary>
        internal void Fail(string message, UnityEngine.Object context = null)
        {
            if (Failure.Length > 0) return;
            // An empty text would mean that the simulation continues.
            Failure = string.IsNullOrEmpty(message) ? "a script called Fail without a message" : message;
            Debug.LogError(StopPrefix + Failure, context != null ? context : Manager);
            if (Manager != null) Manager.enabled = false;
            else End();
        }

        /// <summary>
        /// Ends the simulation with an exception. A <see cref="BridgeException"/> has a message for users. Other exceptions are logged with their stack
        /// trace, and <paramref name="what"/> precedes their message.
        /// </summary>
        private void Fail(Exception error, string what)
        {
            var isUserError = error is BridgeException;
            if (!isUserError) Debug.LogException(error, Manager);
            Fail((isUserError ? "" : what) + error.Message);
        }

        /// <summary>Removes all nodes, and closes the session after the current tick. A second call does nothing.</summary>
        internal void End()
        {
            for (var i = Nodes.Count - 1; i >= 0; i--) Remove(Nodes[i]);
            if (IsPending) Debug.LogWarning(PendingCall + " was not completed, because the JVM is stopped in a debugger: continue the program there, "
                + "or detach the debugger, before the next Play", Manager);
            IsPending = false;
            IsOpen = false;
            if (!isTicking) CloseSession();
            Errors.LogCounts();
        }

        internal void Join(Node node)
        {
            var problem = registry.Join(node, this);
            if (problem != null) Fail(problem, node);
        }

        /// <summary>
        /// Changes the id of a node to its requested id before its first tick. Scripts often set it after AddComponent, during which the node joins. Another
        /// node with this id gets a new one if it did not request the id and was not in a tick either.
        /// </summary>
        internal void ChangeId(Node node)
        {
            if (node.RequestedId < 0 || node.RequestedId == node.Id || registry.IsKnown[node.Id]) return;
            var other = Find(node.RequestedId);
            var givesWay = !(other is null) && other.RequestedId < 0 && !registry.IsKnown[other.Id];
            Withdraw(node);
            if (givesWay) Withdraw(other);
            Join(node);
            if (givesWay) Join(other);
        }

        private void Withdraw(Node node)
        {
            var id = node.Id;
            Leave(node);
            registry.FreeLast(id);
        }

        internal void Leave(Node node)
        {
            Errors.Leave(node.Id);
            Remove(node);
        }

        /// <summary>Removes a node at the end of the simulation. Its errors keep their node, for the diagnostics window.</summary>
        private void Remove(Node node)
        {
            registry.Leave(node, Links);
            for (var i = 0; i < node.Rules.Count; i++) ((NeighbourhoodRule)node.Rules[i]).ReleaseAll();
            node.OnLeft();
        }

        internal Node Find(int id) => registry.Find(id);

        private void CloseSession()
        {
            try
            {
                session?.Dispose();
                if (session != null) SessionStart.Close(Settings);
            }
            catch (BridgeException error)
            {
                Debug.LogError("the session could not be closed: " + error.Message, Manager);
            }
            session = null;
            Context.Release();
        }

        /// <summary>Runs the phases of a tick. Users' code may end the simulation in any phase, and the later phases are then skipped.</summary>
        private void DoTick()
        {
            if (!IsPending) Begin();
            if (!IsOpen) return;
            using (TickMarkers.Step.Auto()) Step();
            if (IsPending) return;
            var stepEnd = Stopwatch.GetTimestamp();
            using (TickMarkers.Act.Auto())
            {
                ReadAnswer();
                Act();
            }
            if (!IsOpen) return;
            var actEnd = Stopwatch.GetTimestamp();
            using (TickMarkers.Physics.Auto()) Context.Steps.Advance(this);
            var end = Stopwatch.GetTimestamp();
            Times = TickTimes.Of(timestamps.Start, timestamps.QueriesEnd, timestamps.RulesEnd, timestamps.SenseEnd, stepEnd, actEnd, end);
        }

        private void Begin()
        {
            if (!CheckSettings()) return;
            var isLonger = Settings.deltaTime > DeltaTime;
            (DeltaTime, PhysicsStep) = (Settings.deltaTime, Settings.physicsStep);
            timestamps.Start = Stopwatch.GetTimestamp();
            TickInProgress = session.Tick + 1;
            using (TickMarkers.Queries.Auto())
            {
                Physics.SyncTransforms();
                FlushChanges(isLonger);
                BeginQueries();
            }
            timestamps.QueriesEnd = Stopwatch.GetTimestamp();
            using (TickMarkers.Rules.Auto()) UpdateRules();
            timestamps.RulesEnd = Stopwatch.GetTimestamp();
            using (TickMarkers.Sense.Auto())
            {
                Sense();
                // Users' code may add and remove links up to this point.
                PresentLinks.Flush(session.Request);
            }
            timestamps.SenseEnd = Stopwatch.GetTimestamp();
        }

        /// <summary>Makes the tick's only call into the JVM.</summary>
        private void Step()
        {
            if (!IsPending)
            {
                session.Request.MeasuresMessages = MeasuresMessages;
                session.Request.Measures = Measures;
                session.Request.Inspected = Inspected;
                session.Step(SimulatedSeconds.Exact(DeltaTime), Settings.stepLimitMs);
            }
            Finish();
        }

        /// <summary>Completes the call into the JVM. While a debugger stops the JVM, a batch run waits, but other runs continue to draw frames.</summary>
        private void Finish()
        {
            var isNew = !IsPending;
            var waitMs = Application.isBatchMode ? BatchWaitMs : 0;
            do
            {
                IsPending = !session.TryFinish(waitMs);
            }
            while (IsPending && Application.isBatchMode);
            if (IsPending) ReportStop(isNew);
        }

        /// <summary>Reports that a debugger stops the JVM, but not that a call is slow.</summary>
        private void ReportStop(bool isNew)
        {
            if (isNew)
            {
                pendingSince = Stopwatch.GetTimestamp();
                isStopReported = false;
            }
            if (isStopReported || Stopwatch.GetTimestamp() - pendingSince < ReportedStopSeconds * Stopwatch.Frequency) return;
            isStopReported = true;
            Debug.Log("JVM stopped by the debugger in " + PendingCall + ": continue the program there", Manager);
        }

        private string PendingCall => IsOpen ? "tick " + TickInProgress : "the opening of the session";

        /// <summary>Writes the changes since the last tick to the request: global data, and the nodes that left or joined.</summary>
        /// <param name="isLonger">Whether a script has increased the delta time.</param>
        private void FlushChanges(bool isLonger)
        {
            registry.DropLinksOfDeparted(Links);
            var problem = globals.Flush(session.Request);
            if (problem != null) Fail(problem);
            else if (isLonger) CheckShortTimes();
            for (var i = 0; i < registry.Joining.Count && IsOpen; i++)
            {
                var node = registry.Joining[i];
                if (node is null) continue;
                problem = Settings.FindProblem(node) ?? node.StartTimer();
                if (problem != null) Fail("node " + node.Id + " ('" + node.name + "'): " + problem, node);
            }
            foreach (var program in changedPrograms) registry.ChangeParameters(session.Request, program);
            changedPrograms.Clear();
            registry.Flush(session.Request, Links);
            if (isReloadRequested) session.Request.Reload(Settings.ToSession().Jars);
            isReloadRequested = false;
        }

        /// <summary>Ends the simulation if the delta time exceeds the network's retention or a node's period.</summary>
        private void CheckShortTimes()
        {
            var problem = NetworkModel.FindRetentionProblem(retention, SimulatedSeconds.Exact(DeltaTime));
            if (problem != null) Fail(problem);
            for (var i = 0; i < Nodes.Count && IsOpen; i++)
            {
                problem = Nodes[i].FindTimerProblem();
                if (problem != null) Fail("node " + Nodes[i].Id + " ('" + Nodes[i].name + "'): " + problem, Nodes[i]);
            }
        }

        /// <summary>Simulated time up to which nodes are due in this tick, in seconds.</summary>
        private double Now => session.Time + Tolerance * DeltaTime;

        /// <summary>Reads positions, chooses the due nodes, and starts the physics queries, which run while the rules are called.</summary>
        private void BeginQueries()
        {
            presentCount = Nodes.Count;
            if (presentCount > present.Length) present = new Node[Math.Max(presentCount, 2 * present.Length)];
            Nodes.CopyTo(present);
            Context.Grid.Build(present, presentCount);
            var now = Now;
            due.Clear();
            for (var i = 0; i < presentCount; i++)
            {
                var node = present[i];
                node.KeepAnswer(session.Tick);
                if (node.TakeDue(session.Time, now, DeltaTime)) due.Add((node, node.Id));
            }
            Context.SightLines.Begin();
            Context.Queries.Begin();
        }

        private void UpdateRules()
        {
            AddSearches();
            var searches = Context.Neighbours.Searches;
            var done = Links.Update(new Span<RuleSearch>(searches.Items, 0, searches.Count), Settings.threads, MaxLinks);
            // The links that scripts added may also exceed the limit.
            if (Links.Count > MaxLinks) FailTooManyLinks(present[done == 0 ? 0 : searches.Items[done - 1].Centre]);
            for (var i = 0; i < withOwnRules.Count && IsOpen; i++)
            {
                var node = present[withOwnRules.Items[i]];
                node.Rules.Run(this, node, -1);
                if (Links.Count > MaxLinks) FailTooManyLinks(node);
            }
        }

        /// <summary>Collects the searches of ready-made rules, and the nodes whose rules must be called.</summary>
        private void AddSearches()
        {
            Context.Neighbours.Searches.Clear();
            withOwnRules.Clear();
            for (var i = 0; i < presentCount; i++)
            {
                ref var rules = ref present[i].Rules;
                var areSearches = true;
                for (var r = 0; r < rules.Count; r++)
                {
                    var rule = (NeighbourhoodRule)rules[r];
                    if (rule.MustSearch) rule.AddSearch(Context, i);
                    else areSearches = false;
                }
                if (!areSearches) withOwnRules.Add(i);
            }
        }

        private void FailTooManyLinks(Node node) =>
            Fail("the scene has more than " + MaxLinks + " links; node '" + node.name
                + "' exceeded the limit: use smaller neighbourhoods, or increase the distances between nodes", node);

        /// <summary>Runs the sensors of due nodes. Nodes that leave, and nodes with a sensor that fails, are no longer due.</summary>
        private void Sense()
        {
            var request = session.Request;
            request.ClearDue();
            request.Sensors.EnsureCapacity(due.Count);
            Context.Queries.Finish();
            var sensed = 0;
            for (var i = 0; i < due.Count && IsOpen; i++)
            {
                var (node, id) = due.Items[i];
                // Users' code may have removed the node, or removed and added it again.
                if (!node.IsInTick) continue;
                request.Sensors.Clear(sensed);
                if (!node.Sensors.Run(this, node, sensed) || !node.IsInTick) continue;
                request.AddDue(id);
                var field = request.Sensors.FindNotFinite(sensed);
                due.Items[sensed++] = (node, id);
                if (field == null) continue;
                Fail("sensor data of node " + node.Id + " ('" + node.name + "') contains a number that is not finite in " + field
                    + ": fix the sensor that writes it", node);
            }
            due.Truncate(sensed);
        }

        private void ReadAnswer()
        {
            var answer = session.Answer;
            Digest = answer.Digest;
            Network = answer.Network;
            HostMicros = (answer.HostMicros, answer.RoundMicros);
            if (answer.HasReload) LogReload(answer.Reload);
            for (var i = 0; i < answer.ErrorCount; i++)
            {
                var (id, program, message) = answer.Error(i);
                Errors.AddRound(Find(id), id, program, answer.Tick, message);
            }
        }

        private void LogReload(ReloadOutcome reload)
        {
            if (reload.Error.Length == 0)
                Debug.Log("programs reloaded in tick " + TickInProgress + ": kept " + reload.Kept + " of " + reload.Stored + " stored values", Manager);
            else Debug.LogError("programs not reloaded, the previous ones continue: " + reload.Error, Manager);
        }

        private void Act()
        {
            // Answers and due nodes are both sorted by id. A due node without an answer failed.
            var answer = session.Answer;
            var answeredIds = answer.Nodes;
            var count = answeredIds.Length;
            var allAnswered = count == due.Count;
            AllRoundsFailed = count == 0 && !allAnswered;
            for (int i = 0, place = 0; i < count && IsOpen; i++, place++)
            {
                if (!allAnswered)
                {
                    while (due.Items[place].Id != answeredIds[i]) place++;
                }
                var node = due.Items[place].Node;
                // An earlier actuator may have removed the node, or removed and added it again.
                if (!node.IsInTick) continue;
                node.SetAnswer(answer.Actuators, i, TickInProgress, session.Time);
                node.Actuators.Run(this, node, i);
            }
        }
    }
}
