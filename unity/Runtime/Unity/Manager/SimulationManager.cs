using System;
using System.Collections.Generic;
using System.Diagnostics;
using Collektive.Bridge;
using UnityEngine;
using Debug = UnityEngine.Debug;

namespace Collektive.Unity
{
    /// <summary>
    /// Runs the simulation of a scene: decides that a tick is due, has the nodes sense, makes the one call into the JVM, has the nodes
    /// act, and advances physics. While it is paused there is no call, no physics and no time. All members are for the main thread.
    ///
    /// There is one for all loaded scenes; a second one, in an additive scene for instance, disables itself with an error. Nodes of all loaded
    /// scenes take part: those of a scene that is loaded later join, those of one that is unloaded leave. With the manager's own scene the
    /// simulation ends; nodes that outlive it wait for the next manager and start afresh with it.
    /// </summary>
    [AddComponentMenu("Collektive/Simulation Manager")]
    [DisallowMultipleComponent]
    [DefaultExecutionOrder(-1000)]
    public sealed class SimulationManager : MonoBehaviour
    {
        /// <summary>A frame that took long makes at most this many ticks; the rest of its time is dropped.</summary>
        private const int MaxTicksPerFrame = 4;

        /// <summary>Frame times are floats: ten of 0.02 s make two ticks of 0.1 s, not one.</summary>
        private const double Almost = 1 - 1e-6;

        /// <summary>Share of a tick by which times may differ and still be the same: sums of ticks are not exact.</summary>
        private const double Tolerance = 1e-3;

        /// <summary>Ids index arrays.</summary>
        private const int MaxId = (1 << 24) - 1;

        /// <summary>More links than any tick could handle; their memory would be the next limit.</summary>
        private const int MaxLinks = 1 << 24;

        [SerializeField]
        [Tooltip("What the simulation is started with.")]
        private SimulationSettings settings = new SimulationSettings();

        [SerializeField]
        [Tooltip("On: no rounds, no physics, no simulated time.")]
        private bool paused;

        private readonly List<Node> nodes = new List<Node>();
        private readonly List<Node> joining = new List<Node>();
        private readonly GrowingArray<int> leaving = new GrowingArray<int>();
        private readonly List<Node> roster = new List<Node>();
        private readonly List<Node> due = new List<Node>();
        private readonly GrowingArray<int> dueIds = new GrowingArray<int>();
        private readonly ErrorTally errors = new ErrorTally();
        private readonly SceneGlobals globals = new SceneGlobals();
        private readonly RepeatedErrors roundErrors = new RepeatedErrors();
        // By node id: whether the JVM knows the node, and whether it left since the last tick.
        private bool[] isKnown = new bool[64];
        private bool[] isGone = new bool[64];
        private bool anyGone;
        private Session session;
        private HostLog hostLog;
        private SimulationMode modeBefore;
        private double accumulated;
        private int nextId;
        private bool stepping;
        private ulong tickInProgress;

        /// <summary>
        /// Asked after each tick: whether the simulation has reached its end. It is paused then, with everything as it is; to go on, set
        /// <see cref="Paused"/> to false.
        /// </summary>
        public Func<SimulationManager, bool> StopCondition { get; set; }

        /// <summary>Whether the simulation has reached its end: its time, or its stop condition.</summary>
        public bool Finished { get; private set; }

        /// <summary>Called after each tick, when physics have advanced.</summary>
        public event Action<SimulationManager> Ticked;

        /// <summary>Called for each line of the JVM's log, after it was written to Unity's.</summary>
        public event Action<HostLogLevel, string> Logged;

        /// <summary>The scene's manager; null when there is none.</summary>
        public static SimulationManager Current { get; private set; }

        /// <summary>What the simulation is started with.</summary>
        public SimulationSettings Settings => settings;

        /// <summary>Whether the simulation stands still.</summary>
        public bool Paused
        {
            get => paused;
            set => paused = value;
        }

        /// <summary>Why the simulation stopped; empty while it did not.</summary>
        public string Failure { get; private set; } = "";

        /// <summary>Random numbers of the scene as a whole, from the seed alone.</summary>
        public RandomStream Random { get; private set; }

        /// <summary>The programs of the session; empty before the first frame.</summary>
        public IReadOnlyList<ProgramInfo> Programs => session == null ? Array.Empty<ProgramInfo>() : session.Programs;

        /// <summary>Nodes that take part, ascending by id.</summary>
        public IReadOnlyList<Node> Nodes => nodes;

