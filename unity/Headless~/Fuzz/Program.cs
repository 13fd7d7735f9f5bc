using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Xml.Linq;
using Collektive.Headless;

namespace Collektive.Fuzz
{
    /// <summary>
    /// Reads damaged scenario files and manifests. Each must be read, or rejected with a message that names the file. Arguments: corpus, folder for findings,
    /// seconds, seed, and optionally a file for JUnit XML. The files of the corpus are first read unchanged. The exit code is 1 if there are findings.
    /// </summary>
    internal static class Program
    {
        private static string work;

        private static int Main(string[] arguments)
        {
            var corpus = new List<byte[]>();
            var findings = 0;
            var runs = 0L;
            work = Path.Combine(Path.GetTempPath(), "collektive-fuzz-" + Process.GetCurrentProcess().Id);
            Directory.CreateDirectory(Path.Combine(work, "scene"));
            File.WriteAllText(Path.Combine(work, "light.fbs"), "");
            Directory.CreateDirectory(arguments[1]);
            foreach (var file in Directory.GetFiles(arguments[0])) corpus.Add(File.ReadAllBytes(file));
            foreach (var input in corpus) Count(Problem(input), input);
            var mutations = new Mutations(int.Parse(arguments[3]), corpus);
            var clock = Stopwatch.StartNew();
            var limit = double.Parse(arguments[2], System.Globalization.CultureInfo.InvariantCulture);
            while (clock.Elapsed.TotalSeconds < limit && findings < 20)
            {
                var input = mutations.Next();
                var (problem, isRead) = Read(input);
                // Inputs that are still valid scenarios reach more code.
                if (isRead && corpus.Count < 2000) corpus.Add(input);
                Count(problem, input);
            }
            Directory.Delete(work, true);
            Console.WriteLine("Done " + runs + " runs, " + findings + " findings");
            if (arguments.Length > 4)
            {
                var result = new XElement("testcase", new XAttribute("classname", "fuzz"), new XAttribute("name", "scenario files"));
                if (findings > 0) result.Add(new XElement("failure", new XAttribute("message", findings + " findings in " + arguments[1])));
                new XElement("testsuite", new XAttribute("name", "fuzz"), result).Save(arguments[4]);
            }
            return findings == 0 ? 0 : 1;

            void Count(string problem, byte[] input)
            {
                runs++;
                if (problem == null) return;
                var file = Path.Combine(arguments[1], "scenario-" + runs + ".json");
                File.WriteAllBytes(file, input);
                Console.WriteLine(file + ": " + problem);
                findings++;
            }
        }

        private static string Problem(byte[] input) => Read(input).Problem;

        private static (string Problem, bool IsRead) Read(byte[] input)
        {
            var file = Path.Combine(work, "scenario.json");
            File.WriteAllBytes(file, input);
            var start = ProcessorTime;
            try
            {
                var scenario = Scenario.Read(file, null, false);
                scenario.ToJson(scenario.Fields);
                return (Slow(start), true);
            }
            catch (ScenarioException error)
            {
                return (error.Message.Contains("scenario.json") ? Slow(start) : "the message does not name the file: " + error.Message, false);
            }
            catch (Exception error)
            {
                return (error.ToString(), false);
            }
        }

        /// <summary>Processor time of this process in seconds. Unlike elapsed time, it does not depend on other processes.</summary>
        private static double ProcessorTime
        {
            get
            {
                using (var process = Process.GetCurrentProcess()) return process.TotalProcessorTime.TotalSeconds;
            }
        }

        private static string Slow(double start)
        {
            var time = ProcessorTime - start;
            return time > 5 ? "it takes " + time + " s" : null;
        }
    }
}
