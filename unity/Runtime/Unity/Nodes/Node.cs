using System;
using System.Collections;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// A device of the simulation. It takes part while the component is enabled, and starts without state or messages when it is enabled again. Its
    /// sensors, actuators and neighbourhood rules are the enabled ones on its GameObject and on children without a Node.
    /// </summary>
    [AddComponentMenu("Collektive/Node")]
    [DisallowMultipleComponent]
    [HelpPage("schedules-and-network.md#nodes-and-links")]
    public sealed class Node : MonoBehaviour
    {
        internal PartList Sensors;
        internal PartList Actuators;
        internal PartList Rules;

        // The order of enabling determines the ids. A disabled node leaves a gap (null), because closing each gap immediately would
        // move all later nodes.
        private static readonly List<Node> EnabledNodes = new List<Node>();
        private static int gaps;

        /// <summary>Whether the missing manager was reported. It is reported for one node only.</summary>
        private static bool hasReportedNoManager;

        [SerializeField]
        [Tooltip("Unique id of the node, 0 or greater. -1: the next free id.")]
        private int id = -1;

        [SerializeField]
        [Tooltip("Program of this node. None: the manager's program.")]
        private AggregateProgram ownProgram;

        [SerializeField]
        [HideInInspector]
        private string program = "";

        [SerializeField]
        [ProgramParameters]
        [Tooltip("Values of the program's parameters. Other parameters have their defaults.")]
        private List<NodeParameter> parameters = new List<NodeParameter>();

        [SerializeField]
        [Tooltip("Asynchronous schedule only. On: the timing below. Off: the manager's timing.")]
        private bool ownTiming;

        [SerializeField]
        [Tooltip("Timing of this node's rounds if Own Timing is on.")]
        private RoundTiming timing = new RoundTiming();

        // Copies of the settings with which the node joined, because scripts may change them afterwards; null before that.
        [NonSerialized]
        private string joinedProgram;

        [NonSerialized]
        private List<NodeParameter> joinedParameters;

        private RandomStream random;
        private int enabledIndex;
        private ActuatorBuffer answers;
        private int answerIndex;
        private AnswerCopy answerCopy;
        private RoundTimer timer;
        private double asleepUntil;
        // Simulated time of the last round plus the duration of sleep since then; NaN before the first round.
        private double roundTime;
        // Simulated time of the first tick of the present sleep; NaN while the node is awake.
        private double sleepStart;
        private float roundInterval;

        /// <summary>The id in the running simulation; -1 while the node is not in one.</summary>
        public int Id { get; private set; } = -1;

        /// <summary>
        /// The requested id; -1: the next free id. Read when the node joins the simulation. If it is set to another id before the node's first tick, the node
        /// joins again, which ends its <see cref="Sleep"/> and removes links that scripts have added.
        /// </summary>
        public int RequestedId
        {
            get => id;
            set
            {
                id = value;
                Simulation?.ChangeId(this);
            }
        }

        /// <summary>
        /// Name of the program; empty: the manager's program. If a script sets it, it takes precedence over <see cref="OwnProgram"/>. Read when the node joins.
        /// </summary>
        public string Program
        {
            get => program.Length > 0 || ownProgram == null ? program : ownProgram.Name;
            set => program = value ?? "";
        }

        /// <summary>
        /// The program; null: the manager's program. Setting it discards a name that a script set in <see cref="Program"/>. Read when the node joins.
        /// </summary>
        public AggregateProgram OwnProgram
        {
            get => program.Length > 0 ? null : ownProgram;
            set
            {
                ownProgram = value;
                program = "";
            }
        }

        /// <summary>Values of the program's parameters. Read when the node joins.</summary>
        public List<NodeParameter> Parameters => parameters;

        /// <summary>The value of <see cref="Program"/> with which the node joined; before that, the present value.</summary>
        internal string UsedProgram => joinedProgram ?? Program;

        /// <summary>The values of <see cref="Parameters"/> with which the node joined; before that, the present values.</summary>
        internal List<NodeParameter> UsedParameters => joinedParameters ?? parameters;

        /// <summary>Whether <see cref="Timing"/> replaces the manager's timing under the asynchronous schedule. Read when the node joins.</summary>
        public bool OwnTiming
        {
            get => ownTiming;
            set => ownTiming = value;
        }

        /// <summary>Timing of this node's rounds, used if <see cref="OwnTiming"/> is set. Read when the node joins.</summary>
        public RoundTiming Timing => timing;

        /// <summary>Random numbers for this node's sensors and actuators. They depend only on the seed and the id.</summary>
        /// <exception cref="InvalidOperationException">The node is not in a simulation.</exception>
        public RandomStream Random =>
            random ?? throw new InvalidOperationException("node '" + name
                + "' has random numbers only while it is in a simulation: use Node.Random in Sense, Act or FindNeighbours");

        /// <summary>The tick in or after which the node joined.</summary>
        internal ulong JoinTick { get; private set; }

        /// <summary>
        /// The tick of the last answer; 0 before the first answer. <c>SimulationManager.Current.Tick - node.AnswerTick</c> is the age of the answer in ticks.
        /// </summary>
        public ulong AnswerTick { get; private set; }

        /// <summary>
        /// Simulated time at the end of the tick of the last answer, in seconds; -1 before the first answer. The <c>device.time</c> of the round is the time
        /// at the beginning of the tick.
        /// </summary>
        public double AnswerTime { get; private set; } = -1;

        /// <summary>
        /// Simulated seconds from the previous round, even if it failed, to the round of the last answer, without the seconds in which the node slept. In the
        /// first round, it is the manager's delta time. It is meant for actuators whose effect depends on the elapsed time.
        /// </summary>
        public float AnswerInterval { get; private set; }

        /// <summary>
        /// Returns the last answer of the node's program, in the same type as actuators receive it. An answer is kept until the next one, even if the node
        /// is not due, sleeps or fails; <see cref="AnswerTick"/> and <see cref="AnswerTime"/> show how old it is. Actuators run in the order of node ids,
        /// so during a tick, nodes with higher ids still have their previous answer. An answer that is a table is a view of the bridge's memory, which is
        /// valid only until the next tick.
        /// </summary>
        /// <returns>False if the node has had no answer since it joined, or if <typeparamref name="TData"/> is not the schema's type.</returns>
        public bool TryGetAnswer<TData>(out TData data)
        {
            data = default;
            if (!(answers is ActuatorBuffer<TData> typed)) return false;
            var age = Simulation.Tick - AnswerTick;
            data = age == 0 ? typed[answerIndex] : age == 1 && !Simulation.IsPending ? typed.Previous(answerIndex) : ((AnswerCopy<TData>)answerCopy).Value;
            return true;
        }

        /// <summary>The last error of this node's round, sensors or actuators; empty before the first error.</summary>
        public string LastError { get; internal set; } = "";

        /// <summary>The last answer, boxed, for tools that do not know the schema's types; null if the node has no answer.</summary>
        internal object Answer
        {
            get
            {
                if (answers == null) return null;
                var age = Simulation.Tick - AnswerTick;
                return age == 0 ? answers.Get(answerIndex) : age == 1 && !Simulation.IsPending ? answers.GetPrevious(answerIndex) : answerCopy.Get();
            }
        }

        /// <summary>
        /// The node's position in this tick, in metres. The transform is read once per tick, before rules and sensors run. Movements after that become
        /// visible in the next tick.
        /// </summary>
        public Vector3 Position { get; internal set; }

        /// <summary>The enabled nodes, in the order in which they were enabled.</summary>
        internal static List<Node> All
        {
            get
            {
                CloseGaps();
                return EnabledNodes;
            }
        }

        internal Transform Body { get; private set; }

        /// <summary>How often the GameObject was deactivated while the node was enabled. Each time, its colliders left physics.</summary>
        internal int Deactivations { get; private set; }

        /// <summary>The node's simulation, or null.</summary>
        internal Simulation Simulation { get; private set; }

        /// <summary>
        /// Suspends the node's rounds for a number of simulated seconds, from the next tick on. The node keeps its state, its links and its sent messages.
        /// It can sleep under any schedule, and its own actuators may call this method.
        /// </summary>
        /// <param name="seconds">0 or greater. 0 wakes the node; with infinity, it sleeps until it is woken.</param>
        /// <exception cref="InvalidOperationException">The node is not in a simulation.</exception>
        public void Sleep(double seconds)
        {
            if (!(seconds >= 0)) throw new ArgumentOutOfRangeException(nameof(seconds), seconds, "the duration of sleep must be 0 or greater");
            if (Id < 0) throw new InvalidOperationException("node '" + name + "' can sleep only while it is in a simulation: call Sleep after it joined");
            asleepUntil = Simulation.NextTickTime + seconds;
        }

        /// <summary>Returns whether a collider is part of this node, and not of another node on a child.</summary>
        internal bool Owns(Collider collider)
        {
            var place = collider.transform;
            return ReferenceEquals(place, Body) || place.IsChildOf(Body) && ReferenceEquals(collider.GetComponentInParent<Node>(), this);
        }

        /// <summary>
        /// Returns the first component on a GameObject or its children that belongs to <paramref name="owner"/> and not to a node on a child, or null.
        /// </summary>
        internal static T FindFirst<T>(GameObject root, Node owner) where T : class
        {
            foreach (var found in root.GetComponentsInChildren<T>())
            {
                if (ReferenceEquals((found as Component).GetComponentInParent<Node>(), owner)) return found;
            }
            return null;
        }

        /// <summary>Starts the node's timer if the schedule is asynchronous. Returns the error of the timing, or null.</summary>
        internal string StartTimer()
        {
            var settings = Simulation.Settings;
            if (Simulation.Schedule != Schedule.Asynchronous) return null;
            var used = ownTiming ? timing : settings.timing;
            var problem = used.FindProblem(Simulation.DeltaTime);
            if (problem == null) timer = new RoundTimer(used, new RandomStream(Simulation.Seed, Id, RandomPurpose.Schedule), Simulation.Time);
            return problem;
        }

        /// <summary>Returns the error of a period that is shorter than the delta time, or null.</summary>
        internal string FindTimerProblem() => timer == null ? null : RoundTiming.FindPeriodProblem(timer.Period, Simulation.DeltaTime);

        /// <summary>Whether the node has been in the simulation since the current tick began.</summary>
        internal bool IsInTick => Id >= 0 && JoinTick < Simulation.TickInProgress;

        /// <summary>Whether the node has a round in this tick.</summary>
        internal bool IsDue { get; private set; }

        /// <summary>
        /// Decides whether the node has a round in the tick that begins at <paramref name="time"/>, and advances the node's timer. Called once per tick.
        /// </summary>
        /// <param name="time">Simulated time in seconds.</param>
        /// <param name="now">Simulated time up to which rounds are due, in seconds.</param>
        internal bool TakeDue(double time, double now, float deltaTime)
        {
            if (asleepUntil > now)
            {
                if (double.IsNaN(sleepStart)) sleepStart = time;
                return IsDue = false;
            }
            if (!double.IsNaN(sleepStart))
            {
                roundTime += time - sleepStart;
                sleepStart = double.NaN;
            }
            IsDue = timer == null || timer.TakeDue(now);
            if (IsDue)
            {
                roundInterval = double.IsNaN(roundTime) ? deltaTime : (float)(time - roundTime);
                roundTime = time;
            }
            return IsDue;
        }

        /// <summary>The greatest possible number of seconds from a round of the node to the next one, without sleep. Rounds begin with ticks.</summary>
        internal float LongestInterval => Simulation.DeltaTime * (timer == null ? 1 : Mathf.Ceil(timer.LongestInterval / Simulation.DeltaTime - 1e-3f));

        internal void OnJoined(Simulation simulation, int newId)
        {
            Simulation = simulation;
            Id = newId;
            JoinTick = simulation.TickInProgress;
            Position = Body.position;
            random = new RandomStream(simulation.Seed, newId, RandomPurpose.Node);
            LastError = "";
            ForgetAnswer();
            timer = null;
            asleepUntil = 0;
            roundTime = double.NaN;
            sleepStart = double.NaN;
            for (var i = 0; i < Sensors.Count; i++) Sensors[i].NodeJoined();
        }

        /// <summary>Keeps the program and the parameters that are sent to the JVM.</summary>
        internal void KeepProgram() => (joinedProgram, joinedParameters) = (Program, new List<NodeParameter>(parameters));

        internal void SetAnswer(ActuatorBuffer buffer, int index, ulong tick, double time)
        {
            answers = buffer;
            answerIndex = index;
            AnswerTick = tick;
            AnswerInterval = roundInterval;
            AnswerTime = time;
        }

        /// <summary>Copies the last answer if the next step would overwrite it. Called after <paramref name="lastTick"/> and before the next tick.</summary>
        internal void KeepAnswer(ulong lastTick)
        {
            if (answers != null && AnswerTick + 1 == lastTick) answers.CopyPrevious(answerIndex, ref answerCopy);
        }

        internal void OnLeft()
        {
            Simulation = null;
            Id = -1;
            random = null;
            (joinedProgram, joinedParameters) = (null, null);
            ForgetAnswer();
        }

        private void ForgetAnswer()
        {
            answers = null;
            answerCopy = null;
            AnswerTick = 0;
            AnswerTime = -1;
        }

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void ResetStatics()
        {
            EnabledNodes.Clear();
            gaps = 0;
            hasReportedNoManager = false;
        }

        private void Awake()
        {
            // Parts that were enabled before this component was added belong to a node above or to a destroyed node.
            foreach (var part in GetComponentsInChildren<NodePart>()) part.UpdateNode();
        }

        private void OnEnable()
        {
            // This is not done in Awake, because Unity does not call Awake again when scripts are compiled during play.
            Body = transform;
            enabledIndex = EnabledNodes.Count;
            EnabledNodes.Add(this);
            if (SimulationManager.Current != null) SimulationManager.Current.Simulation.Join(this);
        }

        private void Start()
        {
            var scale = Body.lossyScale;
            if (scale.x * scale.y * scale.z == 0)
            {
                Debug.LogWarning("node '" + name + "' has a scale of zero, " + scale
                    + ": it is invisible, and physics ignores its colliders. Set a scale above zero", this);
            }
            if (SimulationManager.Current != null || hasReportedNoManager) return;
            hasReportedNoManager = true;
            StartCoroutine(WarnWithoutManager());
        }

        /// <summary>Warns if no loaded scene has a manager. Waits one frame, because an additive scene may contain it.</summary>
        private IEnumerator WarnWithoutManager()
        {
            yield return null;
            if (SimulationManager.Current != null) yield break;
            Debug.LogWarning("node '" + name + "' does not run because no loaded scene has a Simulation Manager: add one (GameObject > Collektive > "
                + "Simulation Manager)", this);
        }

        private void OnDisable()
        {
            if (enabledIndex < EnabledNodes.Count && ReferenceEquals(EnabledNodes[enabledIndex], this))
            {
                EnabledNodes[enabledIndex] = null;
                if (2 * ++gaps > EnabledNodes.Count) CloseGaps();
            }
            if (!gameObject.activeInHierarchy) Deactivations++;
            Simulation?.Leave(this);
        }

        private void OnDestroy()
        {
            // The node's children may remain. GetComponentInParent still finds this component, so the search begins at the parent.
            var above = transform.parent == null ? null : transform.parent.GetComponentInParent<Node>();
            if (above == null) return;
            foreach (var part in GetComponentsInChildren<NodePart>()) part.Move(this, above);
        }

        private static void CloseGaps()
        {
            var count = 0;
            for (var i = 0; i < EnabledNodes.Count; i++)
            {
                var node = EnabledNodes[i];
                if (ReferenceEquals(node, null)) continue;
                node.enabledIndex = count;
                EnabledNodes[count++] = node;
            }
            EnabledNodes.RemoveRange(count, EnabledNodes.Count - count);
            gaps = 0;
        }
    }

    /// <summary>The value of one program parameter on one node.</summary>
    [Serializable]
    public struct NodeParameter
    {
        /// <summary>Name of the parameter in the program.</summary>
        [Tooltip("Name of the parameter in the program.")]
        public string name;

        /// <summary>Value as text.</summary>
        [Tooltip("Value as text.")]
        public string value;

        /// <summary>Creates a value.</summary>
        public NodeParameter(string name, string value)
        {
            this.name = name;
            this.value = value;
        }
    }
}