        /// <summary>Ticks done.</summary>
        public ulong Tick => session == null ? 0 : session.Tick;

        /// <summary>Simulated seconds.</summary>
        public double SimulatedTime => session == null ? 0 : session.Time;

        /// <summary>First 8 bytes of the digest over all rounds so far.</summary>
        public ulong Digest { get; private set; }

        /// <summary>Directed links.</summary>
        public int LinkCount => PresentLinks.Count;

        /// <summary>Errors of rounds, sensors, actuators and rules so far.</summary>
        public long ErrorCount => errors.Count;

        /// <summary>The same errors, by where they come from.</summary>
        public IReadOnlyList<NodeErrors> Errors => errors.All;

        /// <summary>Duration of the last tick's phases.</summary>
        public TickTimes Times { get; private set; }

        /// <summary>Microseconds of the last step that the JVM spent, and of these in rounds.</summary>
        public (int Host, int Rounds) HostMicros { get; private set; }

        /// <summary>What the network did in the last tick.</summary>
        public NetworkCounts Network { get; private set; }

        /// <summary>All ids are below it.</summary>
        internal int IdCapacity => isKnown.Length;

        internal LinkTable Links { get; } = new LinkTable();

        /// <summary>The links between nodes that take part, with their values; otherwise they are brought up to date at the next tick, all at once.</summary>
        internal LinkTable PresentLinks
        {
            get
            {
                if (anyGone) DropLinksOfGone();
                Links.Settle();
                return Links;
            }
        }

        /// <summary>Where the nodes are at this tick; up to date while rules are asked.</summary>
        internal NodeGrid Grid { get; } = new NodeGrid();

        /// <summary>
        /// Links two nodes until <see cref="RemoveLink"/>: <paramref name="b"/> hears <paramref name="a"/>, and unless it is
        /// <paramref name="directed"/> also the other way round. The length is the distance now. May be called from any script's
        /// message method, <c>OnTriggerEnter</c> for instance; it takes effect at the next tick.
        /// </summary>
        public void AddLink(int a, int b, bool directed = false)
        {
            if (!CheckEnds("add", a, b)) return;
            var length = Vector3.Distance(Find(a).Body.position, Find(b).Body.position);
            Links.HoldForScripts(a, b, length, 0);
            if (!directed) Links.HoldForScripts(b, a, length, 0);
        }

        /// <summary>Removes what <see cref="AddLink"/> made; links of neighbourhood rules stay.</summary>
        public void RemoveLink(int a, int b, bool directed = false)
        {
            if (!CheckEnds("remove", a, b)) return;
            var removed = Links.ReleaseForScripts(a, b);
            if (!directed) removed |= Links.ReleaseForScripts(b, a);
            if (!removed) Debug.LogWarning("no script made a link from node " + a + " to node " + b + ": nothing to remove", this);
        }

        /// <summary>
        /// Writes the scene's global data, which programs see as <c>device.globals</c> from the next tick on. May be called at any time, and
        /// several times in a tick; <paramref name="write"/> runs when the next tick begins, and finds what was written before.
        /// </summary>
        /// <typeparam name="T">The draft that generated code has for the schema's <c>GlobalData</c>.</typeparam>
        public void SetGlobals<T>(Action<T> write) => globals.Set(write ?? throw new ArgumentNullException(nameof(write)));

        /// <summary>Whether <paramref name="to"/> hears <paramref name="from"/>.</summary>
        public bool HasLink(int from, int to) => PresentLinks.Contains(from, to);

        /// <summary>Copies all directed links to <paramref name="target"/>, emptied first.</summary>
        public void CopyLinks(List<LinkRecord> target)
        {
            target.Clear();
            var links = PresentLinks;
            for (var i = 0; i < links.Capacity; i++)
            {
                if (links.TryGet(i, out var link)) target.Add(link);
            }
        }

        /// <summary>The node of that id, or null.</summary>
        public Node Find(int id)
        {
            var index = IndexOf(id);
            return index < 0 ? null : nodes[index];
        }

        /// <summary>
        /// The nodes within <paramref name="radius"/> metres of a point at the beginning of this tick, with their distances, in no order.
        /// For neighbourhood rules: it is up to date while they are asked.
        /// </summary>
        public void FindNodes(Vector3 centre, float radius, List<Node> found, List<float> distances)
        {
            Copy(Grid.Find(centre, radius), found, distances);
        }

