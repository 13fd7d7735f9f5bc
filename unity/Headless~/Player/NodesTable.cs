using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;
using UnityEngine;
using Schema = org.collektive.schema;

namespace Collektive.Headless
{
    /// <summary>
    /// Writes nodes.csv, which has a row per node and interval. The columns are fields of the node's last answer, with their names in the schema, and
    /// <c>position</c>. If a node has no answer, its cells are empty.
    /// </summary>
    internal sealed class NodesTable : IDisposable
    {
        private const string Position = "position";

        private readonly TextWriter writer;
        private readonly SimulationManager manager;
        private readonly List<Column> columns;

        /// <param name="fields">Names of fields of the answers, or <c>position</c>.</param>
        internal NodesTable(string path, IEnumerable<string> fields, SimulationManager manager)
        {
            this.manager = manager;
            columns = ColumnsOf(Schemas.Find(manager.Settings.schema), fields);
            writer = ResultFile.Create(path);
            writer.Write("second,node," + string.Join(",", columns.SelectMany(column => column.Names)) + "\n");
        }

        /// <summary>Throws a <see cref="ScenarioException"/> if a table of these fields cannot be written.</summary>
        internal static void Check(DataSchema schema, IEnumerable<string> fields) => ColumnsOf(schema, fields);

        /// <summary>Type of each column. Tables of several runs are merged with these types.</summary>
        internal JObject Types => new JObject(columns.SelectMany(column => column.Names.Select(name => new JProperty(name, column.Type))));

        internal void Add(double second)
        {
            var start = second.ToString("0.######", CultureInfo.InvariantCulture) + ",";
            foreach (var node in manager.Nodes)
            {
                writer.Write(start);
                writer.Write(node.Id);
                var answer = node.Answer;
                foreach (var column in columns)
                    column.Write(writer, column.Field == null ? node.transform.position : answer == null ? null : column.Field.Read(answer));
                writer.Write('\n');
            }
            writer.Flush();
        }

        internal void RequireInPlace() => ResultFile.RequireInPlace(writer);

        public void Dispose() => writer.Dispose();

        private static List<Column> ColumnsOf(DataSchema schema, IEnumerable<string> fields)
        {
            var answers = AnswerField.Of(schema);
            var columns = fields.Select(field => field == Position ? PositionOf(answers) : Find(answers, field)).ToList();
            if (columns.GroupBy(column => column.Field?.Name).FirstOrDefault(group => group.Count() > 1) is IGrouping<string, Column> repeated)
                throw new ScenarioException("'outputs.nodes.fields' contains a field twice: " + string.Join(", ", repeated.Select(column => column.Given)));
            return columns;
        }

        private static Column PositionOf(List<AnswerField> answers)
        {
            if (answers.Exists(field => Normalize(field.Name) == Position))
                throw new ScenarioException("'outputs.nodes.fields': 'position' is both the node's position and a field of the answers: rename the field");
            return new Column(Position, null, typeof(Vector3));
        }

        private static Column Find(List<AnswerField> answers, string wanted)
        {
            var known = answers.FindAll(field => Column.IsSupported(field.Type));
            var found = known.Find(field => field.Name == AnswerField.GeneratedName(wanted))
                ?? known.Find(field => Normalize(field.Name) == Normalize(wanted))
                ?? throw new ScenarioException(
                    "'outputs.nodes.fields': the answers have no field '" + wanted + "' of type number, string, boolean or vector; the fields are: "
                        + string.Join(", ", known.Select(field => field.Name).Prepend(Position)));
            return new Column(wanted, found, found.Type);
        }

        /// <summary>Returns a name in a form in which names in the schema equal those in generated code.</summary>
        private static string Normalize(string name) => name.Replace("_", "").ToLowerInvariant();

        private sealed class Column
        {
            private const BindingFlags MemberFlags = BindingFlags.Public | BindingFlags.Instance | BindingFlags.IgnoreCase;

            // The coordinates of a vector; empty for other types.
            private readonly MemberInfo[] parts;

            /// <param name="field">The field of the answers; null for the node's position.</param>
            internal Column(string name, AnswerField field, Type type)
            {
                Given = name;
                Field = field;
                var names = PartsOf(type);
                type = Nullable.GetUnderlyingType(type) ?? type;
                parts = Array.ConvertAll(names, part => (MemberInfo)type.GetField(part, MemberFlags) ?? type.GetProperty(part, MemberFlags));
                // The table's own columns have these names.
                var only = name == "second" || name == "node" ? "field." + name : name;
                Names = names.Length == 0 ? new[] { only } : Array.ConvertAll(names, part => name + "." + part);
                Type = names.Length > 0 ? "float64" : TypeName(type);
            }

            /// <summary>Name of the field in the scenario.</summary>
            internal string Given { get; }

            internal AnswerField Field { get; }

            internal string[] Names { get; }

            internal string Type { get; }

            internal static bool IsSupported(Type type) => type.IsPrimitive || type.IsEnum || type == typeof(string) || PartsOf(type).Length > 0;

            /// <summary>Writes the cell of a value, or a cell for each part of a vector. Writes a comma before each cell. Cells for null are empty.</summary>
            internal void Write(TextWriter writer, object value)
            {
                if (parts.Length == 0)
                {
                    writer.Write(',');
                    writer.Write(Cell(value));
                }
                foreach (var part in parts)
                {
                    writer.Write(',');
                    if (value != null) writer.Write(Cell(AnswerField.ValueOf(part, value)));
                }
            }

            private static string[] PartsOf(Type type)
            {
                type = Nullable.GetUnderlyingType(type) ?? type;
                if (type == typeof(Vector3) || type == typeof(Schema.Vector3Value) || type == typeof(Schema.Vector3)) return new[] { "x", "y", "z" };
                return type == typeof(Schema.Vector2Value) || type == typeof(Schema.Vector2) ? new[] { "x", "y" } : Array.Empty<string>();
            }

            private static string TypeName(Type type)
            {
                if (type == typeof(string) || type.IsEnum) return "string";
                if (type == typeof(bool)) return "bool";
                if (type == typeof(float) || type == typeof(double)) return "float64";
                return type == typeof(ulong) ? "uint64" : "int64";
            }

            private static string Cell(object value)
            {
                switch (value)
                {
                    case null: return "";
                    case bool truth: return truth ? "true" : "false";
                    case 0f: return CsvText.Number((float)value);
                    case float number: return number.ToString("R", CultureInfo.InvariantCulture);
                    case double number: return CsvText.Number(number);
                    case string text: return CsvText.Quoted(text);
                    case Enum name: return CsvText.Quoted(name.ToString());
                    default: return Convert.ToString(value, CultureInfo.InvariantCulture);
                }
            }
        }
    }
}
