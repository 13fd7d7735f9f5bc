namespace Collektive.Headless
{
    /// <summary>Text in CSV files.</summary>
    internal static class CsvText
    {
        private static readonly char[] Special = { ',', '"', '\n', '\r' };

        /// <summary>Returns a cell with a text, in quotes.</summary>
        internal static string Quoted(string text) => "\"" + text.Replace("\"", "\"\"") + "\"";

        /// <summary>Returns a cell of the header, in quotes if it needs them.</summary>
        internal static string Header(string name) => name.IndexOfAny(Special) < 0 ? name : Quoted(name);
    }
}
