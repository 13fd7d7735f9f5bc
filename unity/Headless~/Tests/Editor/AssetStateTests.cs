using System;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;

namespace Collektive.Headless.Tests.Editor
{
    public sealed class AssetStateTests : ProjectFixture
    {
        [Test]
        public void Calls_of_the_asset_database_throw_while_code_is_reloaded()
        {
            AssetState.Reload(() =>
            {
                Assert.Throws<InvalidOperationException>(() => AssetDatabase.GUIDToAssetPath("0"));
                Assert.Throws<InvalidOperationException>(() => AssetDatabase.LoadAssetAtPath<GameObject>("Assets/a.prefab"));
                Assert.Throws<InvalidOperationException>(AssetDatabase.Refresh);
            });
            Assert.That(AssetDatabase.GUIDToAssetPath("0"), Is.Empty);
        }

        [Test]
        public void Changes_of_assets_throw_during_an_import()
        {
            AssetState.Import(() =>
            {
                Assert.That(AssetDatabase.GUIDToAssetPath("0"), Is.Empty);
                Assert.Throws<InvalidOperationException>(AssetDatabase.Refresh);
                Assert.Throws<InvalidOperationException>(() => AssetDatabase.ImportAsset("Assets/a.fbs"));
            });
        }
    }
}
