using System.Collections.Generic;
using NUnit.Framework;

namespace Collektive.Unity.Editor.Tests
{
    public sealed class DataTextTests
    {
        private struct Place
        {
            public float X;
            public float Z;
        }

        private sealed class Data
        {
            public int Hops = 3;
            public bool IsSource = false;
            public string Name = null;
            public Place Target = new Place { X = 1.5f, Z = -2 };
            public List<int> Seen = new List<int> { 1, 2 };
            public int[] Many = new int[20];

            public float Speed => 0.25f;
        }

        [Test]
        public void Fields_and_properties_are_shown_as_text()
        {
            var lines = new Dictionary<string, string>();
            foreach (var line in DataText.Of(new Data())) lines.Add(line.Key, line.Value);
            Assert.That(lines["Hops"], Is.EqualTo("3"));
            Assert.That(lines["IsSource"], Is.EqualTo("false"));
            Assert.That(lines["Name"], Is.EqualTo("none"));
            Assert.That(lines["Target"], Is.EqualTo("X 1.5, Z -2"));
            Assert.That(lines["Seen"], Is.EqualTo("[1] [2]"));
            Assert.That(lines["Speed"], Is.EqualTo("0.25"));
        }

        [Test]
        public void Long_lists_are_truncated()
        {
            var many = DataText.Of(new Data()).Find(line => line.Key == "Many").Value;
            Assert.That(many, Is.EqualTo("[0] [0] [0] [0] [0] [0] [0] [0] ..."));
        }
    }
}
