namespace Collektive.Bridge
{
    /// <summary>What runs aggregate programs: a DSL, its standard library and their implementation.</summary>
    public enum AggregateRuntime : byte
    {
        /// <summary>The package's own, made for many nodes in one process.</summary>
        BuiltIn = org.collektive.frame.AggregateRuntime.BuiltIn,

        /// <summary>Collektive itself, from jars of the user's; much slower.</summary>
        Collektive = org.collektive.frame.AggregateRuntime.Collektive,
    }
}
