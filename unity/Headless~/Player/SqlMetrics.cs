using System;
using System.Collections.Generic;
using System.Linq;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// The metrics of a scenario that are SQL. Each is an aggregate over the table of nodes, which has a row per node in the order of ids. A metric without a
    /// value, for example the mean of zero nodes, is NaN.
    /// </summary>
    internal sealed class SqlMetrics : IDisposable
    {
        private const string Before = "SELECT (";
        // This part begins on a new line, so that a comment at the end of the user's text cannot hide it.
        private const string After = "\n) FROM " + Sqlite.Table;

        /// <summary>Number of rows that one statement inserts.</summary>
        private const int RowsPerInsert = 64;

        private readonly List<Metric> metrics = new List<Metric>();
        private readonly List<string> names = new List<string>();
        private readonly JsonFile file;
        private readonly NodeColumns columns;
        private readonly Sqlite database;
        private readonly Sqlite.Statement clear, insert, insertMany;
        private readonly double[] rows;

        /// <summary>Prepares all metrics, and checks them on an empty table and on tables with two nodes.</summary>
        /// <param name="limitMs">Milliseconds that a metric may take.</param>
        internal SqlMetrics(JsonFile file, JObject root, DataSchema schema, int limitMs)
        {
            this.file = file;
            var queries = root.Properties().Where(property => !FunctionMetrics.IsFunction(property)).ToList();
            if (queries.Count == 0) return;
            columns = new NodeColumns(schema);
            foreach (var property in queries)
            {
                if (columns.AddSchemaNames(property.Value.ToString()) is string problem)
                    throw file.Error(property.Value, "'metrics." + property.Name + "': " + problem);
            }
            database = new Sqlite(limitMs);
            try
            {
                database.Execute("PRAGMA journal_mode = OFF; CREATE TABLE " + Sqlite.Table + " (" + columns.Definitions + ")");
                var read = new SortedSet<string>(StringComparer.OrdinalIgnoreCase);
                foreach (var property in queries) metrics.Add(Prepare(property, read));
                columns.Use(read);
                clear = database.Prepare("DELETE FROM " + Sqlite.Table);
                insert = Insertion(1);
                insertMany = Insertion(RowsPerInsert);
                rows = new double[RowsPerInsert * columns.Width];
                foreach (var metric in metrics) RequireAggregate(metric);
            }
            catch
            {
                Dispose();
                throw;
            }
        }

        internal IReadOnlyList<string> Names => names;

        /// <summary>Requests the data that the metrics need, beginning with the next tick.</summary>
        internal void Begin(SimulationManager manager) => manager.Simulation.MeasuresMessages = columns?.MeasuresMessages == true;

        /// <summary>Reads the sensor data and messages of a tick.</summary>
        internal void Ticked(SimulationManager manager) => columns?.Ticked(manager);

        /// <summary>Evaluates the metrics at the current time, and writes their values to an array, starting at an index.</summary>
        internal void Measure(SimulationManager manager, double[] values, int first)
        {
            if (metrics.Count == 0) return;
            Fill(manager);
            for (var i = 0; i < metrics.Count; i++) values[first + i] = Evaluate(metrics[i]) ?? double.NaN;
        }

        public void Dispose()
        {
            foreach (var metric in metrics) metric.Query.Dispose();
            clear?.Dispose();
            insert?.Dispose();
            insertMany?.Dispose();
            database?.Dispose();
        }

        private void Fill(SimulationManager manager)
        {
            database.Execute("BEGIN");
            clear.Execute(rows, 0);
            columns.Begin(manager);
            var nodes = manager.Nodes;
            for (var next = 0; next < nodes.Count;)
            {
                var count = nodes.Count - next >= RowsPerInsert ? RowsPerInsert : 1;
                for (var i = 0; i < count; i++) columns.Read(manager, nodes[next++], rows, i * columns.Width);
                (count == 1 ? insert : insertMany).Execute(rows, count * columns.Width);
            }
            database.Execute("COMMIT");
        }

        private Sqlite.Statement Insertion(int rows)
        {
            var used = columns.Used.Select(NodeColumns.Quoted).ToList();
            // An INSERT needs at least one column, even if the metrics use none.
            var row = used.Count == 0 ? "(NULL)" : "(" + string.Join(",", used.Select(name => "?")) + ")";
            return database.Prepare("INSERT INTO " + Sqlite.Table + " (" + (used.Count == 0 ? "id" : string.Join(",", used)) + ") VALUES "
                + string.Join(",", Enumerable.Repeat(row, rows)));
        }

        private Metric Prepare(JProperty property, ISet<string> read)
        {
            var sql = (string)file.Convert(property.Value, typeof(string), "metrics." + property.Name);
            names.Add(property.Name);
            if (property.Name.Trim().Length == 0) throw file.Error(property, "'metrics': a metric needs a name");
            try
            {
                return new Metric(property, database.PrepareQuery(Before + sql + After, read));
            }
            catch (SqlException error)
            {
                throw Error(property, error);
            }
        }

        /// <summary>
        /// Throws an exception if a metric is not an aggregate. An aggregate has one row even without nodes, and the same value for both orders of two nodes.
        /// SQLite itself accepts columns outside of aggregate functions, and reads them from any node.
        /// </summary>
        private void RequireAggregate(Metric metric)
        {
            clear.Execute(rows, 0);
            if (Evaluate(metric) == null && !ReplaceBySubqueries(metric))
            {
                throw file.Error(
                    metric.Property,
                    "'metrics." + metric.Property.Name + "' is not an aggregate: it needs a function over all nodes, such as avg(...), sum(...) or count(*)");
            }
            // Conditions such as sum(flag) = 1 or sum(category = id) = 1 hold in the second or third table only.
            if (IsSymmetric(metric, column => column + 1, column => 3 * column + 5) && IsSymmetric(metric, column => 0, column => 1)
                && IsSymmetric(metric, column => 0, column => column + 1)) return;
            throw file.Error(
                metric.Property,
                "'metrics." + metric.Property.Name + "' depends on the order of nodes: write each column in a function over all nodes, such as avg(...)");
        }

        /// <summary>Returns whether a metric has the same value for both orders of two nodes.</summary>
        private bool IsSymmetric(Metric metric, params Func<int, double>[] nodes)
        {
            var value = new double[2];
            for (var order = 0; order < 2; order++)
            {
                clear.Execute(rows, 0);
                for (var node = 0; node < 2; node++)
                {
                    for (var column = 0; column < columns.Width; column++) rows[column] = nodes[node ^ order](column);
                    insert.Execute(rows, columns.Width);
                }
                value[order] = Evaluate(metric) ?? double.NaN;
            }
            return value[0].Equals(value[1]);
        }

        /// <summary>Evaluates a metric that consists of subqueries without the outer table, so that it has one row. Returns whether this is possible.</summary>
        private bool ReplaceBySubqueries(Metric metric)
        {
            var sql = (string)metric.Property.Value;
            if (sql.IndexOf("select", StringComparison.OrdinalIgnoreCase) < 0) return false;
            try
            {
                // In WHERE, SQLite rejects aggregates and window functions outside of subqueries.
                database.PrepareQuery("SELECT 1 WHERE (" + sql + "\n)", null).Dispose();
                var query = database.PrepareQuery(Before + sql + "\n)", null);
                metric.Query.Dispose();
                metric.Query = query;
                return true;
            }
            catch (SqlException)
            {
                return false;
            }
        }

        private double? Evaluate(Metric metric)
        {
            try
            {
                return metric.Query.Query();
            }
            catch (SqlException error)
            {
                throw Error(metric.Property, error);
            }
        }

        private ScenarioException Error(JProperty property, SqlException error)
        {
            var sql = (string)property.Value;
            var at = error.CharacterIn(sql, Before.Length);
            return file.Error(
                property.Value, "'metrics." + property.Name + "': " + error.Describe(sql, Before.Length, string.Join(", ", columns.Names)),
                at >= 0 ? ColumnOf(property.Value, sql, at) : 0);
        }

        /// <summary>Returns the column of a character in the file's line; 0 if the text in the file contains escapes.</summary>
        private static int ColumnOf(IJsonLineInfo token, string text, int character)
        {
            if (!token.HasLineInfo() || text.Any(letter => letter < ' ' || letter == '"' || letter == '\\')) return 0;
            // LinePosition is the end of the token, after the closing quote.
            return Math.Max(0, token.LinePosition - text.Length + character);
        }

        private sealed class Metric
        {
            internal Metric(JProperty property, Sqlite.Statement query)
            {
                Property = property;
                Query = query;
            }

            internal JProperty Property { get; }

            internal Sqlite.Statement Query { get; set; }
        }
    }
}
