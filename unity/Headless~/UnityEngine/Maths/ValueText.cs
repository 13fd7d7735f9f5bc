using System;
using System.Globalization;

namespace UnityEngine
{
    /// The text of vectors, rotations, matrices and colours.
    static class ValueText
    {
        /// As in Unity, numbers have the `usual` format of their type and a decimal point if none are given.
        internal static string Of(string usual, string format, IFormatProvider provider, params float[] values) =>
            "(" + Join(", ", usual, format, provider, values) + ")";

        internal static string Join(string separator, string usual, string format, IFormatProvider provider, params float[] values)
        {
            if (string.IsNullOrEmpty(format)) format = usual;
            provider ??= CultureInfo.InvariantCulture;
            return string.Join(separator, Array.ConvertAll(values, value => value.ToString(format, provider)));
        }
    }
}
