using System;
using System.Collections;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Numerics;
using System.Reflection;
using System.Text.RegularExpressions;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>Reads a JSON file strictly. A duplicate key, an unknown key or a value of another type is an error, whose message contains the line.</summary>
    internal sealed class JsonFile
    {
        private const int MaxBytes = 1 << 26;

        // Matches strings, comments, numbers and names. The last group matches text that begins like a number but is not a number in JSON.
        private static readonly Regex TokenPattern = new Regex(
            @"""[^""\\]*(\\.[^""\\]*)*""|'[^'\\]*(\\.[^'\\]*)*'|//[^\n]*|/\*.*?\*/|-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)?(?![\w.+-])|-Infinity"
                + @"|[\p{L}_$][\w.$-]*|(?<number>[0-9.+-][\w.+-]*)", RegexOptions.Singleline | RegexOptions.ExplicitCapture | RegexOptions.CultureInvariant);

        /// <summary>Numbers that Newtonsoft.Json writes as strings.</summary>
        private static readonly string[] NotFinite = { "NaN", "Infinity", "-Infinity" };

        private readonly string path;

        private JsonFile(string path, JObject root)
        {
            this.path = path;
            Root = root;
        }

        internal JObject Root { get; }

        internal static JsonFile Read(string path)
        {
            if (!RegularFile.Exists(path)) throw new ScenarioException("'" + path + "' is not a file: enter the path of a scenario file (JSON)");
            if (new FileInfo(path).Length > MaxBytes) throw new ScenarioException(path + ": the file is too large for a scenario or a manifest (over 64 MB)");
            var text = File.ReadAllText(path);
            // The reader skips null characters.
            var at = text.IndexOf('\0');
            if (at >= 0) throw new ScenarioException(path + ":" + LineAt(text, at) + ": not valid JSON: the file contains a null character");
            try
            {
                RejectDuplicateKeys(path, text);
                var root = Parse(text, LineInfoHandling.Load) as JObject;
                if (root == null) throw new ScenarioException(path + ": the file must contain one JSON object");
                return new JsonFile(path, root);
            }
            catch (JsonReaderException error)
            {
                throw new ScenarioException(path + ":" + error.LineNumber + ": not valid JSON: " + error.Message);
            }
        }

        private static int LineAt(string text, int index) => text.Substring(0, index).Split('\n').Length;

        /// <summary>Reads one value from a text.</summary>
        /// <exception cref="JsonReaderException">The text is not one JSON value.</exception>
        internal static JToken Parse(string text, LineInfoHandling lines = LineInfoHandling.Ignore)
        {
            // Rejects numbers such as 010 and 0x10, which the reader would read as 8 and 16.
            for (var match = TokenPattern.Match(text); match.Success; match = match.NextMatch())
            {
                if (!match.Groups["number"].Success) continue;
                var column = match.Index - text.LastIndexOf('\n', match.Index);
                throw new JsonReaderException("'" + match.Value + "' is not a JSON number", "", LineAt(text, match.Index), column, null);
            }
            var reader = Reader(text);
            var value = JToken.ReadFrom(reader, new JsonLoadSettings { LineInfoHandling = lines });
            // Throws if another value follows.
            while (reader.Read())
            {
            }
            return value;
        }

        internal void RejectUnknownKeys(JObject part, string place, IEnumerable<string> known)
        {
            foreach (var property in part.Properties())
            {
                if (known.Contains(property.Name)) continue;
                throw Error(property, "unknown key '" + place + property.Name + "'; known here: " + string.Join(", ", known));
            }
        }

        /// <summary>Returns an object in a part of the file, after checking that all its keys are known; an empty object if it is missing.</summary>
        internal JObject Part(JObject whole, string place, string key, IEnumerable<string> known)
        {
            var token = whole[key];
            if (token == null) return new JObject();
            if (!(token is JObject part))
                throw Error(token, NotOfType(token, place + key, typeof(JObject)) + "; its keys are: " + string.Join(", ", known));
            RejectUnknownKeys(part, place + key + ".", known);
            return part;
        }

        internal T Required<T>(JObject part, string key)
        {
            if (part[key] == null) throw new ScenarioException(path + ": the key '" + key + "' is missing");
            return Optional(part, key, default(T));
        }

        internal T Optional<T>(JObject part, string key, T otherwise)
        {
            var token = part[key];
            return token == null ? otherwise : (T)Convert(token, typeof(T), key);
        }

        /// <summary>Sets fields of an object from a part of the file. If a field contains an object, sets the fields of that object in the same way.</summary>
        internal void Fill(object target, IEnumerable<FieldInfo> fields, JObject part, string place)
        {
            foreach (var field in fields)
            {
                var token = part[field.Name];
                var key = place + field.Name;
                if (token == null) continue;
                if (!field.FieldType.IsClass || typeof(IEnumerable).IsAssignableFrom(field.FieldType))
                {
                    field.SetValue(target, Convert(token, field.FieldType, key));
                    continue;
                }
                var known = field.FieldType.GetFields(BindingFlags.Public | BindingFlags.Instance);
                var inner = Part(part, place, field.Name, known.Select(each => each.Name));
                Fill(field.GetValue(target), known, inner, key + ".");
            }
        }

        /// <summary>Converts a value to a .NET type. An integer type accepts only whole numbers in its range.</summary>
        internal object Convert(JToken token, Type type, string key)
        {
            var kind = token.Type;
            var number = kind == JTokenType.Integer || kind == JTokenType.Float;
            try
            {
                if (type == typeof(string) && kind == JTokenType.String) return (string)token;
                if (type == typeof(bool) && kind == JTokenType.Boolean) return (bool)token;
                if (type == typeof(int) && kind == JTokenType.Integer) return (int)token;
                if (type == typeof(long) && kind == JTokenType.Integer) return (long)token;
                if (type == typeof(ulong) && kind == JTokenType.Integer) return (ulong)token;
                if (type == typeof(float) && number && (!float.IsInfinity((float)Number(token)) || double.IsInfinity(Number(token))))
                    return (float)Number(token);
                if (type == typeof(double) && number) return Number(token);
                if ((type == typeof(float) || type == typeof(double)) && kind == JTokenType.String && NotFinite.Contains((string)token))
                    return System.Convert.ChangeType(double.Parse((string)token, CultureInfo.InvariantCulture), type);
                if (type == typeof(JObject) && kind == JTokenType.Object) return token;
                if (type == typeof(string[]) && kind == JTokenType.Array) return Strings((JArray)token, key).ToArray();
                if (type == typeof(List<string>) && kind == JTokenType.Array) return Strings((JArray)token, key);
                if (type.IsEnum && kind == JTokenType.String) return Enum.Parse(type, NameIn(type, (string)token));
            }
            catch (Exception error) when (error is OverflowException || error is ArgumentException)
            {
                // The value is out of the range of the type. The error below reports it.
            }
            if (type == typeof(float) && number || kind == JTokenType.Integer && (type == typeof(int) || type == typeof(long)))
                throw Error(token, "'" + key + "' is " + token.ToString(Formatting.None) + "; it must be between " + RangeOf(type));
            var names = type.IsEnum ? " (one of " + string.Join(", ", Enum.GetNames(type)) + ")" : "";
            throw Error(token, NotOfType(token, key, type) + names);
        }

        /// <summary>Returns an error with the path of the file and the line of a token.</summary>
        /// <param name="column">Column in the token's line, from 1; 0 if unknown.</param>
        internal ScenarioException Error(JToken token, string message, int column = 0)
        {
            var line = (IJsonLineInfo)token;
            var place = line.HasLineInfo() ? ":" + line.LineNumber + (column > 0 ? ":" + column : "") : "";
            return new ScenarioException(path + place + ": " + message);
        }

        private static string NotOfType(JToken token, string key, Type type) =>
            "'" + key + "' is " + token.ToString(Formatting.None) + "; it must be of type " + NameOf(type);

        /// <summary>Returns the name of the enum's value that equals a text, if necessary ignoring case, or an empty text.</summary>
        /// <remarks>Without this check, <c>Enum.Parse</c> would also accept numbers and lists of names.</remarks>
        private static string NameIn(Type type, string text) =>
            Enum.IsDefined(type, text) ? text : Array.Find(Enum.GetNames(type), name => name.Equals(text, StringComparison.OrdinalIgnoreCase)) ?? "";

        private List<string> Strings(JArray array, string key)
        {
            var strings = new List<string>();
            foreach (var item in array) strings.Add((string)Convert(item, typeof(string), key));
            return strings;
        }

        private static string RangeOf(Type type) => type == typeof(float) ? "-3.4E+38 and 3.4E+38"
            : type == typeof(int) ? int.MinValue + " and " + int.MaxValue : long.MinValue + " and " + long.MaxValue;

        /// <summary>Returns the name of a type for messages.</summary>
        internal static string NameOf(Type type)
        {
            if (type == typeof(int) || type == typeof(long)) return "whole number";
            if (type == typeof(ulong)) return "whole number from 0 to 2^64 - 1";
            if (type == typeof(float) || type == typeof(double)) return "number";
            if (type == typeof(string[]) || type == typeof(List<string>)) return "list of strings";
            if (type == typeof(bool)) return "true or false";
            if (type == typeof(string) || type.IsEnum) return "string";
            return type == typeof(JObject) ? "object" : type.Name + ", which scenarios cannot contain";
        }

        /// <summary>Returns the value in a form that <see cref="Convert"/> reads back; null for types that files cannot contain.</summary>
        internal static JToken Token(object value)
        {
            switch (value)
            {
                // A JValue would be written as a signed number.
                case ulong number: return new JRaw(number.ToString(CultureInfo.InvariantCulture));
                case Enum name: return Enum.IsDefined(name.GetType(), name) ? new JValue(name.ToString()) : null;
                case IEnumerable<string> strings when (value is string[] || value is List<string>) && !strings.Contains(null): return new JArray(strings);
                case string _:
                case bool _:
                case int _:
                case long _:
                case float _:
                case double _: return new JValue(value);
                default: return null;
            }
        }

        /// <summary>Returns a value as JSON whose numbers read back exactly.</summary>
        internal static string Text(JToken value)
        {
            var text = new StringWriter(CultureInfo.InvariantCulture);
            using (var writer = new ExactWriter(text)) value.WriteTo(writer);
            return text.ToString();
        }

        /// <summary>Returns the nearest double of a number. The conversion of large whole numbers to double does not round.</summary>
        private static double Number(JToken token) =>
            token is JValue value && value.Value is BigInteger large && ExactNumber.TryParse(large.ToString(), out var number) ? number : (double)token;

        private static JsonTextReader Reader(string text) => new ExactReader(text);

        private static void RejectDuplicateKeys(string path, string text)
        {
            var reader = Reader(text);
            var keys = new Stack<HashSet<string>>();
            while (reader.Read())
            {
                if (reader.TokenType == JsonToken.StartObject) keys.Push(new HashSet<string>());
                else if (reader.TokenType == JsonToken.EndObject) keys.Pop();
                else if (reader.TokenType == JsonToken.PropertyName && !keys.Peek().Add((string)reader.Value))
                {
                    throw new ScenarioException(path + ":" + reader.LineNumber + ": the key '" + reader.Value + "' occurs twice");
                }
            }
        }

        private sealed class ExactReader : JsonTextReader
        {
            private readonly string text;
            private readonly List<int> lineStarts = new List<int> { 0 };

            internal ExactReader(string text)
                : base(new StringReader(text))
            {
                this.text = text;
                DateParseHandling = DateParseHandling.None;
                foreach (Match end in Regex.Matches(text, "\r\n|\r|\n")) lineStarts.Add(end.Index + end.Length);
            }

            public override bool Read()
            {
                if (!base.Read()) return false;
                if (TokenType != JsonToken.Float) return true;
                var end = lineStarts[LineNumber - 1] + LinePosition;
                var start = end;
                while (start > 0 && "0123456789+-.eE".IndexOf(text[start - 1]) >= 0) start--;
                if (ExactNumber.TryParse(text.Substring(start, end - start), out var number)) SetToken(JsonToken.Float, number, false);
                return true;
            }
        }

        private sealed class ExactWriter : JsonTextWriter
        {
            internal ExactWriter(TextWriter text)
                : base(text)
            {
                Formatting = Formatting.Indented;
            }

            public override void WriteValue(double value)
            {
                var text = CsvText.Number(value);
                if (double.IsNaN(value) || double.IsInfinity(value)) base.WriteValue(value);
                else WriteRawValue(text.IndexOfAny(new[] { '.', 'E' }) < 0 ? text + ".0" : text);
            }

            public override void WriteValue(float value)
            {
                // Mono writes -0 as 0.
                if (value == 0) WriteValue((double)value);
                else base.WriteValue(value);
            }
        }
    }
}
