using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Runtime.InteropServices;
using System.Text;
using System.Text.RegularExpressions;

namespace Collektive.Headless
{
    /// <summary>
    /// A database in memory. Queries may be from someone else, so they can only read one table and call deterministic functions. Not thread-safe.
    /// </summary>
    internal sealed class Sqlite : IDisposable
    {
        /// <summary>The only table that queries can read.</summary>
        internal const string Table = "nodes";

        private const int Ok = 0;
        private const int Interrupted = 9;
        private const int Row = 100;
        private const int Done = 101;
        private const int Deny = 1;

        // The actions that the authorizer allows.
        private const int Read = 20;
        private const int Select = 21;
        private const int Function = 31;

        /// <summary>Number of SQLite's instructions between two checks of the time limit. They take about a millisecond.</summary>
        private const int InstructionsPerCheck = 100_000;

        /// <summary>Maximum memory of all databases in the process, in bytes.</summary>
        private const long MaxMemory = 1L << 30;

        private static readonly Regex Comments = new Regex(@"--[^\n]*|/\*.*?(\*/|$)", RegexOptions.Singleline);

        /// <summary>The functions that queries can call. They are numeric and depend only on their arguments.</summary>
        private static readonly HashSet<string> Allowed = new HashSet<string>(
            ("avg count max median min percentile percentile_cont percentile_disc sum total "
                + "cume_dist dense_rank first_value lag last_value lead nth_value ntile percent_rank rank row_number "
                + "abs acos acosh asin asinh atan atan2 atanh ceil ceiling coalesce cos cosh degrees exp floor ifnull iif if ln log log10 log2 mod nullif "
                + "pi pow power radians round sign sin sinh sqrt tan tanh trunc typeof").Split(' '), StringComparer.OrdinalIgnoreCase);

        // The database calls these delegates, so they must not be collected as garbage.
        private readonly Authorizer authorizer;
        private readonly ProgressHandler progress;
        private IntPtr database;
        private readonly Stopwatch clock = new Stopwatch();
        private readonly int limitMs;
        private ISet<string> columnsRead;

        /// <param name="limitMs">Milliseconds that a query may take.</param>
        internal Sqlite(int limitMs)
        {
            this.limitMs = limitMs;
            authorizer = Authorize;
            progress = data => clock.ElapsedMilliseconds > this.limitMs ? 1 : 0;
            try
            {
                Check(sqlite3_open_v2(":memory:", out database, 0x2 | 0x4 | 0x80, IntPtr.Zero));
            }
            catch (DllNotFoundException error)
            {
                throw new ScenarioException(
                    "the SQL library (libcollektive_sqlite.so) is missing: run ./collektive build runtime (" + error.Message + ")");
            }
            sqlite3_hard_heap_limit64(MaxMemory);
            sqlite3_progress_handler(database, InstructionsPerCheck, progress, IntPtr.Zero);
        }

        public void Dispose()
        {
            sqlite3_close_v2(database);
            database = IntPtr.Zero;
        }

        /// <summary>Executes trusted statements.</summary>
        internal void Execute(string sql) => Check(sqlite3_exec(database, Bytes(sql), IntPtr.Zero, IntPtr.Zero, IntPtr.Zero));

        /// <summary>Prepares a trusted statement.</summary>
        internal Statement Prepare(string sql)
        {
            var bytes = Bytes(sql);
            Check(sqlite3_prepare_v3(database, bytes, bytes.Length, 1, out var statement, IntPtr.Zero));
            return new Statement(this, statement);
        }

