using System;
using System.Collections.Generic;
using System.IO;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>What a simulation is started with; read when its session opens, so changes take effect at the next start.</summary>
    [Serializable]
    public sealed class SimulationSettings
    {
        /// <summary>More physics sub-steps in a tick than any run could do.</summary>
        private const double MaxSubSteps = 1e6;

        /// <summary>Shorter ticks would have no physics.</summary>
        private const float MinDeltaTime = 1e-6f;

        /// <summary>Full name of the generated schema class; empty when the project has only one.</summary>
        [Tooltip("Full name of the generated schema class, for instance swarm.SwarmSchema. Empty: the only one.")]
        public string schema = "";

        /// <summary>Jars with programs; relative paths start at the project's folder. Empty: the jar that the editor makes of the schema's programs.</summary>
        [Tooltip("Jars with programs. Relative paths start at the project's folder. Empty: Library/Collektive/NAME.jar, made of the schema's programs.")]
        public List<string> jars = new List<string>();

        /// <summary>What runs the programs.</summary>
        [Tooltip("What runs the programs: the package's own runtime, or Collektive itself, from jars of yours.")]
        public AggregateRuntime runtime = AggregateRuntime.BuiltIn;

        /// <summary>Collektive only: folder with its dsl and stdlib and all that they need. Relative paths start at the project's folder.</summary>
        [Tooltip("Collektive only: folder with its dsl and stdlib and all that they need, as jars. Relative paths start at the project's folder.")]
        public string runtimeJars = "";

        /// <summary>Collektive only: jar of its compiler plugin, with which programs are built. Relative paths start at the project's folder.</summary>
        [Tooltip("Collektive only: jar of its compiler plugin, with which programs are built. Relative paths start at the project's folder.")]
        public string runtimePlugin = "";

        /// <summary>Program of nodes that name none.</summary>
        [Tooltip("Program of nodes that name none.")]
        public string program = "";

        /// <summary>The one seed that all randomness comes from.</summary>
        [Tooltip("The one seed that all randomness comes from: same scene, same seed, same result.")]
        public ulong seed = 1;

        /// <summary>Simulated seconds from one round to the next, greater than 0.</summary>
        [Tooltip("Simulated seconds from one round to the next.")]
        [Min(0.001f)]
        public float deltaTime = 0.05f;

        /// <summary>Longest physics sub-step in seconds, greater than 0 and at most 0.02.</summary>
        [Tooltip("Longest physics sub-step in seconds; a tick is divided into equal sub-steps.")]
        [Range(0.001f, 0.02f)]
        public float physicsStep = 0.02f;

        /// <summary>Simulated seconds after which the simulation is paused; 0: never.</summary>
        [Tooltip("Simulated seconds after which the simulation is paused. 0: never.")]
        [Min(0)]
        public float stopAfter;

        /// <summary>When nodes run, and which messages a round sees.</summary>
        [Tooltip("Lockstep: all nodes run in each tick and see what was sent before it. Sequential: in id order, each sees what earlier nodes sent. " +
            "Asynchronous: each node has its own period and phase.")]
        public Schedule schedule = Schedule.Lockstep;

        /// <summary>When nodes without a timing of their own run under the asynchronous schedule.</summary>
        [Tooltip("Asynchronous schedule only: when nodes without a timing of their own run.")]
        public RoundTiming timing = new RoundTiming();

        /// <summary>What happens to messages between sending and receiving; default: ideal.</summary>
        [Tooltip("Probability that a message is lost, and what a link's metres and attenuation add to it; seconds of delay, of jitter, " +
            "and for which a message stays valid (0: until the next one). All 0: ideal.")]
        public NetworkModel network = new NetworkModel();

        /// <summary>Threads of the JVM that run rounds. With 2 or more, a second thread also searches for neighbours in large scenes.</summary>
        [Tooltip("Threads of the JVM that run rounds; with 2 or more, a second thread also searches for neighbours. Results do not depend on it.")]
        [Range(1, 256)]
        public int threads = 1;

        /// <summary>Milliseconds after which a tick counts as hung.</summary>
        [Tooltip("Milliseconds after which a tick counts as hung; the simulation then stops with an error.")]
        [Min(1)]
        public int stepLimitMs = 10000;

        /// <summary>
        /// File to record all frames in, overwritten at each start; empty for none. Relative paths start at the project's folder, in a player at the
        /// folder that it is started in.
        /// </summary>
        [Tooltip("File to record all frames in, for ./collektive replay and diff; overwritten at each start. " +
            "Empty: none. Relative paths start at the project's folder, in a player at the folder that it is started in.")]
        public string record = "";

        /// <summary>Settings of the JVM, which starts once per process; null for the defaults.</summary>
        [Tooltip("Settings of the JVM: heap, collector, compiler. They take effect when the JVM starts, once per editor session. None: the defaults.")]
        public JvmSettingsAsset jvm;

        /// <summary>What is wrong with the command line that settings were taken from, or null.</summary>
        internal string ArgumentProblem { get; set; }

        /// <summary>By program, values of its parameters on nodes that have none of their own.</summary>
        internal Dictionary<string, List<NodeParameter>> ProgramParameters { get; } = new Dictionary<string, List<NodeParameter>>();

        /// <summary>The parameters that a node's program gets: the node's own, and those of the program that it has no value for.</summary>
        internal List<NodeParameter> ParametersOf(Node node)
        {
            if (!ProgramParameters.TryGetValue(node.Program.Length > 0 ? node.Program : program, out var common)) return node.Parameters;
            var all = new List<NodeParameter>(node.Parameters);
            foreach (var parameter in common)
            {
                if (!node.Parameters.Exists(own => own.name == parameter.name)) all.Add(parameter);
            }
            return all;
        }

        /// <summary>What of it the session's opening sends to the JVM.</summary>
        internal SessionSettings ToSession(DataSchema schema) => new SessionSettings
        {
            Seed = seed,
            Threads = threads,
            Schedule = schedule,
            Network = network,
            Jars = JarsFor(schema).ConvertAll(Installation.PathOf),
            Program = program,
            Record = string.IsNullOrWhiteSpace(record) ? "" : Path.GetFullPath(record),
            Runtime = runtime,
            RuntimeJars = string.IsNullOrWhiteSpace(runtimeJars) ? "" : Installation.PathOf(runtimeJars),
        };

        /// <summary>The jars that are named, or else that of <paramref name="schema"/> for the runtime.</summary>
        internal List<string> JarsFor(DataSchema schema) => jars.Count > 0 ? jars : new List<string> { Installation.JarOf(schema.File, runtime) };

        /// <summary>The first thing that is wrong, with what to do; null when all is right.</summary>
        internal string FindProblem()
        {
            if (ArgumentProblem != null) return ArgumentProblem;
            if (!(deltaTime > 0) || float.IsInfinity(deltaTime)) return "delta time is " + deltaTime + " s: it must be greater than 0";
            if (deltaTime < MinDeltaTime) return "delta time is " + deltaTime + " s: it must be at least " + MinDeltaTime;
            if (!(physicsStep > 0 && physicsStep <= 0.02f)) return "physics step is " + physicsStep + " s: it must be in (0, 0.02]";
            if (deltaTime / (double)physicsStep > MaxSubSteps)
                return "physics step is " + physicsStep + " s: a tick of " + deltaTime + " s would have more than a million of them";
            if (!(stopAfter >= 0)) return "stop after is " + stopAfter + " s: it must be 0 or greater";
            if (threads < 1 || threads > 256) return "threads is " + threads + ": it must be in 1..256";
            if (stepLimitMs < 1) return "step limit is " + stepLimitMs + " ms: it must be at least 1";
            if (runtime == AggregateRuntime.Collektive && string.IsNullOrWhiteSpace(runtimeJars))
                return "runtime is Collektive, and runtime jars is empty: name the folder of Collektive's jars";
            if (jars.Exists(string.IsNullOrWhiteSpace)) return "a jar has no path: add it to the settings, or remove the jar";
            var problem = schedule == Schedule.Asynchronous ? timing.FindProblem(deltaTime) : null;
            return problem ?? network.FindProblem(SimulatedSeconds.Exact(deltaTime));
        }
    }
}
