using System.Collections.Generic;

namespace Collektive.Bridge
{
    /// <summary>A program in the session's jars.</summary>
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

        /// <summary>The parameter's name.</summary>
        public string Name { get; }

        /// <summary>The value for nodes that do not set it.</summary>
        public string DefaultValue { get; }

        /// <summary>A description; may be empty.</summary>
        public string Description { get; }
    }
}