        /// <summary>Prepares a user's query, restricted to reading.</summary>
        /// <param name="columns">Set to which the names of the columns that the query reads are added; may be null.</param>
        /// <param name="parameters">Number of parameters in the player's part of the query.</param>
        /// <exception cref="SqlException">The text is not one query with one column, or does something that is not allowed.</exception>
        internal Statement PrepareQuery(string sql, ISet<string> columns, int parameters = 0)
        {
            var bytes = Bytes(sql);
            columnsRead = columns;
            sqlite3_set_authorizer(database, authorizer, IntPtr.Zero);
            var pin = GCHandle.Alloc(bytes, GCHandleType.Pinned);
            try
            {
                var code = sqlite3_prepare_v3(database, pin.AddrOfPinnedObject(), bytes.Length, 1, out var statement, out var tail);
                if (code != Ok) throw new SqlException(Message, CharacterAt(bytes, sqlite3_error_offset(database)));
                var query = new Statement(this, statement);
                var end = (int)(tail.ToInt64() - pin.AddrOfPinnedObject().ToInt64());
                var rest = CharacterAt(bytes, end);
                var hasRest = sql.Substring(rest).Trim().Length > 0;
                var hasParameters = sqlite3_bind_parameter_count(statement) != parameters;
                // SQLite would read a column's name in single quotes as a text with the value 0, and "0 || 1" as the text 01.
                var uncommented = Comments.Replace(sql, comment => new string(' ', comment.Length));
                int text = uncommented.IndexOf('\''), concatenation = uncommented.IndexOf("||", StringComparison.Ordinal);
                if (!hasRest && !hasParameters && text < 0 && concatenation < 0 && sqlite3_column_count(statement) == 1) return query;
                query.Dispose();
                if (!hasRest && text >= 0) throw new SqlException("it must not contain texts; write columns without single quotes", text);
                if (!hasRest && concatenation >= 0) throw new SqlException("|| concatenates texts; write OR", concatenation);
                throw new SqlException(hasParameters ? "it must not have parameters" : "it must be one expression", hasRest ? rest : -1);
            }
            finally
            {
                pin.Free();
                sqlite3_set_authorizer(database, null, IntPtr.Zero);
            }
        }

        private string Message => Text(sqlite3_errmsg(database));

        // This method must not throw exceptions, because SQLite calls it.
        private int Authorize(IntPtr data, int action, IntPtr first, IntPtr second, IntPtr schema, IntPtr trigger)
        {
            switch (action)
            {
                case Select: return Ok;
                case Function: return Allowed.Contains(Text(second)) ? Ok : Deny;
                case Read:
                    return AuthorizeRead(Text(first), Text(second), schema != IntPtr.Zero);
                default: return Deny;
            }
        }

        /// <param name="column">The column that is read; empty if rows are only counted.</param>
        /// <param name="isInSchema">Whether the table belongs to a schema. False for subqueries, and if rows are only counted.</param>
        private int AuthorizeRead(string table, string column, bool isInSchema)
        {
            var isInternal = table.StartsWith("sqlite_", StringComparison.OrdinalIgnoreCase) || table.StartsWith("pragma_", StringComparison.OrdinalIgnoreCase);
            if (isInternal || isInSchema && table != Table) return Deny;
            columnsRead?.Add(column);
            return Ok;
        }

        private void Check(int code)
        {
            if (code != Ok) throw new InvalidOperationException("SQLite: " + Message);
        }

        private static byte[] Bytes(string text) => Encoding.UTF8.GetBytes(text + "\0");

        private static int CharacterAt(byte[] bytes, int offset) => offset < 0 ? -1 : Encoding.UTF8.GetCharCount(bytes, 0, Math.Min(offset, bytes.Length - 1));

