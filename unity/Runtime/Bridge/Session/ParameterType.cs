namespace Collektive.Bridge
{
    /// <summary>The type of a program parameter. It follows from its enum class or its default value.</summary>
    public enum ParameterType
    {
        /// <summary>Any text.</summary>
        Text,

        /// <summary>A whole number in the range of <see cref="int"/>; the default is one, such as <c>3</c>.</summary>
        Integer,

        /// <summary>A number; the default is one, such as <c>3.0</c>.</summary>
        Number,

        /// <summary><c>true</c> or <c>false</c>; the default is one of them.</summary>
        Boolean,

        /// <summary>A constant of the enum class in the parameter's declaration.</summary>
        Enum,
    }
}