        /// <summary>
        /// The <paramref name="count"/> nodes nearest to a point at the beginning of this tick, or all if there are fewer, the nearest first and
        /// by id at equal distances. For neighbourhood rules: it is up to date while they are asked.
        /// </summary>
        public void FindNearestNodes(Vector3 centre, int count, List<Node> found, List<float> distances)
        {
            Copy(count < 1 ? default : Grid.FindNearest(centre, count, Grid.MeanRadius), found, distances);
        }

        /// <summary>Does one tick now, paused or not.</summary>
        public void Step()
        {
            if (!isActiveAndEnabled || session == null)
            {
                Debug.LogError(
                    Failure.Length > 0 ? "the simulation has stopped: " + Failure : "the simulation has not started: step it from Update on, in play mode",
                        this);
                return;
            }
            if (stepping) throw new InvalidOperationException("Step was called from within a tick");
            stepping = true;
            try
            {
                using (TickMarkers.Tick.Auto())
                {
                    if (!TryTick()) return;
                    Ticked?.Invoke(this);
                    if (session != null && !Finished && IsAtEnd()) Finish();
                }
            }
            finally
            {
                stepping = false;
            }
        }

        /// <summary>
        /// Stops the simulation with an error and disables the manager. The editor and the JVM go on. A click on the message selects
        /// <paramref name="culprit"/>, or the manager if there is none.
        /// </summary>
        public void Fail(string message, UnityEngine.Object culprit = null)
        {
            if (Failure.Length > 0) return;
            Failure = message;
            Debug.LogError("Simulation stopped: " + message, culprit != null ? culprit : this);
            enabled = false;
        }

        internal void Join(Node node)
        {
            var id = node.RequestedId >= 0 ? node.RequestedId : nextId;
            if (id > MaxId)
            {
                Fail("node '" + node.name + "' wants id " + id + ": the largest id is " + MaxId, node);
                return;
            }
            var place = ~IndexOf(id);
            if (place < 0)
            {
                Fail("node '" + node.name + "' wants id " + id + ", which node '" + nodes[~place].name + "' has: give each node its own id, or -1", node);
                return;
            }
            nextId = Math.Max(nextId, id + 1);
            if (id >= isKnown.Length)
            {
                Array.Resize(ref isKnown, Math.Max(id + 1, isKnown.Length * 2));
                Array.Resize(ref isGone, isKnown.Length);
            }
            if (isGone[id]) DropLinksOfGone();
            node.Joined(id, settings.seed);
            nodes.Insert(place, node);
            joining.Add(node);
        }

        internal void Leave(Node node)
        {
            var index = IndexOf(node.Id);
            if (index < 0 || !ReferenceEquals(nodes[index], node)) return;
            nodes.RemoveAt(index);
            if (isKnown[node.Id]) leaving.Add(node.Id);
            else joining.Remove(node);
            isKnown[node.Id] = false;
            isGone[node.Id] = true;
            anyGone = true;
            for (var i = 0; i < node.Rules.Count; i++) node.Rules[i].ReleaseAll(Links);
            node.Left();
        }

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void ResetStatics()
        {
            Current = null;
        }

        private void OnEnable()
        {
            if (Current != null && Current != this)
            {
                Failure = "a second Simulation Manager";
                Debug.LogError(
                    "'" + name + "' is a second Simulation Manager; '" + Current.name + "' runs the simulation. Remove one of them", this);
                enabled = false;
                return;
            }
            Current = this;
            Failure = "";
            errors.Clear();
            Finished = false;
            Digest = 0;
            Network = default;
            Times = default;
            HostMicros = default;
            accumulated = 0;
            nextId = 0;
            Random = new RandomStream(settings.seed, 0, RandomPurpose.Scene);
            modeBefore = Physics.simulationMode;
            Physics.simulationMode = SimulationMode.Script;
            for (var i = 0; i < Node.All.Count && Failure.Length == 0; i++) Join(Node.All[i]);
        }

        private void OnDisable()
        {
            if (Current != this) return;
            for (var i = nodes.Count - 1; i >= 0; i--) Leave(nodes[i]);
            // The session takes its nodes and links with it: the next one knows none of them.
            leaving.Clear();
            DropLinksOfGone();
            globals.Clear();
            Current = null;
            Physics.simulationMode = modeBefore;
            CloseSession();
            roundErrors.TellCounts();
            DrainLog();
            if (hostLog != null && hostLog.TryCount(out var level, out var line)) Show(level, line);
        }

