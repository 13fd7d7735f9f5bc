using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>The run that a manifest describes. It can be repeated and compared with the repetition.</summary>
    internal sealed class OriginalRun
    {
        internal const string ScenarioKey = "scenario";

        private readonly string path;
        private readonly JObject manifest;

        internal OriginalRun(JsonFile file, string path)
        {
            this.path = path;
            manifest = file.Root;
            File = file.Required<string>(manifest, "file");
            Folder = file.Required<string>(manifest, "folder");
            if (manifest["digest"] == null) throw new ScenarioException(path
                + ": the run was not completed and has no results to compare with: choose the manifest of a complete run");
            Ticks = file.Required<int>(manifest, "ticks");
            file.Required<string>(manifest, "digest");
            foreach (var key in new[] { "nodes", "errors" }) file.Required<long>(manifest, key);
            foreach (var key in new[] { "start", "end", "converged", "inputs", "versions" }) file.Required<JObject>(manifest, key);
            if (Ticks < 1) throw new ScenarioException(path + ": the run has no ticks to repeat: choose the manifest of a complete run");
        }

        /// <summary>Name of the run's scenario file.</summary>
        internal string File { get; }

        /// <summary>Folder to which the paths in the scenario are relative.</summary>
        internal string Folder { get; }

        /// <summary>Number of completed ticks. If the run was interrupted, it is smaller than in the scenario.</summary>
        internal int Ticks { get; }

        /// <summary>Returns whether a repetition has the same results as this run, and prints the result of the comparison.</summary>
        internal bool IsRepeatedBy(Manifest now)
        {
            var differences = new List<string>();
            foreach (var key in new[] { "ticks", "digest", "nodes", "errors", "start", "end", "converged" })
            {
                // The values are compared as text, because NaN is a string in files.
                if (Text(manifest[key]) != Text(now.Root[key])) differences.Add(key + " is " + Text(now.Root[key]) + ", previously " + Text(manifest[key]));
            }
            if (differences.Count == 0)
            {
                Console.WriteLine("repeated: " + Ticks + " ticks, digest " + Text(manifest["digest"]) + " and the metrics are equal to those in " + path);
                return true;
            }
            Console.Error.WriteLine("collektive: the run differs from the one in " + path + ": " + string.Join("; ", differences));
            return false;
        }

        /// <summary>Prints a line for each entry of "inputs" or "versions" that has changed since this run.</summary>
        internal void PrintDifferences(Manifest now, string key)
        {
            foreach (var property in ((JObject)now.Root[key]).Properties())
            {
                var before = manifest[key][property.Name];
                if (JToken.DeepEquals(before, property.Value)) continue;
                Console.Error.WriteLine(
                    "collektive: changed since the run of " + path + ": " + property.Name + " is " + Text(property.Value) + ", previously "
                        + (before == null ? "absent" : Text(before)));
            }
        }

        private static string Text(JToken token) => token.Type == JTokenType.String ? (string)token : token.ToString(Newtonsoft.Json.Formatting.None);
    }
}
