using System;
using System.Collections.Generic;
using System.IO;
using System.Text;

namespace Collektive.Headless
{
    /// <summary>A text file in the data folder of a scenario, which its key <c>data</c> names.</summary>
    public sealed class DataFile
    {
        private DataFile(string name, string path)
        {
            Name = name;
            Path = path;
        }

        /// <summary>The data folder of the current scenario; empty if it has none.</summary>
        internal static string Folder { get; set; } = "";

        /// <summary>The path relative to the data folder.</summary>
        public string Name { get; }

        /// <summary>The full path.</summary>
        public string Path { get; }

        /// <summary>Finds a file by its path relative to the data folder.</summary>
        /// <exception cref="ScenarioException">The data folder does not contain the file.</exception>
        public static DataFile Find(string name)
        {
            if (name.Length == 0) throw new ScenarioException("the name of a file is missing");
            if (Folder.Length == 0) throw new ScenarioException("'" + name + "' needs the scenario's key 'data', the folder that contains the file");
            var path = System.IO.Path.GetFullPath(System.IO.Path.Combine(Folder, name));
            // Files outside of the folder are rejected, because repetitions and sweeps do not have them.
            if (!path.StartsWith(Folder + "/", StringComparison.Ordinal) || !RegularFile.Exists(path))
                throw new ScenarioException("'" + name + "' is not a file in the folder 'data', " + Folder);
            return new DataFile(name, path);
        }

        /// <summary>Returns an error with the name of this file and a line.</summary>
        /// <param name="line">Number of the line, from 1; 0 if unknown.</param>
        public ScenarioException Error(int line, string message) => new ScenarioException(Name + (line > 0 ? ":" + line : "") + ": " + message);

        /// <summary>Reads columns of numbers from a CSV file. Its first line contains the names of the columns. Blank lines are ignored.</summary>
        /// <param name="columns">Names of the columns to read.</param>
        /// <returns>An array per line: the values of the columns, NaN for missing columns, and last the number of the line.</returns>
        /// <exception cref="ScenarioException">A column occurs twice or has the wrong case, a line has a wrong number of cells, misplaced quotes or a null
        /// character, or a cell is not a finite number.</exception>
        public List<double[]> ReadCsv(params string[] columns)
        {
            var rows = new List<double[]>();
            List<string> header = null;
            var number = 0;
            foreach (var line in File.ReadLines(Path))
            {
                number++;
                // File systems fill files with null characters after a crash, and Mono ignores them after a number.
                if (line.IndexOf('\0') >= 0) throw Error(number, "the line contains a null character");
                if (line.Trim().Length == 0) continue;
                var cells = Cells(line, number);
                if (header == null)
                {
                    header = cells;
                    foreach (var name in columns)
                    {
                        if (header.IndexOf(name) != header.LastIndexOf(name)) throw Error(number, "the column '" + name + "' occurs twice");
                        // Without ids, for instance, values would apply to all nodes.
                        var similar = header.Find(other => string.Equals(other, name, StringComparison.OrdinalIgnoreCase));
                        if (similar != null && !header.Contains(name))
                            throw Error(number, "the column '" + similar + "' differs from '" + name + "' only in its case: rename it");
                    }
                    continue;
                }
                if (cells.Count != header.Count)
                    throw Error(number, "the number of cells is " + cells.Count + ", but the first line has " + header.Count);
                var row = new double[columns.Length + 1];
                for (var i = 0; i < columns.Length; i++)
                {
                    var column = header.IndexOf(columns[i]);
                    row[i] = column < 0 ? double.NaN : Number(cells[column], number, columns[i]);
                }
                row[columns.Length] = number;
                rows.Add(row);
            }
            if (rows.Count == 0) throw Error(number, "the file has no rows; the first line must name the columns");
            return rows;
        }

        /// <summary>Reads a finite number.</summary>
        internal double Number(string text, int line, string name)
        {
            if (ExactNumber.TryParse(text, out var value) && !double.IsNaN(value) && !double.IsInfinity(value))
                return value;
            throw Error(line, "'" + name + "' is '" + text + "'; it must be a number");
        }

        private List<string> Cells(string line, int number)
        {
            var cells = new List<string>();
            var cell = new StringBuilder();
            var isQuoted = false;
            var wasQuoted = false;
            var last = ',';
            foreach (var letter in line + ",")
            {
                if (letter == '"' && isQuoted) (isQuoted, wasQuoted) = (false, true);
                else if (letter == '"' && last == '"')
                {
                    // Two quotes within quotes are one quote of the text.
                    cell.Append(letter);
                    isQuoted = true;
                }
                else if (letter == '"')
                {
                    if (wasQuoted || cell.ToString().Trim().Length > 0)
                        throw Error(number, "a quote is inside a cell: put the cell in quotes, and write each quote inside it twice");
                    isQuoted = true;
                }
                else if (letter != ',' || isQuoted)
                {
                    if (wasQuoted && !isQuoted && !char.IsWhiteSpace(letter)) throw Error(number, "a cell continues after its closing quote");
                    cell.Append(letter);
                }
                else
                {
                    cells.Add(cell.ToString().Trim());
                    cell.Clear();
                    wasQuoted = false;
                }
                last = letter;
            }
            if (isQuoted) throw Error(number, "a quote is not closed");
            return cells;
        }
    }
}