        private void Update()
        {
            if (session == null && !TryOpen()) return;
            DrainLog();
            if (paused) return;
            accumulated = Math.Min(accumulated + Time.deltaTime, MaxTicksPerFrame * (double)settings.deltaTime);
            while (accumulated >= settings.deltaTime * Almost && isActiveAndEnabled && !paused)
            {
                accumulated -= settings.deltaTime;
                Step();
            }
        }

        private bool TryOpen()
        {
            try
            {
                var problem = settings.FindProblem();
                if (problem != null) throw new BridgeException(BridgeError.Argument, problem);
                hostLog = hostLog ?? new HostLog();
                var schema = Schemas.Find(settings.schema);
                StartJvm();
                session = Session.Open(SettingsOfSession(), schema);
                return true;
            }
            catch (BridgeException error)
            {
                Fail(error.Message);
                return false;
            }
            catch (Exception error)
            {
                // The next frame would meet it again, and so on without a tick.
                Debug.LogException(error, this);
                Fail("it could not be started: " + error.Message);
                return false;
            }
        }

        private void StartJvm()
        {
            try
            {
                var launch = Installation.ToLaunch(settings.jvm == null ? new JvmSettings() : settings.jvm.settings);
                if (launch.Note.Length > 0) Debug.Log(launch.Note, this);
                Jvm.Start(launch);
            }
            catch (BridgeException error) when (error.Error == BridgeError.JvmRunning)
            {
                Debug.LogWarning(error.Message + " The running JVM is used; the new settings take effect after a restart of the editor.", this);
            }
        }

        private SessionSettings SettingsOfSession()
        {
            var jars = new string[settings.jars.Count];
            for (var i = 0; i < jars.Length; i++) jars[i] = Installation.PathOf(settings.jars[i]);
            return new SessionSettings
            {
                Seed = settings.seed,
                Threads = settings.threads,
                Schedule = settings.schedule,
                Network = settings.network,
                Jars = jars,
                Program = settings.program,
                Record = string.IsNullOrWhiteSpace(settings.record) ? "" : Installation.PathOf(settings.record),
            };
        }

        private void CloseSession()
        {
            if (session == null) return;
            var closing = session;
            session = null;
            try
            {
                closing.Dispose();
            }
            catch (BridgeException error)
            {
                Debug.LogError("the session did not close: " + error.Message, this);
            }
        }

        /// <summary>Whether there was a whole tick; otherwise the simulation has stopped.</summary>
        private bool TryTick()
        {
            try
            {
                DoTick();
            }
            catch (BridgeException error)
            {
                Fail(error.Message);
            }
            catch (Exception error)
            {
                Debug.LogException(error, this);
                Fail("tick " + tickInProgress + " failed: " + error.Message);
            }
            return session != null;
        }

        private void DoTick()
        {
            var start = Stopwatch.GetTimestamp();
            tickInProgress = session.Tick + 1;
            using (TickMarkers.Sense.Auto()) PrepareRequest();
            if (session == null) return;
            var sensed = Stopwatch.GetTimestamp();
            using (TickMarkers.Step.Auto()) session.Step(settings.deltaTime, settings.stepLimitMs);
            var stepped = Stopwatch.GetTimestamp();
            using (TickMarkers.Act.Auto()) ActAll();
            if (session == null) return;
            var acted = Stopwatch.GetTimestamp();
            using (TickMarkers.Physics.Auto()) Simulate();
            if (session == null) return;
            var end = Stopwatch.GetTimestamp();
            Times = new TickTimes(Milliseconds(start, sensed), Milliseconds(sensed, stepped), Milliseconds(stepped, acted), Milliseconds(acted, end));
        }

        private void PrepareRequest()
        {
            Physics.SyncTransforms();
            FlushChanges();
            if (session == null) return;
            SenseAll();
            if (session == null) return;
            // Last, since users' code may add and remove links until here.
            Links.Flush(session.Request, isKnown);
        }

        private bool IsAtEnd() =>
            settings.stopAfter > 0 && session.Time >= settings.stopAfter * Almost || StopCondition != null && StopCondition(this);

        private void Finish()
        {
            Finished = true;
            paused = true;
            Debug.Log("The simulation has reached its end after " + session.Time + " s and is paused", this);
        }

