using System.Collections.Generic;

namespace Collektive.Bridge
{
    /// <summary>A program that the session's jars hold.</summary>
    public sealed class ProgramInfo
    {
        internal ProgramInfo(string name, IReadOnlyList<ProgramParameter> parameters)
        {
            Name = name;
            Parameters = parameters;
        }

        /// <summary>The name in its <c>@Program</c> annotation.</summary>
        public string Name { get; }

        /// <summary>The parameters that nodes can set.</summary>
        public IReadOnlyList<ProgramParameter> Parameters { get; }
    }

    /// <summary>A parameter that a program declares.</summary>
    public sealed class ProgramParameter
    {
        internal ProgramParameter(string name, string defaultValue, string description)
        {
            Name = name;
            DefaultValue = defaultValue;
            Description = description;
        }

        /// <summary>The name that nodes set it by.</summary>
        public string Name { get; }

        /// <summary>Its value where a node sets none.</summary>
        public string DefaultValue { get; }

        /// <summary>What it means; may be empty.</summary>
        public string Description { get; }
    }
}
