using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// A jar with compiled programs, imported from a <c>.clkprograms</c> file. Nodes can run the programs of the libraries that the Simulation Manager
    /// lists. Players contain the libraries that their scenes refer to.
    /// </summary>
    [HelpPage("programs.md#select-programs")]
    public sealed class ProgramLibrary : ScriptableObject
    {
        /// <summary>Extension of the files, without a dot.</summary>
        internal const string Extension = "clkprograms";

        [SerializeField]
        [Tooltip("GUID that identifies this file in players.")]
        private string guid = "";

        [SerializeField]
        [Tooltip("Full name of the generated schema class.")]
        private string schema = "";

        [SerializeField]
        [Tooltip("SHA-256 of the binary schema.")]
        private string schemaHash = "";

        [SerializeField]
        [Tooltip("Runtime for which the programs were compiled.")]
        private string runtime = "";

        [SerializeField]
        [Tooltip("SHA-256 of the schema and the Kotlin files.")]
        private string sourcesHash = "";

        [SerializeField]
        [Tooltip("The programs of the library.")]
        private AggregateProgram[] programs = new AggregateProgram[0];

        /// <summary>The programs, in ordinal order of their names; empty if the file could not be imported.</summary>
        public IReadOnlyList<AggregateProgram> Programs => programs;

        /// <summary>Full name of the schema class that the programs were compiled with, such as <c>swarm.SwarmSchema</c>.</summary>
        public string Schema => schema;

        /// <summary>SHA-256 of the schema in binary form, in hexadecimal.</summary>
        public string SchemaHash => schemaHash;

        /// <summary>The runtime that the programs were compiled for: <c>builtIn</c>, or <c>collektive</c> and the hash of its jars.</summary>
        public string Runtime => runtime;

        /// <summary>SHA-256 of the schema and the Kotlin files, in hexadecimal; empty if the build tool did not record it.</summary>
        public string SourcesHash => sourcesHash;

        /// <summary>Path of the file, relative to the project's folder. In a player, its path among the files that the build added.</summary>
        internal string File => Installation.ToAssetPath == null ? NameInPlayer : Installation.ToAssetPath(guid);

        /// <summary>The path by which a player finds the file. It contains the GUID, because two folders may contain files with the same name.</summary>
        internal string NameInPlayer => "Programs/" + guid + "/" + name + "." + Extension;

        /// <summary>Returns the program of that name, or null.</summary>
        public AggregateProgram Find(string name) => Array.Find(programs, program => program.Name == name);

        /// <summary>Sets the content; called once, by the importer.</summary>
        internal void Set(string guid, string schema, string schemaHash, string runtime, string sourcesHash, AggregateProgram[] programs)
        {
            this.guid = guid;
            this.schema = schema;
            this.schemaHash = schemaHash;
            this.runtime = runtime;
            this.sourcesHash = sourcesHash;
            this.programs = programs;
            foreach (var program in programs) program.Library = this;
        }
    }
}
