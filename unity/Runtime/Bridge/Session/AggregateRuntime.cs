namespace Collektive.Bridge
{
    /// <summary>The runtimes that can run programs. A runtime consists of a DSL, its standard library and their implementation.</summary>
    public enum AggregateRuntime : byte
    {
        /// <summary>The built-in runtime, for many nodes in one process.</summary>
        BuiltIn = org.collektive.frame.AggregateRuntime.BuiltIn,

        /// <summary>Collektive from the user's jars; much slower.</summary>
        Collektive = org.collektive.frame.AggregateRuntime.Collektive,
    }
}
