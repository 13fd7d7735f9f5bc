using Collektive.Unity.Editor;
using NUnit.Framework;

namespace Collektive.Headless.Tests.Editor
{
    public sealed class ToolRunTests
    {
        [TestCase(@"a b", @"""a b""")]
        [TestCase(@"\\server\share\My Project", @"""\\server\share\My Project""")]
        [TestCase(@"C:\folder\", @"""C:\folder\\""")]
        [TestCase(@"say ""hi""", @"""say \""hi\""""")]
        [TestCase(@"\""", @"""\\\""""")]
        public void Windows_doubles_backslashes_only_before_quotes(string argument, string quoted) =>
            Assert.That(ToolRun.Quoted(argument, true), Is.EqualTo(quoted));

        [TestCase(@"a\b", @"""a\\b""")]
        [TestCase(@"say ""hi""", @"""say \""hi\""""")]
        public void Other_systems_escape_both(string argument, string quoted) => Assert.That(ToolRun.Quoted(argument, false), Is.EqualTo(quoted));
    }
}