        private static string Text(IntPtr text)
        {
            if (text == IntPtr.Zero) return "";
            var length = 0;
            while (Marshal.ReadByte(text, length) != 0) length++;
            var bytes = new byte[length];
            Marshal.Copy(text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        /// <summary>A prepared statement.</summary>
        internal sealed class Statement : IDisposable
        {
            private readonly Sqlite owner;
            private IntPtr handle;

            internal Statement(Sqlite owner, IntPtr handle)
            {
                this.owner = owner;
                this.handle = handle;
            }

            public void Dispose()
            {
                sqlite3_finalize(handle);
                handle = IntPtr.Zero;
            }

            /// <summary>Executes a statement without results. Its parameters are the first values of an array; NaN becomes NULL.</summary>
            internal void Execute(double[] values, int count)
            {
                if (collektive_insert(handle, values, count) != Done) throw new InvalidOperationException("SQLite: " + owner.Message);
            }

            /// <summary>Sets the parameters; NaN becomes NULL.</summary>
            internal void Bind(double[] values)
            {
                if (handle == IntPtr.Zero) throw new ObjectDisposedException("SQL expression");
                if (collektive_bind(handle, values, values.Length) != Ok) throw new InvalidOperationException("SQLite: " + owner.Message);
            }

            /// <summary>Returns the number in the only row; NaN if it is NULL; null if the result has no rows.</summary>
            /// <exception cref="SqlException">The query fails, or has another result.</exception>
            internal double? Query()
            {
                owner.clock.Restart();
                try
                {
                    var code = sqlite3_step(handle);
                    if (code == Done) return null;
                    if (code == Interrupted) throw new SqlException("it takes longer than 'stepLimitMs', " + owner.limitMs + " ms", -1);
                    if (code != Row) throw new SqlException(owner.Message, -1);
                    const int Text = 3, Blob = 4, Null = 5;
                    var type = sqlite3_column_type(handle, 0);
                    if (type == Text || type == Blob) throw new SqlException("its value is not a number", -1);
                    var value = type == Null ? double.NaN : sqlite3_column_double(handle, 0);
                    if (sqlite3_step(handle) == Row) throw new SqlException("it has more than one row", -1);
                    return value;
                }
                finally
                {
                    sqlite3_reset(handle);
                    owner.clock.Reset();
                }
            }
        }

        private const string Library = "collektive_sqlite";

        private delegate int Authorizer(IntPtr data, int action, IntPtr first, IntPtr second, IntPtr schema, IntPtr trigger);

        private delegate int ProgressHandler(IntPtr data);

        [DllImport(Library)]
        private static extern int sqlite3_open_v2(string file, out IntPtr database, int flags, IntPtr vfs);

        [DllImport(Library)]
        private static extern int sqlite3_close_v2(IntPtr database);

        [DllImport(Library)]
        private static extern long sqlite3_hard_heap_limit64(long bytes);

        [DllImport(Library)]
        private static extern void sqlite3_progress_handler(IntPtr database, int instructions, ProgressHandler handler, IntPtr data);

        [DllImport(Library)]
        private static extern IntPtr sqlite3_errmsg(IntPtr database);

        [DllImport(Library)]
        private static extern int sqlite3_error_offset(IntPtr database);

        [DllImport(Library)]
        private static extern int sqlite3_exec(IntPtr database, byte[] sql, IntPtr callback, IntPtr data, IntPtr message);

        [DllImport(Library)]
        private static extern int sqlite3_prepare_v3(IntPtr database, byte[] sql, int bytes, uint flags, out IntPtr statement, IntPtr tail);

        [DllImport(Library)]
        private static extern int sqlite3_prepare_v3(IntPtr database, IntPtr sql, int bytes, uint flags, out IntPtr statement, out IntPtr tail);

        [DllImport(Library)]
        private static extern int sqlite3_set_authorizer(IntPtr database, Authorizer authorizer, IntPtr data);

        [DllImport(Library)]
        private static extern int sqlite3_finalize(IntPtr statement);

        [DllImport(Library)]
        private static extern int sqlite3_step(IntPtr statement);

        [DllImport(Library)]
        private static extern int sqlite3_reset(IntPtr statement);

        [DllImport(Library)]
        private static extern int collektive_bind(IntPtr statement, double[] values, int count);

        [DllImport(Library)]
        private static extern int collektive_insert(IntPtr statement, double[] values, int count);

        [DllImport(Library)]
        private static extern int sqlite3_bind_parameter_count(IntPtr statement);

        [DllImport(Library)]
        private static extern int sqlite3_column_count(IntPtr statement);

        [DllImport(Library)]
        private static extern int sqlite3_column_type(IntPtr statement, int column);

        [DllImport(Library)]
        private static extern double sqlite3_column_double(IntPtr statement, int column);
    }

    /// <summary>A query that SQLite rejects.</summary>
    internal sealed class SqlException : Exception
    {
        /// <param name="character">Position in the query, from 0; -1 if unknown.</param>
        internal SqlException(string message, int character)
            : base(message) => Character = character;

        private int Character { get; }

        /// <summary>Returns the position in a user's text, which begins at an offset in the query; -1 if the position is unknown.</summary>
        internal int CharacterIn(string text, int offset) => Character < offset ? -1 : Math.Min(Character - offset, text.Length);

        /// <summary>Returns the message with the position in a user's text. For an unknown column, also names the known columns.</summary>
        internal string Describe(string text, int offset, string columns)
        {
            var at = Character - offset;
            if (at >= text.Length) return "'" + text + "' ends too early";
            return Message + (at >= 0 ? ", at character " + (at + 1) + " of '" + text + "'" : "")
                + (Message.StartsWith("no such column", StringComparison.Ordinal) ? "; columns: " + columns : "");
        }
    }
}
