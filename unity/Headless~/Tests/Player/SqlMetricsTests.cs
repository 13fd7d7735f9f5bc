using System;
using System.IO;
using System.Runtime.InteropServices;
using Collektive.Bridge;
using Collektive.Headless.Tests.Simulation;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Collektive.Headless.Tests.Player
{
    /// <summary>Tests metrics in SQL. They are untrusted, so they must be able to read only the table of nodes.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class SqlMetricsTests : SimulationFixture
    {
        private const int LimitMs = 100;

        /// <summary>The column of the metric's first character in the file that <see cref="Make"/> writes.</summary>
        private const int FirstColumn = 11;

        private readonly string path = Path.Combine(Path.GetTempPath(), "collektive-metrics-" + Guid.NewGuid() + ".json");

        [TearDown]
        public void DeleteFile() => File.Delete(path);

        [TestCase("avg(hrd)", 4, "no such column: hrd, at character 5 of 'avg(hrd)'; columns: id, time, degree, x, y, z, message_values, message_bytes, "
            + "value, heard, sensor_value")]
        [TestCase("avg(\"hrd\")", -1, "no such column: \"hrd\"")]
        [TestCase("avg(heard", 9, "'avg(heard' ends too early")]
        [TestCase("", 0, "'' ends too early")]
        [TestCase("avg(heard) +* x", 12, "near \"*\": syntax error, at character 13")]
        [TestCase("average(heard)", 0, "no such function: average, at character 1")]
        [TestCase("avg(heard, x)", 0, "wrong number of arguments to function avg()")]
        [TestCase("avg(avg(heard))", 4, "misuse of aggregate function avg()")]
        [TestCase("heard", -1, "'metrics.m' is not an aggregate: it needs a function over all nodes")]
        [TestCase("1", -1, "is not an aggregate")]
        [TestCase("count(*) over ()", -1, "is not an aggregate")]
        [TestCase("(select count(*) from nodes) + count(*) over ()", -1, "is not an aggregate")]
        [TestCase("(select count(*) from nodes other where other.x < nodes.x)", -1, "is not an aggregate")]
        [TestCase("(select x from nodes limit 1)", -1, "depends on the order of nodes")]
        [TestCase("iif(sum(heard) = 1, id, -1)", -1, "depends on the order of nodes")]
        [TestCase("iif(sum(heard = id) = 1, id, -1)", -1, "depends on the order of nodes")]
        [TestCase("avg(heard) + x", -1, "depends on the order of nodes: write each column in a function over all nodes")]
        [TestCase("avg(heard), max(x)", -1, "row value misused")]
        [TestCase("/* isn't */ avg('heard')", 16, "it must not contain texts; write columns without single quotes, at character 17")]
        [TestCase("count(*) filter (where heard > 3 || heard < 1)", 33, "|| concatenates texts; write OR, at character 34")]
        [TestCase("sum(9223372036854775807)", -1, "integer overflow")]
        [TestCase("avg(?)", -1, "it must not have parameters")]
        [TestCase("avg(heard); select 1", 10, "near \";\": syntax error")]
        [TestCase("1) from nodes; attach 'other.db' as other; --", 14, "it must be one expression")]
        [TestCase("avg(heard)) from nodes union select (avg(x)", -1, "it has more than one row")]
        [TestCase("(attach 'other.db' as other)", 8, "near \"'other.db'\": syntax error")]
        [TestCase("max(load_extension('other.so'))", 4, "no such function: load_extension")]
        [TestCase("max(readfile('/etc/passwd'))", 4, "no such function: readfile")]
        [TestCase("max(random())", 4, "not authorized to use function: random")]
        [TestCase("count(*) filter (where time > julianday('now'))", 30, "not authorized to use function: julianday")]
        [TestCase("max(zeroblob(1000000000))", 4, "not authorized to use function: zeroblob")]
        [TestCase("max(printf('%1000000000d', 1))", 4, "not authorized to use function: printf")]
        [TestCase("max((select count(*) from sqlite_master))", -1, "not authorized")]
        [TestCase("max((select count(name) from sqlite_schema))", -1, "prohibited")]
        [TestCase("max((select count(*) from pragma_database_list))", -1, "not authorized")]
        [TestCase("max((with recursive c(n) as (select 1 union all select n + 1 from c) select max(n) from c))", -1, "not authorized")]
        [TestCase(
            "max((select count(*) from nodes a, nodes b, nodes c, nodes d, nodes e, nodes f, nodes g, nodes h, nodes i, nodes j, nodes k, nodes l, nodes m, "
                + "nodes n, nodes o, nodes p, nodes q, nodes r, nodes s, nodes t, nodes u, nodes v, nodes w, nodes aa, nodes bb, nodes cc, nodes dd))",
            -1, "it takes longer than 'stepLimitMs', 100 ms")]
        public void Invalid_metrics_are_rejected_with_their_position(string sql, int character, string message)
        {
            var error = Assert.Throws<ScenarioException>(() => Make(sql).Dispose());
            Assert.That(error.Message, Is.StringContaining(message));
            Assert.That(error.Message, Is.StringContaining("metrics.m"));
            Assert.That(error.Message, Is.StringStarting(path + ":3" + (character < 0 ? ": " : ":" + (FirstColumn + character) + ": ")));
        }

        [Test]
        public void A_rejected_metric_releases_its_database()
        {
            Make("avg(heard)").Dispose();
            var before = sqlite3_memory_used();
            Assert.Throws<ScenarioException>(() => Make("avg(hrd)"));
            Assert.That(sqlite3_memory_used(), Is.EqualTo(before));
        }

        [Test]
        public void Aggregates_of_no_nodes_are_NaN_or_zero()
        {
            Assert.That(Measure("avg(heard)"), Is.NaN);
            Assert.That(Measure("max(x)"), Is.NaN);
            Assert.That(Measure("count(*)"), Is.EqualTo(0));
            Assert.That(Measure("total(heard)"), Is.EqualTo(0));
            Assert.That(Measure("(select count(*) from nodes)"), Is.EqualTo(0));
        }

        // The values of the nodes are 1, NaN and infinity. The fourth node has not run a round.
        [TestCase("count(*)", 4)]
        [TestCase("count(value)", 2)]
        [TestCase("count(sensor_value)", 3)]
        [TestCase("count(heard)", 3)]
        [TestCase("avg(value)", double.PositiveInfinity)]
        [TestCase("min(value)", 1)]
        [TestCase("max(-value)", -1)]
        [TestCase("avg(value) - max(value)", double.NaN)]
        [TestCase("avg(value) filter (where value < 9)", 1)]
        [TestCase("avg(coalesce(value, 0)) filter (where id <> 2)", 1.0 / 3)]
        [TestCase("avg(value) filter (where id > 9)", double.NaN)]
        [TestCase("sum(value) / 0", double.NaN)]
        [TestCase("max(1e308 * 10)", double.PositiveInfinity)]
        [TestCase("max(1e300 + id)", 1e300)]
        [TestCase("max(sqrt(-id))", 0)]
        [TestCase("max(log(0))", double.NaN)]
        [TestCase("median(id)", 1.5)]
        [TestCase("count(*) / 3", 1)]
        [TestCase("sum(id / 2)", 3)]
        [TestCase("max(time)", 0.05)]
        [TestCase("max(x) + max(position_z)", 5)]
        [TestCase("sum((select count(*) from nodes other where other.x < nodes.x))", 6)]
        [TestCase("avg(id) -- a comment", 1.5)]
        [TestCase("(select count(*) from nodes) / (select max(id) from nodes) -- a comment", 4.0 / 3)]
        [TestCase("(select avg(step) from (select x - lag(x) over (order by id) as step from nodes))", 1)]
        [TestCase("(select id from nodes where id > 9)", double.NaN)]
        public void Metrics_follow_SQL_with_NULL_for_NaN_and_missing_answers(string sql, double expected)
        {
            var values = new[] { 2, 0, 0.5f };
            Configure("ratio");
            using (var metrics = Make(sql))
            {
                for (var i = 0; i < values.Length; i++) MakeNode(values[i], new UnityEngine.Vector3(i, 0, i));
                Manager.Ticked += metrics.Ticked;
                Play(1);
                MakeNode(7, new UnityEngine.Vector3(3, 0, 9));
                var results = new double[2];
                metrics.Measure(Manager, results, 1);
                Assert.That(results[0], Is.EqualTo(0));
                Assert.That(results[1], double.IsNaN(expected) ? (NUnit.Framework.Constraints.IResolveConstraint)Is.NaN : Is.EqualTo(expected).Within(1e-7));
            }
        }

        [Test]
        public void The_degree_is_the_number_of_senders()
        {
            var nodes = new[] { MakeNode(1), MakeNode(2), MakeNode(3) };
            Manager.AddLink(nodes[0].Node.Id, nodes[1].Node.Id);
            Manager.AddLink(nodes[0].Node.Id, nodes[2].Node.Id);
            Play(1);
            Assert.That(Measure("sum(degree * degree)"), Is.EqualTo(6));
            UnityEngine.Object.DestroyImmediate(nodes[2].Node.gameObject);
            Play(1);
            Assert.That(Measure("sum(degree)"), Is.EqualTo(2));
        }

        [TestCase("count(sensor_value)")]
        [TestCase("count(message_bytes)")]
        public void A_node_has_no_data_of_an_earlier_node_with_its_id(string sql)
        {
            using (var metrics = Make(sql))
            {
                metrics.Begin(Manager);
                Manager.Ticked += metrics.Ticked;
                var nodes = new[] { MakeNode(1), MakeNode(2) };
                Play(1);
                Assert.That(Measure(metrics), Is.EqualTo(2));
                nodes[1].Node.enabled = false;
                nodes[1].Node.RequestedId = 1;
                nodes[1].Node.enabled = true;
                Assert.That(Measure(metrics), Is.EqualTo(1));
                Play(1);
                Assert.That(Measure(metrics), Is.EqualTo(2));
            }
        }

        [TestCase("count(maybeNumber) + count(maybe_number) + count(MAYBE_NUMBER)")]
        [TestCase("avg(position_x) + count(mode)")]
        [TestCase("max(x_y) + max(answer_x_y) + max(xy)")]
        [TestCase("max(maybenumber) + max(hop_count) + max(hopcount)")]
        public void Columns_accept_schema_and_Kotlin_names(string sql) => Make(sql, new test.features.FeaturesSchema()).Dispose();

        [TestCase("avg(hrd)", " hop_count, hopcount, ")]
        [TestCase("avg(hrd)", " answer_target_x, target_y, ")]
        [TestCase("max(hopCount)", "'hopCount' is ambiguous, because SQL ignores case: write hop_count or hopcount")]
        public void A_column_is_the_field_with_its_name_in_the_schema(string sql, string message)
        {
            var error = Assert.Throws<ScenarioException>(() => Make(sql, new test.features.FeaturesSchema()).Dispose());
            Assert.That(error.Message, Is.StringContaining(message));
        }

        [DllImport("collektive_sqlite")]
        private static extern long sqlite3_memory_used();

        private double Measure(string sql)
        {
            using (var metrics = Make(sql)) return Measure(metrics);
        }

        private double Measure(SqlMetrics metrics)
        {
            var values = new double[1];
            metrics.Measure(Manager, values, 0);
            return values[0];
        }

        private SqlMetrics Make(string sql, DataSchema schema = null)
        {
            File.WriteAllText(path, "{\n  \"metrics\": {\n    \"m\": " + Newtonsoft.Json.JsonConvert.ToString(sql) + "\n  }\n}");
            var file = JsonFile.Read(path);
            return new SqlMetrics(file, (JObject)file.Root["metrics"], schema ?? new probe.ProbeSchema(), LimitMs);
        }
    }
}
