using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Security;
using System.Text;

namespace Collektive.Headless
{
    /// <summary>A database in memory. Queries can read its tables and call functions whose results repeat, and nothing else. Not thread-safe.</summary>
    internal sealed class Sqlite : IDisposable
    {
        private const int Ok = 0;
        private const int Row = 100;
        private const int Done = 101;
        private const int Deny = 1;

        // Actions that the authorizer allows.
        private const int Read = 20;
        private const int Select = 21;
        private const int Function = 31;
        private const int Recursive = 33;

        /// <summary>Functions that depend on a clock, on the process or on earlier queries.</summary>
        private static readonly HashSet<string> Refused = new HashSet<string>(
            ("random randomblob date time datetime julianday unixepoch strftime timediff current_date current_time current_timestamp changes "
                + "total_changes last_insert_rowid load_extension sqlite_version sqlite_source_id sqlite_offset sqlite_log "
                + "sqlite_compileoption_get sqlite_compileoption_used fts3_tokenizer").Split(' '), StringComparer.OrdinalIgnoreCase);

        // Collected delegates would leave the database with dangling pointers.
        private readonly Authorizer authorizer;
        private readonly IntPtr database;
        private ISet<string> columnsRead;

        internal Sqlite()
        {
            try
            {
                Check(sqlite3_open_v2(":memory:", out database, 0x2 | 0x4 | 0x80, IntPtr.Zero));
                // Since 3.38.
                sqlite3_error_offset(database);
            }
            catch (Exception error) when (error is DllNotFoundException || error is EntryPointNotFoundException)
            {
                throw new ScenarioException("'metrics' needs SQLite 3.38 or newer: install the package libsqlite3-0 (" + error.Message + ")");
            }
            authorizer = Authorize;
        }

        /// <summary>Version of the library.</summary>
        internal static string Version => Marshal.PtrToStringAnsi(sqlite3_libversion());

        public void Dispose() => sqlite3_close_v2(database);

        /// <summary>Executes statements of our own.</summary>
        internal void Execute(string sql) => Check(sqlite3_exec(database, Bytes(sql), IntPtr.Zero, IntPtr.Zero, IntPtr.Zero));

        /// <summary>Prepares a statement of our own.</summary>
        internal Statement Prepare(string sql)
        {
            var bytes = Bytes(sql);
            Check(sqlite3_prepare_v3(database, bytes, bytes.Length, 1, out var statement, IntPtr.Zero));
            return new Statement(this, statement);
        }

        /// <summary>Prepares a query of a user's, restricted to reading, and adds the names of the columns that it reads to a set.</summary>
        /// <exception cref="SqlException">The text is not one query with one column, or does what is refused.</exception>
        internal Statement PrepareQuery(string sql, ISet<string> columns)
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
                if (sql.Substring(rest).Trim().Length == 0 && sqlite3_column_count(statement) == 1) return query;
                query.Dispose();
                throw new SqlException("it must be one expression", sql.Substring(rest).Trim().Length == 0 ? -1 : rest);
            }
            finally
            {
                pin.Free();
                sqlite3_set_authorizer(database, null, IntPtr.Zero);
            }
        }

        private string Message => Text(sqlite3_errmsg(database));

        private int Authorize(IntPtr data, int action, IntPtr first, IntPtr second, IntPtr schema, IntPtr trigger)
        {
            switch (action)
            {
                case Select:
                case Recursive: return Ok;
                case Function: return Refused.Contains(Text(second)) ? Deny : Ok;
                case Read:
                    // Rows of a subquery have no database.
                    if (Text(first).StartsWith("sqlite_", StringComparison.OrdinalIgnoreCase)) return Deny;
                    columnsRead.Add(Text(second));
                    return Ok;
                default: return Deny;
            }
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
            private readonly IntPtr handle;

            internal Statement(Sqlite owner, IntPtr handle)
            {
                this.owner = owner;
                this.handle = handle;
            }

            public void Dispose() => sqlite3_finalize(handle);

            /// <summary>Sets a parameter, from 1; NaN becomes NULL.</summary>
            internal void Bind(int parameter, double value) => sqlite3_bind_double(handle, parameter, value);

            /// <summary>Executes a statement without results.</summary>
            internal void Execute()
            {
                var code = sqlite3_step(handle);
                if (code != Done) throw new InvalidOperationException("SQLite: " + owner.Message);
                sqlite3_reset(handle);
            }

            /// <summary>Returns the number in the only row; NaN for NULL; null if there is no row.</summary>
            /// <exception cref="SqlException">The query fails, or has another result.</exception>
            internal double? Query()
            {
                try
                {
                    var code = sqlite3_step(handle);
                    if (code == Done) return null;
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
                }
            }
        }

        private const string Library = "libsqlite3.so.0";

        private delegate int Authorizer(IntPtr data, int action, IntPtr first, IntPtr second, IntPtr schema, IntPtr trigger);

        [DllImport(Library)]
        private static extern int sqlite3_open_v2(string file, out IntPtr database, int flags, IntPtr vfs);

        [DllImport(Library)]
        private static extern int sqlite3_close_v2(IntPtr database);

        [DllImport(Library)]
        private static extern IntPtr sqlite3_libversion();

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
        [SuppressUnmanagedCodeSecurity]
        private static extern int sqlite3_step(IntPtr statement);

        [DllImport(Library)]
        private static extern int sqlite3_reset(IntPtr statement);

        [DllImport(Library)]
        [SuppressUnmanagedCodeSecurity]
        private static extern int sqlite3_bind_double(IntPtr statement, int parameter, double value);

        [DllImport(Library)]
        private static extern int sqlite3_column_count(IntPtr statement);

        [DllImport(Library)]
        private static extern int sqlite3_column_type(IntPtr statement, int column);

        [DllImport(Library)]
        private static extern double sqlite3_column_double(IntPtr statement, int column);
    }

    /// <summary>A query that SQLite refuses.</summary>
    internal sealed class SqlException : Exception
    {
        /// <param name="character">Place in the query, from 0; -1: not known.</param>
        internal SqlException(string message, int character)
            : base(message) => Character = character;

        internal int Character { get; }
    }
}
