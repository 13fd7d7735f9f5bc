using System;
using System.Collections.Generic;
using System.Linq.Expressions;
using System.Reflection;
using System.Text;
using System.Text.RegularExpressions;
using Collektive.Bridge;
using Collektive.Unity;
using UnityEngine;

namespace Collektive.Headless
{
    /// <summary>
    /// The columns of the table of nodes, from which SQL metrics are computed. The first columns contain data about each node and its last message. The others
    /// contain the numbers, booleans and enums of its last answer and of the sensor data of its last round, with their names in the schema.
    /// </summary>
    internal sealed class NodeColumns
    {
        /// <summary>Maximum depth of nested fields. It is limited, because a table may contain itself as a field.</summary>
        private const int MaxDepth = 3;

        private const BindingFlags Public = BindingFlags.Public | BindingFlags.Instance;

        private readonly List<Column> columns = new List<Column>();
        private readonly Dictionary<string, Column> byName = new Dictionary<string, Column>(StringComparer.OrdinalIgnoreCase);
        private readonly Reader answers;
        private readonly Reader sensors;
        private readonly List<Column> used = new List<Column>();
        // By column and id. With the tick, nodes do not get the values of an earlier node that had the same id.
        private (double Value, ulong Tick)[][] kept = Array.Empty<(double, ulong)[]>();
        private int[] degrees = Array.Empty<int>();

        internal NodeColumns(DataSchema schema)
        {
            foreach (var name in new[] { "id", "time", "degree", "x", "y", "z" }) Add("", name, Kind.Node, columns.Count, "");
            foreach (var name in new[] { "message_values", "message_bytes" }) Add("", name, Kind.Message, columns.Count, "");
            answers = Reader.Of(typeof(AnswerReader<>), typeof(ActuatorBuffer<>), schema.CreateActuators());
            sensors = Reader.Of(typeof(SensorReader<>), typeof(SensorBuffer<>), schema.CreateSensors());
            // Fields whose names in the schema equal those of their columns come first: "xy" is the column of xy, not of x_y, which is XY in generated code,
            // and "target_x" is the column of target_x, not of the x of target, whose name contains an underscore here.
            foreach (var isExact in new[] { true, false })
            {
                AddFields(answers, Kind.Answer, "answer_", isExact);
                AddFields(sensors, Kind.Sensor, "sensor_", isExact);
            }
        }

        /// <summary>Names of all columns.</summary>
        internal IEnumerable<string> Names
        {
            get
            {
                foreach (var column in columns) yield return column.Name;
            }
        }

        /// <summary>
        /// Adds names of the schema that a query uses and that differ from those of the columns, such as is_a_leader for IsALeader. Returns the problem of a
        /// name with which SQL, which ignores case, would read another field, or null.
        /// </summary>
        internal string AddSchemaNames(string query)
        {
            foreach (Match word in Regex.Matches(query, @"\w*[^\W_]\w*"))
            {
                var column = Find(word.Value, StringComparison.Ordinal);
                if (!byName.TryGetValue(word.Value, out var known))
                {
                    column = column ?? Find(word.Value, StringComparison.OrdinalIgnoreCase);
                    if (column != null) byName.Add(word.Value, column);
                }
                else if (column != null && column != known && known.Name != word.Value && char.IsLower(word.Value[0]))
                {
                    return "'" + word.Value + "' is ambiguous, because SQL ignores case: write " + column.Name + " or " + known.Name;
                }
            }
            return null;
        }

        /// <summary>Names of the columns that metrics use, in the order of <see cref="Read"/>.</summary>
        internal IEnumerable<string> Used
        {
            get
            {
                foreach (var column in used) yield return column.Name;
            }
        }

        /// <summary>Number of columns that metrics use.</summary>
        internal int Width => used.Count;

        /// <summary>Definitions of the columns in SQL. Names can also be written in Kotlin's camel case.</summary>
        internal string Definitions
        {
            get
            {
                var definitions = new List<string>();
                foreach (var column in columns) definitions.Add(Quoted(column.Name) + " REAL");
                foreach (var alias in byName)
                    if (alias.Key != alias.Value.Name) definitions.Add(Quoted(alias.Key) + " REAL AS (" + Quoted(alias.Value.Name) + ")");
                return string.Join(", ", definitions);
            }
        }

        internal static string Quoted(string name) => "\"" + name + "\"";

