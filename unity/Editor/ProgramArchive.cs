using System;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Security.Cryptography;
using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Reads the programs of a jar without a JVM. The compiler plugin writes an index for each class with programs
    /// (<c>META-INF/collektive/programs/CLASS</c>; ProgramIndex.kt defines the format).
    /// </summary>
    internal sealed class ProgramArchive
    {
        private const string Index = "META-INF/collektive/programs/";
        private const string SchemaService = "META-INF/services/org.collektive.frames.data.DataSchema";

        /// <summary>Number of columns before the possible values.</summary>
        private const int ParameterColumns = 4;

        private readonly SortedDictionary<string, ProgramInfo> programs = new SortedDictionary<string, ProgramInfo>(StringComparer.Ordinal);

        private ProgramArchive(ZipArchive jar)
        {
            var schemas = Lines(jar, SchemaService);
            if (schemas.Count != 1)
                throw new InvalidDataException("it contains " + schemas.Count + " schemas: it must contain the programs and the code of one schema");
            Schema = schemas[0];
            using (var binary = Open(jar, "META-INF/collektive/" + Schema + ".bfbs"))
            using (var hash = SHA256.Create()) SchemaHash = BitConverter.ToString(hash.ComputeHash(binary)).Replace("-", "").ToLowerInvariant();
            var attributes = JarManifest.Read(jar);
            Runtime = attributes.TryGetValue("Collektive-Runtime", out var runtime) ? runtime : "builtIn";
            SourcesHash = attributes.TryGetValue("Collektive-Sources", out var sources) ? sources : "";
            foreach (var entry in jar.Entries)
            {
                if (!entry.FullName.StartsWith(Index, StringComparison.Ordinal) || entry.Name.Length == 0) continue;
                // An incremental build can leave the index of a class that was removed.
                if (jar.GetEntry(entry.Name.Replace('.', '/') + ".class") == null) continue;
                ReadIndex(Lines(jar, entry.FullName));
            }
        }

        /// <summary>Full name of the schema class.</summary>
        internal string Schema { get; }

        /// <summary>SHA-256 of the binary schema, in hexadecimal.</summary>
        internal string SchemaHash { get; }

        /// <summary>The manifest's value for the runtime that the programs were compiled for.</summary>
        internal string Runtime { get; }

        /// <summary>The manifest's hash of the sources, or an empty string.</summary>
        internal string SourcesHash { get; }

        /// <summary>The programs, in ordinal order of their names.</summary>
        internal ICollection<ProgramInfo> Programs => programs.Values;

        /// <exception cref="InvalidDataException">The file is not a jar with programs.</exception>
        /// <exception cref="IOException">The file cannot be read.</exception>
        internal static ProgramArchive Read(string path)
        {
            var file = File.ReadAllBytes(path);
            try
            {
                using (var jar = new ZipArchive(new MemoryStream(file), ZipArchiveMode.Read))
                {
                    CheckEntries(file, jar);
                    return new ProgramArchive(jar);
                }
            }
            // Damaged archives make the decoders throw these exceptions, too.
            catch (Exception error) when (error is ArgumentException || error is NotSupportedException || error is EndOfStreamException
                || error is IndexOutOfRangeException)
            {
                throw new InvalidDataException(error.Message, error);
            }
        }

        /// <summary>Compares names and checksums of entries with the directory at the end of the file, because <see cref="ZipArchive"/> does not.</summary>
        private static void CheckEntries(byte[] file, ZipArchive jar)
        {
            // A comment can follow the end record.
            var end = file.Length - 22;
            while (BitConverter.ToUInt32(file, end) != 0x06054B50) end--;
            var at = BitConverter.ToInt32(file, end + 16);
            foreach (var entry in jar.Entries)
            {
                var (nameLength, local) = (BitConverter.ToUInt16(file, at + 28), BitConverter.ToInt32(file, at + 42));
                var isSame = true;
                for (var i = 0; i < nameLength; i++) isSame &= file[at + 46 + i] == file[local + 30 + i];
                if (!isSame || entry.FullName.StartsWith("META-INF/", StringComparison.Ordinal) && Crc32(entry) != BitConverter.ToUInt32(file, at + 16))
                    throw new InvalidDataException("its entry " + entry.FullName + " is damaged: build or download the file again");
                at += 46 + nameLength + BitConverter.ToUInt16(file, at + 30) + BitConverter.ToUInt16(file, at + 32);
            }
        }

        private static uint Crc32(ZipArchiveEntry entry)
        {
            var crc = uint.MaxValue;
            using (var content = new BufferedStream(entry.Open()))
            {
                for (var value = content.ReadByte(); value >= 0; value = content.ReadByte())
                {
                    crc ^= (uint)value;
                    for (var bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1) * 0xEDB88320;
                }
            }
            return ~crc;
        }

        private static Stream Open(ZipArchive jar, string name) =>
            (jar.GetEntry(name) ?? throw new InvalidDataException("its entry " + name + " is missing")).Open();

        private static List<string> Lines(ZipArchive jar, string name)
        {
            var lines = new List<string>();
            using (var reader = new StreamReader(Open(jar, name)))
            {
                for (var line = reader.ReadLine(); line != null; line = reader.ReadLine())
                {
                    if (line.Length > 0) lines.Add(line);
                }
            }
            return lines;
        }

        private void ReadIndex(List<string> lines)
        {
            List<ProgramParameter> parameters = null;
            foreach (var line in lines)
            {
                var columns = Array.ConvertAll(line.Split('\t'), Unescape);
                if (columns[0] == "program" && columns.Length == 3)
                {
                    if (programs.ContainsKey(columns[1])) throw new InvalidDataException("two of its programs are named '" + columns[1] + "': rename one");
                    parameters = new List<ProgramParameter>();
                    programs.Add(columns[1], new ProgramInfo(columns[1], parameters));
                }
                else if (columns[0] == "parameter" && columns.Length >= ParameterColumns)
                {
                    var values = new string[columns.Length - ParameterColumns];
                    Array.Copy(columns, ParameterColumns, values, 0, values.Length);
                    parameters?.Add(new ProgramParameter(columns[1], columns[2], columns[3], values));
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
