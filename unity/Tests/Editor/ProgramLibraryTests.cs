using System.IO;
using NUnit.Framework;
using UnityEditor;
using Object = UnityEngine.Object;

namespace Collektive.Unity.Editor.Tests
{
    /// <summary>Tests a sample's program library that this editor imports. The samples' scenes refer to its objects by id.</summary>
    public sealed class ProgramLibraryTests
    {
        private const string Sample = "Packages/org.collektive.unity/Samples~/LeaderElection/leader_election.clkprograms";
        private const string Copy = "Assets/CollektiveTests.clkprograms";

        [SetUp]
        public void Import()
        {
            Directory.CreateDirectory("Assets");
            File.Copy(Installation.PathOf(Sample), Copy, true);
            AssetDatabase.ImportAsset(Copy);
        }

        [TearDown]
        public void Remove()
        {
            File.Delete(Copy);
            File.Delete(Copy + ".meta");
            AssetDatabase.Refresh();
        }

        [Test]
        public void Ids_of_imported_objects_are_those_in_the_scenes_of_samples()
        {
            var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>(Copy);
            Assert.That(library.Programs.Count, Is.EqualTo(1));
            Assert.That(IdOf(library), Is.EqualTo(-944628639613478452));
            Assert.That(IdOf(library.Find("leader-election")), Is.EqualTo(6966890540590597578));
        }

        private static long IdOf(Object asset)
        {
            Assert.That(AssetDatabase.TryGetGUIDAndLocalFileIdentifier(asset, out _, out var id), Is.True);
            return id;
        }
    }
}
