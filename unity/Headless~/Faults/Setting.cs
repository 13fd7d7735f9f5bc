namespace Collektive.Headless.Faults
{
    /// <summary>Start settings of a scene: JVM, jars and flags.</summary>
    internal sealed class Setting
    {
        internal readonly string Home;
        internal readonly string Host;
        internal readonly string Jar;
        internal readonly string[] Options;

        internal Setting(string home, string host, string jar, string[] options)
        {
            Home = home;
            Host = host;
            Jar = jar;
            Options = options;
        }

        /// <summary>The same JVM with the programs of another setting.</summary>
        internal Setting With(Setting other) => new Setting(Home, Host, other.Jar, Options);
    }
}
