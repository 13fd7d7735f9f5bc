using System.Globalization;

namespace Collektive.Headless
{
    /// <summary>Formats cells of CSV files.</summary>
    internal static class CsvText
    {
        private static readonly char[] Special = { ',', '"', '\n', '\r' };

        /// <summary>Returns the cell of a text, in quotes.</summary>
        internal static string Quoted(string text) => "\"" + text.Replace("\"", "\"\"") + "\"";

        /// <summary>Returns the shortest text that reads back as the same number. Does not use the format "R", which differs between runtimes.</summary>
        internal static string Number(double value)
        {
            for (var digits = 15; digits < 17; digits++)
            {
                var text = value.ToString("G" + digits, CultureInfo.InvariantCulture);
                // On Mono, a text that rounds beyond the largest number cannot be parsed.
                if (double.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out var read) && read.Equals(value)) return text;
            }
            return value.ToString("G17", CultureInfo.InvariantCulture);
        }

        /// <summary>Returns a cell of the header, in quotes if it needs them.</summary>
        internal static string Header(string name) => name.IndexOfAny(Special) < 0 ? name : Quoted(name);
    }
}
