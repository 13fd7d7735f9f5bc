using System;

namespace Collektive.Headless
{
    /// <summary>An SQL expression with the columns id, time, x, y and z: a node's id, the simulated time, and the node's position in metres.</summary>
    /// <remarks>Not thread-safe.</remarks>
    public sealed class PlaceExpression : IDisposable
    {
        // These parameters precede those of the user's text, which would otherwise get their values.
        private const string Before = "WITH place(id, time, x, y, z) AS (SELECT ?1, ?2, ?3, ?4, ?5) SELECT (";
        private const string Columns = "id, time, x, y, z";
        // This part begins on a new line, so that a comment at the end of the user's text cannot hide it.
        private const string After = "\n) FROM place";

        private readonly double[] values = new double[5];
        private readonly Sqlite database;
        private readonly Sqlite.Statement query;

        /// <summary>Prepares an expression and evaluates it once, to check it.</summary>
        /// <param name="limitMs">Maximum time of an evaluation in milliseconds.</param>
        /// <exception cref="ScenarioException">The text is not an expression with these columns.</exception>
        public PlaceExpression(string sql, int limitMs)
        {
            database = new Sqlite(limitMs);
            try
            {
                query = database.PrepareQuery(Before + sql + After, null, values.Length);
                Evaluate(0, 0, 0, 0, 0);
            }
            catch (SqlException error)
            {
                Dispose();
                throw new ScenarioException(error.Describe(sql, Before.Length, Columns));
            }
        }

        /// <summary>Returns the value of the expression; NaN if it is NULL.</summary>
        public double Evaluate(int id, double time, double x, double y, double z)
        {
            values[0] = id;
            values[1] = time;
            values[2] = x;
            values[3] = y;
            values[4] = z;
            query.Bind(values);
            return query.Query() ?? double.NaN;
        }

        /// <summary>Releases the database.</summary>
        public void Dispose()
        {
            query?.Dispose();
            database.Dispose();
        }
    }
}
