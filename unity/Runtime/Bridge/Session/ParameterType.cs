namespace Collektive.Bridge
{
    /// <summary>The type of a program parameter, which is derived from the parameter's enum class or default value.</summary>
    public enum ParameterType
    {
        /// <summary>Any text.</summary>
        Text,

        /// <summary>A whole number in the range of <see cref="int"/>, for parameters with such a default, for example <c>3</c>.</summary>
        Integer,

        /// <summary>A number, for parameters with a default such as <c>3.0</c>.</summary>
        Number,

        /// <summary><c>true</c> or <c>false</c>, for parameters whose default is one of them.</summary>
        Boolean,

        /// <summary>A constant of the enum class in the parameter's declaration.</summary>
        Enum,
    }
}