        /// <summary>Sets the columns that metrics use. <see cref="Read"/> reads only these.</summary>
        internal void Use(IEnumerable<string> names)
        {
            foreach (var name in names)
                if (byName.TryGetValue(name, out var column) && !used.Contains(column)) used.Add(column);
            kept = new (double, ulong)[used.Count][];
            for (var i = 0; i < used.Count; i++) kept[i] = Array.Empty<(double, ulong)>();
        }

        /// <summary>Whether metrics use the sizes of messages.</summary>
        internal bool MeasuresMessages => used.Exists(column => column.Kind == Kind.Message);

        /// <summary>Copies the sensor data and messages of the nodes that were due in a tick, because the next tick overwrites them.</summary>
        internal void Ticked(SimulationManager manager)
        {
            var simulation = manager.Simulation;
            for (var i = 0; i < used.Count; i++)
            {
                if (!used[i].IsKept) continue;
                Grow(ref kept[i], simulation.IdCapacity);
                if (used[i].Kind == Kind.Sensor)
                {
                    sensors.ReadDue(simulation, used[i].Index, kept[i]);
                    continue;
                }
                var areBytes = used[i].Name == "message_bytes";
                var nodes = simulation.Answer.Nodes;
                var messages = simulation.Answer.Messages;
                for (var k = 0; k < messages.Length; k++) kept[i][nodes[k]] = (areBytes ? messages[k].Bytes : messages[k].Values, simulation.Tick);
            }
        }

        /// <summary>Prepares the data of all nodes. Call this method before <see cref="Read"/>.</summary>
        internal void Begin(SimulationManager manager)
        {
            var capacity = manager.Simulation.IdCapacity;
            for (var i = 0; i < used.Count; i++)
                if (used[i].IsKept) Grow(ref kept[i], capacity);
            if (!used.Exists(column => column.Name == "degree")) return;
            Grow(ref degrees, capacity);
            Array.Clear(degrees, 0, degrees.Length);
            foreach (ref var pair in manager.Simulation.PresentLinks.Pairs)
            {
                if (pair.Up.References > 0) degrees[pair.High]++;
                if (pair.Down.References > 0) degrees[pair.Low]++;
            }
        }

        /// <summary>Reads the values of a node into an array, starting at an index; NaN for missing values.</summary>
        internal void Read(SimulationManager manager, Node node, double[] values, int first)
        {
            var hasAnswer = answers.Load(node);
            var position = node.transform.position;
            for (var i = 0; i < used.Count; i++)
            {
                var column = used[i];
                values[first + i] = column.Kind == Kind.Node ? Value(manager, node, position, column.Index)
                    : column.Kind == Kind.Answer ? hasAnswer ? answers.Value(column.Index) : double.NaN
                    : kept[i][node.Id].Tick > node.JoinTick ? kept[i][node.Id].Value : double.NaN;
            }
        }

        private double Value(SimulationManager manager, Node node, Vector3 position, int index)
        {
            switch (index)
            {
                case 0: return node.Id;
                case 1: return manager.SimulatedTime;
                case 2: return degrees[node.Id];
                case 3: return position.x;
                case 4: return position.y;
                default: return position.z;
            }
        }

        private void AddFields(Reader reader, Kind kind, string prefix, bool isExact)
        {
            for (var i = 0; i < reader.Fields.Count; i++)
            {
                var name = SnakeCase(reader.Fields[i]);
                if (AnswerField.GeneratedName(name) == reader.Fields[i] == isExact)
                    Add(byName.ContainsKey(name) ? prefix : "", name, kind, i, reader.Fields[i]);
            }
        }

        private void Add(string prefix, string name, Kind kind, int index, string generated)
        {
            name = prefix + name;
            if (byName.ContainsKey(name)) return;
            var column = new Column { Prefix = prefix, Name = name, Generated = AnswerField.GeneratedName(generated), Kind = kind, Index = index };
            columns.Add(column);
            byName.Add(name, column);
        }

        private Column Find(string name, StringComparison comparison)
        {
            var generated = AnswerField.GeneratedName(name);
            return columns.Find(
                each => generated.Equals(each.Generated, comparison) || generated.Equals(AnswerField.GeneratedName(each.Prefix + each.Generated), comparison));
        }

        private static void Grow<T>(ref T[] array, int count)
        {
            if (count > array.Length) Array.Resize(ref array, Math.Max(count, 2 * array.Length));
        }

        /// <summary>Returns the schema's name of a field of generated code.</summary>
        private static string SnakeCase(string name)
        {
            var text = new StringBuilder();
            for (var i = 0; i < name.Length; i++)
            {
                if (char.IsUpper(name[i]) && i > 0 && name[i - 1] != '_' && !char.IsUpper(name[i - 1])) text.Append('_');
                text.Append(char.ToLowerInvariant(name[i]));
            }
            return text.ToString();
        }

