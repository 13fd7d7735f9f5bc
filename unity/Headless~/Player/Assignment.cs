using System;
using System.Linq;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>A value that replaces the value of a scenario key. It is from <c>--set KEY=VALUE</c> or from a sweep.</summary>
    internal sealed class Assignment
    {
        private const string Fields = "fields";
        private const string Parameters = "parameters";

        private readonly string[] path;
        private readonly JToken value;

        /// <param name="key">Names of nested keys, separated by dots.</param>
        internal Assignment(string key, JToken value)
        {
            Key = key;
            this.value = value;
            path = Path(key);
        }

        internal string Key { get; }

        /// <summary>
        /// Reads <c>KEY=VALUE</c>. A key that is not a key of scenarios is a field of the scene. The value of a field remains text until its type is known.
        /// </summary>
        /// <param name="field">For a field, <c>FIELD=VALUE</c>; otherwise null.</param>
        /// <returns>The assignment; null for a field.</returns>
        internal static Assignment Parse(string text, out string field)
        {
            field = null;
            var equals = text.IndexOf('=');
            if (equals <= 0) throw new ScenarioException("--set " + text + ": write it as --set KEY=VALUE");
            var key = text.Substring(0, equals);
            if (key.StartsWith(Fields + ".", StringComparison.Ordinal)) field = text.Substring(Fields.Length + 1);
            else if (!Scenario.Keys.Contains(key.Split('.')[0])) field = text;
            // A field of an object is set like a key, because its type is known only when the scene is loaded.
            if (field != null && NameOf(field).Contains("."))
            {
                var nested = OfField(field);
                field = null;
                return nested;
            }
            if (field != null) return null;
            var given = text.Substring(equals + 1);
            var value = Json(given);
            // The type of a parameter is known only when the programs are loaded. A text parameter must keep "1.0", which is a number in JSON.
            if (key.StartsWith(Parameters + ".", StringComparison.Ordinal) && (value.Type == JTokenType.Integer || value.Type == JTokenType.Float))
                value = new JValue(given);
            return new Assignment(key, value);
        }

        /// <summary>Converts <c>FIELD=VALUE</c> for a field of the scene to an assignment. The value is JSON or a string.</summary>
        internal static Assignment OfField(string field) =>
            new Assignment(Fields + "." + NameOf(field), Json(field.Substring(field.IndexOf('=') + 1)));

        /// <summary>Returns whether this assignment changes the value that an earlier <c>FIELD=VALUE</c> has set.</summary>
        internal bool Changes(string field) => Key == Fields || Key.StartsWith(Fields + "." + NameOf(field) + ".", StringComparison.Ordinal);

        /// <summary>Puts the value into a scenario.</summary>
        internal void Apply(JObject root)
        {
            var part = root;
            for (var i = 0; i < path.Length - 1; i++)
            {
                if (part[path[i]] == null) part.Add(path[i], new JObject());
                part = part[path[i]] as JObject
                    ?? throw new ScenarioException("'" + Key + "' cannot be set: '" + string.Join(".", path.Take(i + 1)) + "' is not an object");
            }
            part[path[path.Length - 1]] = value;
        }

        private static string NameOf(string field) => field.Substring(0, field.IndexOf('='));

        /// <summary>Splits a key into names. Names of programs and metrics may contain dots, but names of parameters cannot.</summary>
        private static string[] Path(string key)
        {
            var names = key.Split('.');
            var last = names[names.Length - 1];
            var isBand = names[0] == "converged" && (last == "from" || last == "to" || last == "seconds");
            if (names.Length > 3 && (names[0] == Parameters || isBand))
                return new[] { names[0], string.Join(".", names.Skip(1).Take(names.Length - 2)), last };
            return names.Length > 2 && (names[0] == "metrics" || names[0] == "converged" && !isBand)
                ? new[] { names[0], string.Join(".", names.Skip(1)) } : names;
        }

        /// <summary>Reads a value of the command line as JSON. Strings need no quotes.</summary>
        private static JToken Json(string text)
        {
            try
            {
                return JsonFile.Parse(text);
            }
            catch (JsonReaderException)
            {
                return new JValue(text);
            }
        }
    }
}
