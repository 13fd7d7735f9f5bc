using System;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// The programs of a simulation's jars, read without a JVM from the index that the compiler plugin writes for each class with programs
    /// (<c>META-INF/collektive/programs/CLASS</c>; ProgramIndex.kt defines the format).
    /// </summary>
    internal sealed class ProgramIndex
    {
        private const string Folder = "META-INF/collektive/programs/";

        private static readonly Dictionary<string, ProgramIndex> Known = new Dictionary<string, ProgramIndex>();

        private readonly SortedDictionary<string, ProgramInfo> programs = new SortedDictionary<string, ProgramInfo>(StringComparer.Ordinal);
        private readonly List<DateTime> times;

        private ProgramIndex(List<string> jars, string sensorData)
        {
            times = TimesOf(jars);
            foreach (var jar in jars)
            {
                if (!TryRead(jar, sensorData)) WithoutIndex = WithoutIndex ?? jar;
            }
            Names = new List<string>(programs.Keys);
        }

        /// <summary>Names of the programs that the schema's nodes can run, in ordinal order.</summary>
        internal List<string> Names { get; }

        /// <summary>The first jar that does not exist or has no index; null when all have one, and <see cref="Names"/> are all programs.</summary>
        internal string WithoutIndex { get; }

        /// <summary>The index of the settings' jars, read again when one changes; null when the settings' schema cannot be found.</summary>
        internal static ProgramIndex Of(SimulationSettings settings)
        {
            var schema = Schemas.TryFind(settings.schema);
            if (schema == null) return null;
            var jars = settings.JarsFor(schema).FindAll(jar => !string.IsNullOrWhiteSpace(jar)).ConvertAll(Installation.PathOf);
            var space = schema.GetType().Namespace;
            var sensorData = string.IsNullOrEmpty(space) ? "SensorData" : space + ".SensorData";
            var key = sensorData + "\n" + string.Join("\n", jars);
            if (!Known.TryGetValue(key, out var index) || !index.IsOf(jars)) Known[key] = index = new ProgramIndex(jars, sensorData);
            return index;
        }

        /// <summary>The program of that name, or null.</summary>
        internal ProgramInfo Find(string name) => programs.TryGetValue(name, out var program) ? program : null;

        private static List<DateTime> TimesOf(List<string> jars) => jars.ConvertAll(File.GetLastWriteTimeUtc);

        private bool IsOf(List<string> jars)
        {
            for (var i = 0; i < jars.Count; i++)
            {
                if (times[i] != File.GetLastWriteTimeUtc(jars[i])) return false;
            }
            return true;
        }

        private bool TryRead(string jar, string sensorData)
        {
            if (!File.Exists(jar)) return false;
            var hasIndex = false;
            try
            {
                using (var archive = new ZipArchive(File.OpenRead(jar), ZipArchiveMode.Read))
                {
                    foreach (var entry in archive.Entries)
                    {
                        if (!entry.FullName.StartsWith(Folder, StringComparison.Ordinal) || entry.Name.Length == 0) continue;
                        // An incremental build can leave the index of a class that is gone.
                        if (archive.GetEntry(entry.Name.Replace('.', '/') + ".class") == null) continue;
                        hasIndex = true;
                        using (var reader = new StreamReader(entry.Open())) Read(reader, sensorData);
                    }
                }
            }
            catch (InvalidDataException)
            {
                // Not a complete jar: Play reports it.
                return false;
            }
            return hasIndex;
        }

        private void Read(TextReader reader, string sensorData)
        {
            List<ProgramParameter> parameters = null;
            for (var line = reader.ReadLine(); line != null; line = reader.ReadLine())
            {
                var columns = Array.ConvertAll(line.Split('\t'), Unescape);
                if (columns[0] == "program" && columns.Length == 3)
                {
                    parameters = new List<ProgramParameter>();
                    if (columns[2] == sensorData) programs[columns[1]] = new ProgramInfo(columns[1], parameters);
                }
                else if (columns[0] == "parameter" && columns.Length == 4)
                {
                    parameters?.Add(new ProgramParameter(columns[1], columns[2], columns[3]));
                }
            }
        }

        private static string Unescape(string column)
        {
            var parts = column.Split(new[] { @"\\" }, StringSplitOptions.None);
            for (var i = 0; i < parts.Length; i++) parts[i] = parts[i].Replace(@"\t", "\t").Replace(@"\n", "\n").Replace(@"\r", "\r");
            return string.Join(@"\", parts);
        }
    }
}