        private enum Kind
        {
            Node,
            Message,
            Answer,
            Sensor,
        }

        private sealed class Column
        {
            internal string Prefix;
            internal string Name;

            /// <summary>Name in generated code, without underscores; empty for data about nodes.</summary>
            internal string Generated;
            internal Kind Kind;
            internal int Index;

            /// <summary>Whether the values must be kept, because the next tick overwrites them.</summary>
            internal bool IsKept => Kind == Kind.Sensor || Kind == Kind.Message;
        }

        /// <summary>Reads fields of generated types as numbers, without boxing.</summary>
        private abstract class Reader
        {
            internal List<string> Fields { get; } = new List<string>();

            internal static Reader Of(Type reader, Type generic, object buffer)
            {
                var type = buffer.GetType();
                while (!type.IsGenericType || type.GetGenericTypeDefinition() != generic) type = type.BaseType;
                return (Reader)Activator.CreateInstance(reader.MakeGenericType(type.GetGenericArguments()[0]), true);
            }

            internal virtual bool Load(Node node) => false;

            internal virtual double Value(int field) => double.NaN;

            internal virtual void ReadDue(Simulation simulation, int field, (double Value, ulong Tick)[] byId)
            {
            }
        }

        private abstract class Reader<T> : Reader
        {
            protected readonly List<Func<T, double>> Getters = new List<Func<T, double>>();

            protected Reader()
            {
                var data = Expression.Parameter(typeof(T));
                Add(data, data, typeof(T), "", 0);
            }

            private void Add(ParameterExpression data, Expression owner, Type type, string prefix, int depth)
            {
                // Members are in the order of the schema.
                foreach (var member in type.GetMembers(Public))
                {
                    if (!(member is FieldInfo) && (member as PropertyInfo)?.GetIndexParameters().Length != 0) continue;
                    var value = Expression.MakeMemberAccess(owner, member);
                    var inner = Nullable.GetUnderlyingType(value.Type) ?? value.Type;
                    if (inner.IsEnum || inner.IsPrimitive && inner != typeof(char))
                    {
                        Fields.Add(prefix + member.Name);
                        Getters.Add(Expression.Lambda<Func<T, double>>(Number(value, value.Type, inner), data).Compile());
                    }
                    else if (inner.IsValueType && inner.Namespace != "Collektive.FlatBuffers" && inner.Namespace != "System" && depth < MaxDepth
                        && inner != type)
                    {
                        if (inner == value.Type) Add(data, value, inner, prefix + member.Name + "_", depth + 1);
                        else AddOptional(data, value, inner, prefix + member.Name + "_", depth + 1);
                    }
                }
            }

            /// <summary>Adds the fields of a struct or table that may be missing.</summary>
            private void AddOptional(ParameterExpression data, Expression value, Type inner, string prefix, int depth)
            {
                var first = Getters.Count;
                Add(data, Expression.Property(value, "Value"), inner, prefix, depth);
                var exists = Expression.Lambda<Func<T, bool>>(Expression.Property(value, "HasValue"), data).Compile();
                for (var i = first; i < Getters.Count; i++)
                {
                    var get = Getters[i];
                    Getters[i] = owner => exists(owner) ? get(owner) : double.NaN;
                }
            }

            private static Expression Number(Expression value, Type type, Type inner)
            {
                if (inner != type)
                {
                    return Expression.Condition(
                        Expression.Property(value, "HasValue"), Number(Expression.Property(value, "Value"), inner, inner), Expression.Constant(double.NaN));
                }
                if (inner == typeof(bool)) return Expression.Condition(value, Expression.Constant(1.0), Expression.Constant(0.0));
                return Expression.Convert(inner.IsEnum ? Expression.Convert(value, Enum.GetUnderlyingType(inner)) : value, typeof(double));
            }
        }

        private sealed class AnswerReader<T> : Reader<T>
        {
            private T answer;

            internal override bool Load(Node node) => node.TryGetAnswer(out answer);

            internal override double Value(int field) => Getters[field](answer);
        }

        private sealed class SensorReader<T> : Reader<T>
        {
            internal override void ReadDue(Simulation simulation, int field, (double Value, ulong Tick)[] byId)
            {
                var get = Getters[field];
                var items = ((SensorBuffer<T>)simulation.SensorData).Items;
                for (var i = 0; i < simulation.DueCount; i++) byId[simulation.DueId(i)] = (get(items[i]), simulation.Tick);
            }
        }
    }
}
