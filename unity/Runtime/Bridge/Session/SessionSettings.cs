using System.Collections.Generic;

namespace Collektive.Bridge
{
    /// <summary>What a session is opened with.</summary>
    public sealed class SessionSettings
    {
        /// <summary>Version of <c>frame.fbs</c> that both sides must share.</summary>
        internal const uint Protocol = 1;

        /// <summary>The one seed that all randomness of the session comes from.</summary>
        public ulong Seed { get; set; }

        /// <summary>Threads of the JVM that run rounds, 1..256. The results do not depend on it.</summary>
        public int Threads { get; set; } = 1;

        /// <summary>Which messages a round sees.</summary>
        public org.collektive.frame.Schedule Schedule { get; set; }

        /// <summary>What happens to messages between sending and receiving.</summary>
        public NetworkModel Network { get; set; } = new NetworkModel();

        /// <summary>Paths of the jars with programs; read into memory at the opening, never held open.</summary>
        public IReadOnlyList<string> Jars { get; set; } = new string[0];

        /// <summary>Program of nodes that name none.</summary>
        public string Program { get; set; } = "";

        /// <summary>Path of the file to record all frames in, for <c>./collektive replay</c>; overwritten. Empty: no record.</summary>
        public string Record { get; set; } = "";

        /// <summary>Limit for opening and closing in milliseconds.</summary>
        public int OpenLimitMs { get; set; } = 30000;
    }
}
