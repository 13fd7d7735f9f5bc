using System.IO;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor.Headless;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    public sealed class ProjectSettingsTests : ProjectFixture
    {
        [Test]
        public void What_is_changed_is_stored_with_the_project()
        {
            Draw();
            Assert.That(File.Exists("ProjectSettings/Collektive.asset"), Is.False, "nothing was changed");
            Gui.Act("JDK", "/opt/jdk");
            Gui.Act("Build before Play", false);
            Draw();
            Assert.That(ProjectSettings.instance.jdk, Is.EqualTo("/opt/jdk"));
            Assert.That(File.ReadAllText("ProjectSettings/Collektive.asset"),
                Is.StringContaining("jdk: /opt/jdk").And.StringContaining("buildBeforePlay: False"));
        }

        [Test]
        public void The_page_shows_which_tools_are_used_and_what_is_wrong_with_them()
        {
            ProjectSettings.instance.jdk = "/nowhere/jdk";
            UseKotlin();
            Draw();
            Assert.That(Gui.Lines, Has.Some.Contains("help Warning: the JDK in the project settings, /nowhere/jdk"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("label  : " + Path.GetFullPath("kotlinc")));
        }

        private static void Draw()
        {
            Gui.Clear();
            var page = Menus.SettingsPages().Find(candidate => candidate.settingsPath == "Project/Collektive");
            page.guiHandler("");
        }
    }
}