        private void FlushChanges()
        {
            if (leaving.Count > 0)
            {
                for (var i = 0; i < leaving.Count; i++) session.Request.RemoveNode(leaving.Items[i]);
                leaving.Clear();
            }
            if (anyGone) DropLinksOfGone();
            var problem = globals.Flush(session.Request);
            if (problem != null)
            {
                Fail(problem);
                return;
            }
            for (var i = 0; i < joining.Count; i++)
            {
                var node = joining[i];
                problem = node.StartTimer(settings, session.Time);
                if (problem != null)
                {
                    Fail("node " + node.Id + " ('" + node.name + "'): " + problem, node);
                    return;
                }
                session.Request.AddNode(node.Id, node.Program, ParametersOf(node));
                isKnown[node.Id] = true;
            }
            if (joining.Count > 0) WarnOfOnePlace();
            joining.Clear();
            // Users' code may make nodes join and leave from here on; this tick is for those of the roster that stay.
            roster.Clear();
            roster.AddRange(nodes);
            Grid.Build(roster, Grid.MeanRadius);
            for (var i = 0; i < roster.Count && session != null; i++)
            {
                if (roster[i].Id >= 0) UpdateRules(roster[i]);
            }
        }

        private void Copy(Span<NodeGrid.Hit> hits, List<Node> found, List<float> distances)
        {
            found.Clear();
            distances.Clear();
            for (var i = 0; i < hits.Length; i++)
            {
                found.Add(Grid.NodeAt(hits[i]));
                distances.Add(hits[i].Distance);
            }
        }

        /// <summary>All nodes at one point is a scene that was not finished, and every radius makes all of them neighbours.</summary>
        private void WarnOfOnePlace()
        {
            if (nodes.Count < 2) return;
            var place = nodes[0].Body.position;
            for (var i = 1; i < nodes.Count; i++)
            {
                if (nodes[i].Body.position != place) return;
            }
            Debug.LogWarning("all " + nodes.Count + " nodes are at one point, " + place + ": place them apart", nodes[0]);
        }

        private void DropLinksOfGone()
        {
            Links.DropLinksOf(isGone);
            Array.Clear(isGone, 0, isGone.Length);
            anyGone = false;
        }

        private static KeyValuePair<string, string>[] ParametersOf(Node node)
        {
            var parameters = new KeyValuePair<string, string>[node.Parameters.Count];
            for (var i = 0; i < parameters.Length; i++)
            {
                parameters[i] = new KeyValuePair<string, string>(node.Parameters[i].name, node.Parameters[i].value);
            }
            return parameters;
        }

        private void UpdateRules(Node node)
        {
            ref var rules = ref node.Rules;
            var i = 0;
            for (var left = rules.Count; left > 0 && i < rules.Count; left--)
            {
                var rule = rules[i];
                try
                {
                    rule.UpdateLinks(this);
                    rule.Succeeded();
                }
                catch (Exception error)
                {
                    Report(node, rule, error);
                }
                if (rules.Has(i, rule)) i++;
            }
            if (Links.Count > MaxLinks)
            {
                Fail("there are more than " + MaxLinks + " links, the last of them of node '" + node.name
                    + "': use smaller neighbourhoods, or place the nodes apart", node);
            }
        }

        private void SenseAll()
        {
            due.Clear();
            dueIds.Clear();
            var request = session.Request;
            request.ClearDue();
            request.Sensors.EnsureCapacity(roster.Count);
            var now = session.Time + Tolerance * settings.deltaTime;
            for (var i = 0; i < roster.Count && session != null; i++)
            {
                var node = roster[i];
                if (node.Id < 0) continue;
                node.KeepAnswer(session.Tick);
                if (!node.TakeDue(now)) continue;
                var index = dueIds.Count;
                request.Sensors.Clear(index);
                if (!Sense(node, request.Sensors, index) || node.Id < 0) continue;
                var field = request.Sensors.FindNotFinite(index);
                if (field != null)
                {
                    Fail("sensor data of node " + node.Id + " ('" + node.name + "') holds a number that is not finite in " + field
                        + ": correct the sensor that writes it", node);
                    return;
                }
                request.AddDue(node.Id);
                due.Add(node);
                dueIds.Add(node.Id);
            }
        }

        private bool Sense(Node node, SensorBuffer buffer, int index)
        {
            ref var sensors = ref node.Sensors;
            var type = buffer.DataType;
            var i = 0;
            for (var left = sensors.Count; left > 0 && i < sensors.Count; left--)
            {
                var sensor = sensors[i];
                if (!ReferenceEquals(sensor.DataType, type))
                {
                    Fail(Mismatch("sensor", sensor.GetType(), node, sensor.DataType, type), sensor);
                    return false;
                }
                try
                {
                    sensor.Sense(buffer, index);
                    sensor.Succeeded();
                }
                catch (Exception error)
                {
                    Report(node, sensor, error);
                    return false;
                }
                if (sensors.Has(i, sensor)) i++;
            }
            return true;
        }

