using System.Collections.Generic;
using System.Globalization;

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

        /// <summary>The name in the program's <c>@Program</c> annotation.</summary>
        public string Name { get; }

        /// <summary>The parameters that nodes can set.</summary>
        public IReadOnlyList<ProgramParameter> Parameters { get; }
    }

    /// <summary>A parameter that a program declares.</summary>
    public sealed class ProgramParameter
    {
        internal ProgramParameter(string name, string defaultValue, string description, params string[] values)
        {
            Name = name;
            DefaultValue = defaultValue;
            Description = description;
            Values = values;
            Type = values.Length > 0 ? ParameterType.Enum : TypeOf(defaultValue);
        }

        /// <summary>The parameter's name.</summary>
        public string Name { get; }

        /// <summary>The value for nodes that do not set the parameter.</summary>
        public string DefaultValue { get; }

        /// <summary>A description; may be empty.</summary>
        public string Description { get; }

        /// <summary>The type of the parameter's values.</summary>
        public ParameterType Type { get; }

        /// <summary>The possible values of <see cref="ParameterType.Enum"/>; empty for other types.</summary>
        public IReadOnlyList<string> Values { get; }

        private static ParameterType TypeOf(string value)
        {
            if (value == "true" || value == "false") return ParameterType.Boolean;
            if (int.TryParse(value, NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture, out _)) return ParameterType.Integer;
            return double.TryParse(value, NumberStyles.Float, CultureInfo.InvariantCulture, out _) ? ParameterType.Number : ParameterType.Text;
        }
    }
}
