using NUnit.Framework;

namespace Collektive.Unity.Editor.Tests
{
    public sealed class ToolMessageTests
    {
        [TestCase("Assets/Swarm/swarm.fbs:3: 12: error: expecting: ; instead got: }", "Assets/Swarm/swarm.fbs", 3, 12, "expecting: ; instead got: }")]
        [TestCase("  C:/Project/Assets/swarm.fbs(3, 12): error: expecting: ;", "C:/Project/Assets/swarm.fbs", 3, 12, "expecting: ;")]
        [TestCase("/home/ada/Assets/Programs/Hops.kt:10:21: error: unresolved reference 'nesting'.", "/home/ada/Assets/Programs/Hops.kt", 10, 21,
            "unresolved reference 'nesting'.")]
        [TestCase("file:///home/ada/Hops.kt:10:21: error: no", "/home/ada/Hops.kt", 10, 21, "no")]
        [TestCase("Library/Collektive/java/SensorData.java:7: error: cannot find symbol", "Library/Collektive/java/SensorData.java", 7, 0,
            "cannot find symbol")]
        public void Errors_of_each_tool_are_parsed_with_file_and_line(string output, string file, int line, int column, string text)
        {
            var messages = ToolMessage.Parse(output);
            Assert.That(messages.Count, Is.EqualTo(1));
            Assert.That(messages[0].File, Is.EqualTo(file));
            Assert.That(messages[0].Line, Is.EqualTo(line));
            Assert.That(messages[0].Column, Is.EqualTo(column));
            Assert.That(messages[0].Text, Is.EqualTo(text));
            Assert.That(messages[0].IsError, Is.True);
        }

        [Test]
        public void An_error_that_flatc_reports_at_the_end_has_its_original_line()
        {
            var messages = ToolMessage.Parse("error:\n  /a/bad.fbs:6: 0: error: type referenced but not defined: flaot, originally at: /a/bad.fbs:3\n");
            Assert.That(messages.Count, Is.EqualTo(1));
            Assert.That(messages[0].Line, Is.EqualTo(3));
            Assert.That(messages[0].Text, Is.EqualTo("type referenced but not defined: flaot"));
        }

        [Test]
        public void Warnings_are_not_errors()
        {
            var messages = ToolMessage.Parse("/a/Hops.kt:4:5: warning: variable 'x' is never used");
            Assert.That(messages.Count, Is.EqualTo(1));
            Assert.That(messages[0].IsError, Is.False);
        }

        [TestCase("/a/Hops.kt:4:9: error: no\n    val x = nesting()\n            ^^^^^^^\n", "no\n    val x = nesting()")]
        [TestCase("/a/Data.java:4: error: no\r\n    x = nesting();\r\n        ^\r\n1 error\r\n", "no\n    x = nesting();")]
        [TestCase("/a/Hops.kt:4:9: error: no\n/a/Hops.kt:5:9: error: no\n", "no")]
        public void A_message_shows_the_line_of_the_source(string output, string text) => Assert.That(ToolMessage.Parse(output)[0].Text, Is.EqualTo(text));

        [Test]
        public void Source_lines_carets_and_summaries_are_ignored()
        {
            Assert.That(ToolMessage.Parse("    val x = nesting()\n            ^^^^^^^\n1 error\n\r\nwarning: something about the JVM\n"), Is.Empty);
        }
    }
}
