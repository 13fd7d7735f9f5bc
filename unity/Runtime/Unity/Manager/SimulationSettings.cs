using System;
using System.Collections.Generic;
using System.IO;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// The settings of a simulation. Changes of <see cref="deltaTime"/>, <see cref="physicsStep"/>, <see cref="stopAfter"/> and
    /// <see cref="stepLimitMs"/> take effect in the next tick, those of <see cref="timing"/> for nodes that join later, those of <see cref="jars"/> and
    /// <see cref="libraries"/> also when the programs are reloaded, and all others at the next start.
    /// </summary>
    [Serializable]
    public sealed class SimulationSettings
    {
        /// <summary>Maximum number of physics sub-steps per tick.</summary>
        private const double MaxSubSteps = 1e6;

        /// <summary>Minimum delta time in seconds. In shorter ticks, physics would not advance.</summary>
        private const float MinDeltaTime = 1e-6f;

        /// <summary>Libraries with the programs that nodes can run, all compiled with one schema. Ignored if <see cref="jars"/> has entries.</summary>
        [Tooltip("Libraries (.clkprograms) with the programs that nodes can run, all compiled with one schema.")]
        public List<ProgramLibrary> libraries = new List<ProgramLibrary>();

        /// <summary>Program of the nodes that do not select one. Its library need not be listed. Ignored if <see cref="program"/> is not empty.</summary>
        [Tooltip("Program of the nodes that do not select one.")]
        public AggregateProgram defaultProgram;

        /// <summary>Full name of the generated schema class, to be set by scripts. Empty: the schema of the libraries.</summary>
        [HideInInspector]
        public string schema = "";

        /// <summary>Paths of jars that replace the libraries, relative to the project's folder, to be set by scripts.</summary>
        [HideInInspector]
        public List<string> jars = new List<string>();

        /// <summary>Name of the program of the nodes that do not select one, to be set by scripts. Empty: <see cref="defaultProgram"/>.</summary>
        [HideInInspector]
        public string program = "";

        /// <summary>Runtime of the programs.</summary>
        [Tooltip("Runtime of the programs: the built-in one, or Collektive from your jars.")]
        public AggregateRuntime runtime = AggregateRuntime.BuiltIn;

        /// <summary>Collektive only: folder with collektive-dsl-jvm, collektive-stdlib-jvm and their dependencies, relative to the project's folder.</summary>
        [Tooltip("Collektive only: folder with collektive-dsl-jvm, collektive-stdlib-jvm and their dependencies, relative to the project's folder.")]
        public string runtimeJars = "";

        /// <summary>Collektive only: jar of its compiler plugin, relative to the project's folder.</summary>
        [Tooltip("Collektive only: jar of its compiler plugin, relative to the project's folder. Used to build programs.")]
        public string runtimePlugin = "";

        /// <summary>Seed of all random numbers. Scripts must set it while the manager is disabled.</summary>
        [Tooltip("Seed of all random numbers. The same scene and seed give the same results.")]
        public ulong seed = 1;

        /// <summary>Simulated seconds from one round to the next, greater than 0.</summary>
        [Tooltip("Simulated seconds from one round to the next.")]
        [Min(0.001f)]
        public float deltaTime = 0.05f;

        /// <summary>Longest physics sub-step in seconds, greater than 0 and at most 0.02.</summary>
        [Tooltip("Longest physics sub-step in seconds. A tick consists of equal sub-steps.")]
        [Range(0.001f, 0.02f)]
        public float physicsStep = 0.02f;

        /// <summary>Simulated seconds after which the simulation is paused; 0: never.</summary>
        [Tooltip("Simulated seconds after which the simulation is paused. 0: never.")]
        [Min(0)]
        public float stopAfter;

        /// <summary>Order of rounds, and the messages that a round receives.</summary>
        [Tooltip("Lockstep: all nodes run in each tick and receive earlier messages. Sequential: in order of ids, nodes also receive messages of this tick. " +
            "Asynchronous: each node has its own period and phase.")]
        public Schedule schedule = Schedule.Lockstep;

        /// <summary>The timing of rounds under the asynchronous schedule, for nodes without their own timing.</summary>
        [Tooltip("Asynchronous schedule only: when nodes without their own timing run.")]
        public RoundTiming timing = new RoundTiming();

        /// <summary>Loss and delay of messages. Default: an ideal network.</summary>
        [Tooltip("Probability of losing a message, and its increase per metre and per attenuation of the link. Seconds of delay and jitter, " +
            "and until a message expires (0: with the next one). All 0: ideal network.")]
        public NetworkModel network = new NetworkModel();

        /// <summary>Number of JVM threads that run rounds. Neighbour searches in large scenes use the same number of threads.</summary>
        [Tooltip("Number of JVM threads for rounds, and of threads for neighbour searches. Results do not depend on it.")]
        [Range(1, 256)]
        public int threads = 1;

        /// <summary>Milliseconds after which a tick counts as hung, and the simulation stops with an error.</summary>
        [Tooltip("Milliseconds after which a tick counts as hung and the simulation stops with an error.")]
        [Min(1)]
        public int stepLimitMs = 10000;

        /// <summary>
        /// File in which all frames are recorded, overwritten at each start; empty: no record. A relative path starts at the project's folder or, in a
        /// player, at the working directory.
        /// </summary>
        [Tooltip("File for a record of all frames, for ./collektive replay and diff. Overwritten at each start. " +
            "Empty: no record. Relative to the project's folder, or to the player's working directory.")]
        public string record = "";

        /// <summary>Settings with which the JVM is started; null: the defaults.</summary>
        [Tooltip("Settings of the JVM: heap, collector, compiler. They take effect when the JVM starts: once per editor session, " +
            "or at each Play with the placement OwnProcess. None: the defaults.")]
        public JvmSettingsAsset jvm;

        /// <summary>The error of the command line, or null.</summary>
        internal string ArgumentProblem { get; set; }

        /// <summary>Name of the program of the nodes that do not select one; empty if it is not set.</summary>
        internal string ProgramName => program.Length > 0 ? program : defaultProgram != null ? defaultProgram.Name : "";

        /// <summary>Name of the schema; empty for the project's only schema.</summary>
        internal string SchemaName
        {
            get
            {
                var used = schema.Length > 0 || jars.Count > 0 ? null : Libraries().Find(library => library != null);
                return used == null ? schema : used.Schema;
            }
        }

        /// <summary>Paths of the jars with programs, relative to the project's folder.</summary>
        internal List<string> JarPaths => jars.Count > 0 ? jars : Libraries().FindAll(library => library != null).ConvertAll(library => library.File);

        /// <summary>The values of parameters for nodes without their own values, by the name of the program.</summary>
        internal Dictionary<string, List<NodeParameter>> ProgramParameters { get; } = new Dictionary<string, List<NodeParameter>>();

        /// <summary>Names of the metrics to measure, which the jars define. A tick measures them on request.</summary>
        internal IReadOnlyList<string> Metrics { get; set; } = new string[0];

        /// <summary>Returns the name of the program that a node runs.</summary>
        internal string ProgramOf(Node node) => node.UsedProgram.Length > 0 ? node.UsedProgram : node.Simulation?.Program ?? ProgramName;

        /// <summary>Returns the program with the given name in the libraries, or null.</summary>
        internal AggregateProgram FindProgram(string name)
        {
            foreach (var library in Libraries())
            {
                var found = library == null ? null : library.Find(name);
                if (found != null) return found;
            }
            return null;
        }

        /// <summary>Returns the listed libraries and the library of the default program.</summary>
        internal List<ProgramLibrary> Libraries()
        {
            var all = new List<ProgramLibrary>(libraries);
            if (defaultProgram != null && !all.Contains(defaultProgram.Library)) all.Add(defaultProgram.Library);
            return all;
        }

        /// <summary>Returns the parameters of a node. The manager's values are used for parameters that the node does not set.</summary>
        internal List<NodeParameter> ParametersOf(Node node)
        {
            if (!ProgramParameters.TryGetValue(ProgramOf(node), out var common)) return node.UsedParameters;
            var all = new List<NodeParameter>(node.UsedParameters);
            foreach (var parameter in common)
            {
                if (!node.UsedParameters.Exists(own => own.name == parameter.name)) all.Add(parameter);
            }
            return all;
        }

        /// <summary>Returns the settings that opening a session sends to the JVM.</summary>
        internal SessionSettings ToSession() => new SessionSettings
        {
            Seed = seed,
            Threads = threads,
            Schedule = schedule,
            Network = network,
            Jars = JarPaths.ConvertAll(Installation.PathOf),
            Program = ProgramName,
            Record = string.IsNullOrWhiteSpace(record) ? "" : Path.GetFullPath(record),
            Runtime = runtime,
            RuntimeJars = string.IsNullOrWhiteSpace(runtimeJars) ? "" : Installation.PathOf(runtimeJars),
            Metrics = Metrics,
        };

        /// <summary>Returns the first error of a value with its fix, or null.</summary>
        internal string FindProblem()
        {
            var problem = ArgumentProblem ?? FindTickProblem();
            if (problem != null) return problem;
            if (runtime == AggregateRuntime.Collektive && string.IsNullOrWhiteSpace(runtimeJars))
                return "runtime is Collektive, but runtime jars is empty: select the folder of Collektive's jars";
            if (jars.Exists(string.IsNullOrWhiteSpace)) return "a jar has no path: enter the path, or remove the entry";
            problem = schedule == Schedule.Asynchronous ? timing.FindProblem(deltaTime) : null;
            return problem ?? network.FindProblem(SimulatedSeconds.Exact(deltaTime));
        }

        /// <summary>Returns the error of the values that are read in each tick, or null.</summary>
        internal string FindTickProblem()
        {
            if (!(deltaTime > 0) || float.IsInfinity(deltaTime)) return "delta time is " + deltaTime + " s: it must be greater than 0";
            if (deltaTime < MinDeltaTime) return "delta time is " + deltaTime + " s: it must be at least " + MinDeltaTime;
            if (!(physicsStep > 0 && physicsStep <= 0.02f)) return "physics step is " + physicsStep + " s: it must be greater than 0 and at most 0.02";
            if (deltaTime / (double)physicsStep > MaxSubSteps)
                return "physics step is " + physicsStep + " s: a tick of " + deltaTime + " s would need more than a million steps; raise the physics step";
            if (!(stopAfter >= 0)) return "stop after is " + stopAfter + " s: it must be 0 or greater";
            if (threads < 1 || threads > 256) return "threads is " + threads + ": it must be from 1 to 256";
            return stepLimitMs < 1 ? "step limit is " + stepLimitMs + " ms: it must be at least 1" : null;
        }

        /// <summary>
        /// Returns the error of a node's program or parameters, or null. The check compares the libraries, because another library may have a
        /// program with the same name.
        /// </summary>
        internal string FindProblem(Node node)
        {
            for (var i = 1; i < node.Parameters.Count; i++)
            {
                var name = node.Parameters[i].name ?? "";
                if (node.Parameters.FindIndex(parameter => (parameter.name ?? "") == name) < i)
                    return "parameter '" + name + "' has two values: remove one of them";
            }
            var library = jars.Count > 0 || node.OwnProgram == null ? null : node.OwnProgram.Library;
            return library == null || Libraries().Contains(library) ? null : "program '" + node.OwnProgram.Name + "' is in "
                + library.File + ", which is not among the libraries of the Simulation Manager: add it";
        }

        /// <summary>Returns the error of the libraries, or null.</summary>
        internal string FindLibraryProblem()
        {
            if (jars.Count > 0) return null;
            var all = Libraries();
            if (all.Count == 0) return "no program library is selected: drag a .clkprograms file to Libraries in the Simulation Manager";
            if (all.Exists(library => library == null))
                return "an entry of Libraries in the Simulation Manager is empty, or its file was deleted: select a .clkprograms file, or remove the entry";
            var other = all.Find(library => library.Schema != all[0].Schema);
            return other == null ? null : all[0].File + " and " + other.File + " were compiled with different schemas, " + all[0].Schema + " and "
                + other.Schema + ": use the libraries of one schema";
        }
    }
}
