namespace Collektive.Headless.Faults
{
    /// <summary>What a scene is started with.</summary>
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

        /// <summary>With another's jar of programs: the JVM stays as it is.</summary>
        internal Setting With(Setting other) => new Setting(Home, Host, other.Jar, Options);
    }
}
