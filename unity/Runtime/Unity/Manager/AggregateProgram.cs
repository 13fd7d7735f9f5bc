using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A program of a <see cref="ProgramLibrary"/>. The Simulation Manager and nodes refer to it.</summary>
    [HelpPage("programs.md#select-programs")]
    public sealed class AggregateProgram : ScriptableObject
    {
        [SerializeField]
        [Tooltip("Name in the @Program annotation.")]
        private string programName = "";

        [SerializeField]
        [Tooltip("Parameters that nodes can set.")]
        private Declaration[] parameters = new Declaration[0];

        [SerializeField]
        [Tooltip("The library that contains the program.")]
        private ProgramLibrary library;

        /// <summary>The name in the program's <c>@Program</c> annotation.</summary>
        public string Name => programName;

        /// <summary>The library that contains the program.</summary>
        public ProgramLibrary Library
        {
            get => library;
            internal set => library = value;
        }

        /// <summary>The parameters that nodes can set, in the order of their declaration.</summary>
        public IReadOnlyList<ProgramParameter> Parameters =>
            Array.ConvertAll(parameters, declared => new ProgramParameter(declared.name, declared.defaultValue, declared.description, declared.values));

        /// <summary>Sets the content; called once, by the importer.</summary>
        internal void Set(ProgramInfo program)
        {
            programName = program.Name;
            parameters = new Declaration[program.Parameters.Count];
            for (var i = 0; i < parameters.Length; i++)
            {
                var declared = program.Parameters[i];
                parameters[i] = new Declaration
                {
                    name = declared.Name,
                    defaultValue = declared.DefaultValue,
                    description = declared.Description,
                    values = new List<string>(declared.Values).ToArray(),
                };
            }
        }

        [Serializable]
        private struct Declaration
        {
            [Tooltip("Name of the parameter.")]
            public string name;

            [Tooltip("Value of nodes that do not set the parameter.")]
            public string defaultValue;

            [Tooltip("Meaning, unit and range.")]
            public string description;

            [Tooltip("Possible values; empty if any text is possible.")]
            public string[] values;
        }
    }
}
