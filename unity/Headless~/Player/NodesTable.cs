using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using Collektive.Bridge;
using Collektive.Unity;
using UnityEngine;
using Schema = org.collektive.schema;

namespace Collektive.Headless
{
    /// <summary>
    /// nodes.csv: a row per node and interval with fields of the program's last answer, by their names in the schema, and <c>position</c>. A node without an
    /// answer has empty cells.
    /// </summary>
    internal sealed class NodesTable : IDisposable
    {
        private const string Position = "position";

        private readonly TextWriter writer;
        private readonly SimulationManager manager;
        private readonly List<Column> columns = new List<Column>();

        /// <param name="fields">Fields of the answers, and <c>position</c>.</param>
        internal NodesTable(string path, IEnumerable<string> fields, SimulationManager manager)
        {
            this.manager = manager;
            var answers = AnswerType(manager);
            foreach (var field in fields)
            {
                if (field == Position) columns.Add(new Column(field, null, typeof(Vector3)));
                else columns.Add(Find(answers, field));
            }
            writer = new StreamWriter(path);
            writer.Write("second,node," + string.Join(",", columns.Select(column => column.Header)) + "\n");
        }

        internal void Add(double second)
        {
            var start = second.ToString("0.######", CultureInfo.InvariantCulture) + ",";
            foreach (var node in manager.Nodes)
            {
                writer.Write(start);
                writer.Write(node.Id);
                var answer = node.Answer;
                foreach (var column in columns)
                    column.Write(writer, column.Member == null ? node.transform.position : answer == null ? null : column.Read(answer));
                writer.Write('\n');
            }
            writer.Flush();
        }

        public void Dispose() => writer.Dispose();

        private static Type AnswerType(SimulationManager manager)
        {
            var buffer = Schemas.Find(manager.Settings.schema).CreateActuators().GetType();
            while (!buffer.IsGenericType || buffer.GetGenericTypeDefinition() != typeof(ActuatorBuffer<>)) buffer = buffer.BaseType;
            return buffer.GetGenericArguments()[0];
        }

        private static Column Find(Type answers, string field)
        {
            var known = new List<string> { Position };
            foreach (var member in answers.GetMembers(BindingFlags.Public | BindingFlags.Instance))
            {
                var type = member is FieldInfo plain ? plain.FieldType : (member as PropertyInfo)?.PropertyType;
                if (type == null || !Column.CanHold(type)) continue;
                if (Plain(member.Name) == Plain(field)) return new Column(field, member, type);
                known.Add(member.Name);
            }
            throw new ScenarioException(
                "'outputs.nodes.fields': " + answers.Name + " has no field '" + field + "' that is a number, a string, true or false, or a vector; there are: "
                    + string.Join(", ", known));
        }

        /// <summary>Generated code has other capitals than the schema.</summary>
        private static string Plain(string name) => name.Replace("_", "").ToLowerInvariant();

        private sealed class Column
        {
            private const BindingFlags Any = BindingFlags.Public | BindingFlags.Instance | BindingFlags.IgnoreCase;

            // Of a vector; none for other types.
            private readonly MemberInfo[] parts;

            internal Column(string name, MemberInfo member, Type type)
            {
                Member = member;
                var names = PartsOf(type);
                type = Nullable.GetUnderlyingType(type) ?? type;
                parts = Array.ConvertAll(names, part => (MemberInfo)type.GetField(part, Any) ?? type.GetProperty(part, Any));
                Header = names.Length == 0 ? name : string.Join(",", names.Select(part => name + "." + part));
            }

            internal MemberInfo Member { get; }

            internal string Header { get; }

            internal static bool CanHold(Type type) => type.IsPrimitive || type.IsEnum || type == typeof(string) || PartsOf(type).Length > 0;

            internal object Read(object answer) => ValueOf(Member, answer);

            /// <summary>Writes a value with a comma before it, or before each part of a vector; empty cells for null.</summary>
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
                    if (value != null) writer.Write(Cell(ValueOf(part, value)));
                }
            }

            private static object ValueOf(MemberInfo member, object owner) =>
                member is FieldInfo field ? field.GetValue(owner) : ((PropertyInfo)member).GetValue(owner);

            private static string[] PartsOf(Type type)
            {
                type = Nullable.GetUnderlyingType(type) ?? type;
                if (type == typeof(Vector3) || type == typeof(Schema.Vector3Value) || type == typeof(Schema.Vector3)) return new[] { "x", "y", "z" };
                return type == typeof(Schema.Vector2Value) || type == typeof(Schema.Vector2) ? new[] { "x", "y" } : Array.Empty<string>();
            }

            private static string Cell(object value)
            {
                switch (value)
                {
                    case null: return "";
                    case bool truth: return truth ? "true" : "false";
                    case float number: return number.ToString("R", CultureInfo.InvariantCulture);
                    case double number: return number.ToString("R", CultureInfo.InvariantCulture);
                    case string text: return "\"" + text.Replace("\"", "\"\"") + "\"";
                    default: return Convert.ToString(value, CultureInfo.InvariantCulture);
                }
            }
        }
    }
}