        private void ActAll()
        {
            var answer = session.Answer;
            Digest = answer.Digest;
            Network = answer.Network;
            HostMicros = (answer.HostMicros, answer.RoundMicros);
            for (var i = 0; i < answer.ErrorCount; i++)
            {
                var (id, program, message) = answer.Error(i);
                var node = Find(id);
                if (node != null) node.LastError = message;
                errors.Add(program, id, answer.Tick, message);
                roundErrors.Report(id, program, answer.Tick, message, node);
            }
            // Answers and due nodes are both ascending; due nodes without an answer failed.
            var count = answer.NodeCount;
            var allAnswered = count == dueIds.Count;
            var place = 0;
            for (var i = 0; session != null && i < count; i++)
            {
                var id = allAnswered ? dueIds.Items[i] : answer.Node(i);
                while (dueIds.Items[place] != id) place++;
                // Not so when an actuator made the node leave, even if it came back.
                if (due[place].Id == id && isKnown[id]) Act(due[place], answer.Actuators, i);
            }
        }

        private void Act(Node node, ActuatorBuffer buffer, int index)
        {
            node.Answered(buffer, index, tickInProgress, session.Time, settings.deltaTime);
            ref var actuators = ref node.Actuators;
            var type = buffer.DataType;
            var i = 0;
            for (var left = actuators.Count; left > 0 && i < actuators.Count; left--)
            {
                var actuator = actuators[i];
                if (!ReferenceEquals(actuator.DataType, type))
                {
                    Fail(Mismatch("actuator", actuator.GetType(), node, actuator.DataType, type), actuator);
                    return;
                }
                try
                {
                    actuator.Act(buffer, index);
                    actuator.Succeeded();
                }
                catch (Exception error)
                {
                    Report(node, actuator, error);
                }
                if (actuators.Has(i, actuator)) i++;
            }
        }

        private void Simulate()
        {
            var steps = (int)Math.Ceiling(settings.deltaTime / settings.physicsStep - 1e-6);
            var step = settings.deltaTime / steps;
            for (var i = 0; i < steps; i++) Physics.Simulate(step);
        }

        private void Report(Node node, NodePart part, Exception error)
        {
            errors.Add(part.GetType().Name, node.Id, tickInProgress, error.Message);
            node.LastError = error.Message;
            Debug.LogException(
                new InvalidOperationException(part.GetType().Name + " of node " + node.Id + " ('" + node.name + "') failed at tick " + tickInProgress + ": "
                    + error.Message, error), part);
            part.Failed();
        }

        private void DrainLog()
        {
            while (hostLog != null && hostLog.TryRead(out var level, out var line)) Show(level, line);
        }

        private void Show(HostLogLevel level, string line)
        {
            if (level == HostLogLevel.Error) Debug.LogError(line, this);
            else if (level == HostLogLevel.Warning) Debug.LogWarning(line, this);
            else Debug.Log(line, this);
            Logged?.Invoke(level, line);
        }

        private bool CheckEnds(string verb, int a, int b)
        {
            if (a == b)
            {
                Fail("cannot " + verb + " a link from node " + a + " to itself");
                return false;
            }
            var unknown = Find(a) == null ? a : Find(b) == null ? b : -1;
            if (unknown < 0) return true;
            Fail("cannot " + verb + " a link between nodes " + a + " and " + b + ": node " + unknown + " takes no part in the simulation");
            return false;
        }

        private int IndexOf(int id)
        {
            var low = 0;
            var high = nodes.Count - 1;
            while (low <= high)
            {
                var middle = (low + high) / 2;
                if (nodes[middle].Id == id) return middle;
                if (nodes[middle].Id < id) low = middle + 1;
                else high = middle - 1;
            }
            return ~low;
        }

        private static string Mismatch(string kind, Type type, Node node, Type has, Type wants) =>
            kind + " " + type.Name + " of node " + node.Id + " ('" + node.name + "') is made for " + has.FullName + ", the session's schema has "
                + wants.FullName;

        private static double Milliseconds(long from, long to) => (to - from) * 1000.0 / Stopwatch.Frequency;
    }
}
