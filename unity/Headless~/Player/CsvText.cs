using System;
using System.Globalization;

namespace Collektive.Headless
{
    /// <summary>Formats cells of CSV files.</summary>
    internal static class CsvText
    {
        private static readonly char[] Special = { ',', '"', '\n', '\r' };

        /// <summary>Returns the cell of a text, in quotes.</summary>
        internal static string Quoted(string text) => "\"" + text.Replace("\"", "\"\"") + "\"";

        /// <summary>Returns a text that reads back as exactly the same number, with 15 digits if they suffice.</summary>
        internal static string Number(double value)
        {
            // Mono writes -0 as 0.
            if (value == 0 && double.IsNegativeInfinity(1 / value)) return "-0";
            var text = value.ToString("G15", CultureInfo.InvariantCulture);
            // Mono parses some texts as a neighbouring number, and "R" relies on that. Within these limits, the conversion from decimal is exact: it divides
            // a whole number by a power of ten, and both have exact values as double.
            var isExact = Math.Abs(value) > 1e-7 && Math.Abs(value) < 1e15
                && (double)decimal.Parse(text, NumberStyles.Float, CultureInfo.InvariantCulture) == value;
            return isExact ? text : value.ToString("G17", CultureInfo.InvariantCulture);
        }

        /// <summary>Returns a cell of the header, in quotes if it needs them.</summary>
        internal static string Header(string name) => name.IndexOfAny(Special) < 0 ? name : Quoted(name);
    }
}
