using System;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Linq;
using Collektive.Bridge;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Tests that a jar with programs is an asset, which the editor imports without a JVM.</summary>
    [Category("Mono"), Category("AnyPlacement")]
    public sealed class ProgramLibraryTests : ProjectFixture
    {
        private const string Path = "Assets/Swarm/swarm.clkprograms";

        [Test]
        public void A_built_jar_becomes_a_library_with_its_programs()
        {
            Directory.CreateDirectory("Assets/Swarm");
            File.Copy(TestJvm.Variable("COLLEKTIVE_PROBE_JAR"), Path);
            var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>(Path);
            Assert.That(library.name, Is.EqualTo("swarm"));
            Assert.That(library.Schema, Is.EqualTo("probe.ProbeSchema"));
            Assert.That(library.Runtime, Is.EqualTo("builtIn"));
            Assert.That(library.SchemaHash, Has.Length.EqualTo(64));
            Assert.That(library.Find("double").Library, Is.SameAs(library));
            Assert.That(library.Find("half"), Is.Null);
            Assert.That(Log, Is.Empty);
        }

        [Test]
        public void Programs_have_parameters_with_types()
        {
            Pack(Path, ("swarm.HopsKt", Program("hops", "steps\t3\tNumber of steps.", "range\t3.0\t", "far\ttrue\t", "path\tC:\\\\temp\\tx\t")));
            var parameters = Load(Path).Find("hops").Parameters;
            Assert.That(parameters.Select(parameter => parameter.Name), Is.EqualTo(new[] { "steps", "range", "far", "path" }));
            Assert.That(parameters.Select(parameter => parameter.DefaultValue), Is.EqualTo(new[] { "3", "3.0", "true", "C:\\temp\tx" }));
            Assert.That(parameters.Select(parameter => parameter.Type),
                Is.EqualTo(new[] { ParameterType.Integer, ParameterType.Number, ParameterType.Boolean, ParameterType.Text }));
            Assert.That(parameters[0].Description, Is.EqualTo("Number of steps."));
        }

        [Test]
        public void The_manifest_names_the_runtime_and_the_sources_also_in_long_lines()
        {
            var hash = new string('a', 64);
            Pack(Path, "Manifest-Version: 1.0\r\nCollektive-Runtime: collektive " + hash.Substring(0, 30) + "\r\n " + hash.Substring(30)
                + "\r\nCollektive-Sources: " + hash.Substring(0, 50) + "\r\n " + hash.Substring(50) + "\r\n\r\n", "swarm.SwarmSchema");
            Assert.That(Load(Path).Runtime, Is.EqualTo("collektive " + hash));
            Assert.That(Load(Path).SourcesHash, Is.EqualTo(hash));
        }

        [Test]
        public void A_new_jar_keeps_references_to_the_programs_that_are_still_there()
        {
            Pack(Path, ("swarm.SwarmKt", Program("flock") + Program("hops", "steps\t3\t")));
            var library = Load(Path);
            var (flock, hops) = (library.Find("flock"), library.Find("hops"));
            Pack(Path, ("swarm.SwarmKt", Program("swarm") + Program("hops", "steps\t4\t")));
            AssetDatabase.ImportAsset(Path);
            Assert.That(Load(Path), Is.SameAs(library));
            Assert.That(library.Programs.Select(program => program.Name), Is.EqualTo(new[] { "hops", "swarm" }));
            Assert.That(library.Find("hops"), Is.SameAs(hops));
            Assert.That(hops.Parameters[0].DefaultValue, Is.EqualTo("4"));
            Assert.That(flock == null, Is.True, "a renamed program must be a different asset");
        }

        [Test]
        public void The_index_of_a_removed_class_is_ignored()
        {
            Pack(Path, ("swarm.HopsKt", Program("hops")), ("-swarm.GoneKt", Program("gone")));
            Assert.That(Load(Path).Programs.Select(program => program.Name), Is.EqualTo(new[] { "hops" }));
        }

        [Test]
        public void A_file_without_programs_is_an_import_error_that_names_it()
        {
            Write(Path, "half a jar");
            Assert.That(Load(Path).Programs, Is.Empty);
            Assert.That(Logged("Error: " + Path + " is not a library of programs: "), Is.Not.Null);
            Pack("Assets/none.clkprograms", "Manifest-Version: 1.0\n", "");
            Assert.That(Load("Assets/none.clkprograms").Programs, Is.Empty);
            Logged("Error: Assets/none.clkprograms is not a library of programs: it contains 0 schemas");
            Pack("Assets/two.clkprograms", "Manifest-Version: 1.0\n", "swarm.SwarmSchema\nflock.FlockSchema");
            Assert.That(Load("Assets/two.clkprograms").Programs, Is.Empty);
            Logged("Error: Assets/two.clkprograms is not a library of programs: it contains 2 schemas");
            Pack("Assets/twice.clkprograms", ("swarm.AKt", Program("hops")), ("swarm.BKt", Program("hops")));
            Assert.That(Load("Assets/twice.clkprograms").Programs, Is.Empty);
            Logged("Error: Assets/twice.clkprograms is not a library of programs: two of its programs are named 'hops'");
        }

        [Test]
        public void No_damage_to_a_file_is_more_than_an_import_error()
        {
            var whole = File.ReadAllBytes(TestJvm.Variable("COLLEKTIVE_PROBE_JAR"));
            var random = new System.Random(1);
            Directory.CreateDirectory("Assets/Swarm");
            for (var i = 0; i < 100; i++)
            {
                var damaged = whole;
                if (i % 2 == 0) Array.Resize(ref damaged, random.Next(whole.Length));
                else
                {
                    damaged = (byte[])whole.Clone();
                    // In half of these jars, all damage is at the end of the file, where a jar has its directory.
                    var range = i % 4 == 1 ? 400 : damaged.Length;
                    for (var change = 0; change < 20; change++) damaged[damaged.Length - 1 - random.Next(range)] = (byte)random.Next(256);
                }
                File.WriteAllBytes(Path, damaged);
                Assert.DoesNotThrow(() => AssetDatabase.ImportAsset(Path), "damage " + i);
                Assert.That(Load(Path), Is.Not.Null);
            }
            Logged(Path + " is not a library of programs: ");
        }

        // In the directory at the end of the file, an entry's CRC is 30 bytes before its name.
        [TestCase(-30)]
        [TestCase(40)]
        public void A_wrong_checksum_or_name_is_an_import_error(int place)
        {
            const string Index = "META-INF/collektive/programs/swarm.HopsKt";
            Pack(Path, ("swarm.HopsKt", Program("hops")));
            var jar = File.ReadAllBytes(Path);
            jar[System.Text.Encoding.GetEncoding("ISO-8859-1").GetString(jar).LastIndexOf(Index, StringComparison.Ordinal) + place] ^= 1;
            File.WriteAllBytes(Path, jar);
            Assert.That(Load(Path).Programs, Is.Empty);
            Logged("Error: " + Path + " is not a library of programs: its entry META-INF/collektive/programs/");
        }

        [Test]
        public void A_library_that_moves_is_found_by_its_references()
        {
            Pack(Path, ("swarm.HopsKt", Program("hops")));
            var library = Load(Path);
            Assert.That(library.File, Is.EqualTo(Path));
            Directory.Move("Assets/Swarm", "Assets/Moved");
            Assert.That(library.File, Is.EqualTo("Assets/Moved/swarm.clkprograms"));
        }

        private static ProgramLibrary Load(string path) => AssetDatabase.LoadAssetAtPath<ProgramLibrary>(path);

        /// <summary>Returns the lines of a program in the index of its class.</summary>
        /// <param name="parameters">Name, default and description, separated by tabs.</param>
        internal static string Program(string name, params string[] parameters) =>
            "program\t" + name + "\tprobe.SensorData\n" + string.Concat(parameters.Select(parameter => "parameter\t" + parameter + "\n"));

        /// <summary>Writes a jar with classes and their indexes. A class whose name begins with a hyphen has an index, but is missing in the jar.</summary>
        internal static void Pack(string path, params (string ClassName, string Index)[] classes) =>
            Pack(path, "Manifest-Version: 1.0\r\n", "probe.ProbeSchema", classes);

        /// <summary>Writes a jar with a schema and without programs.</summary>
        internal static void Pack(string path, string schema) => Pack(path, "Manifest-Version: 1.0\r\n", schema);

        internal static void Pack(string path, string manifest, string schemas, params (string ClassName, string Index)[] classes)
        {
            Directory.CreateDirectory(System.IO.Path.GetDirectoryName(path));
            using (var jar = new ZipArchive(File.Create(path), ZipArchiveMode.Create))
            {
                var entries = new List<(string, string)>
                {
                    ("META-INF/MANIFEST.MF", manifest), ("META-INF/services/org.collektive.frames.data.DataSchema", schemas),
                };
                foreach (var schema in schemas.Split('\n')) entries.Add(("META-INF/collektive/" + schema + ".bfbs", "binary form of " + schema));
                foreach (var (className, index) in classes)
                {
                    var name = className.TrimStart('-');
                    if (name == className) entries.Add((name.Replace('.', '/') + ".class", ""));
                    entries.Add(("META-INF/collektive/programs/" + name, index));
                }
                foreach (var (name, text) in entries)
                {
                    using (var writer = new StreamWriter(jar.CreateEntry(name).Open())) writer.Write(text);
                }
            }
        }
    }
}
