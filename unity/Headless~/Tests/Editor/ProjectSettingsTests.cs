using System.IO;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    public sealed class ProjectSettingsTests : ProjectFixture
    {
        private const string Personal = "Preferences/Collektive";
        private const string Shared = "Project/Collektive";

        [Test]
        public void Paths_are_personal_and_the_rest_is_the_projects()
        {
            Draw(Personal);
            Draw(Shared);
            Assert.That(File.Exists("ProjectSettings/Collektive.asset"), Is.False, "the file must not exist before a setting is changed");
            Assert.That(Directory.Exists("UserSettings"), Is.False);
            Gui.Act("JDK", "/opt/jdk");
            Draw(Personal);
            Assert.That(PersonalSettings.instance.jdk, Is.EqualTo("/opt/jdk"));
            Assert.That(File.ReadAllText("UserSettings/Collektive.asset"), Is.StringContaining("jdk: /opt/jdk"));
            Gui.Act("Play Previous Programs", WhenProgramsFail.Never);
            Draw(Shared);
            Assert.That(File.ReadAllText("ProjectSettings/Collektive.asset"),
                Is.StringContaining("whenProgramsFail: Never").And.Not.StringContaining("/opt/jdk"));
        }

        [Test]
        public void Undo_takes_a_path_back_and_stores_it()
        {
            var page = Draw(Personal);
            Gui.Act("JDK", "/opt/jdk");
            Gui.Passes(() => page.OnGUI(""));
            Project.PerformUndo();
            Assert.That(PersonalSettings.instance.jdk, Is.Empty);
            Assert.That(File.ReadAllText("UserSettings/Collektive.asset"), Is.Not.StringContaining("/opt/jdk"));
            page.OnDeactivate();
            Assert.That(Undo.undoRedoPerformed, Is.Null);
        }

        [Test]
        public void Paths_that_earlier_versions_kept_with_the_project_become_personal_once()
        {
            ProjectSettings.instance.jdk = "/old/jdk";
            ProjectSettings.instance.sourceCheckout = "/old/clone";
            Menus.Load();
            Assert.That(PersonalSettings.instance.jdk, Is.EqualTo("/old/jdk"));
            Assert.That(File.ReadAllText("UserSettings/Collektive.asset"), Is.StringContaining("sourceCheckout: /old/clone"));
            Assert.That(File.ReadAllText("ProjectSettings/Collektive.asset"), Is.Not.StringContaining("/old"));
            PersonalSettings.instance.jdk = "";
            Menus.Load();
            Assert.That(PersonalSettings.instance.jdk, Is.Empty);
        }

        [Test]
        public void The_settings_page_shows_the_tools_and_their_errors()
        {
            PersonalSettings.instance.jdk = "/nowhere/jdk";
            UseKotlin();
            var page = Draw(Personal);
            Assert.That(Gui.Lines, Has.Some.Contains("help Warning: the JDK in the preferences, /nowhere/jdk"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("label  : " + Path.GetFullPath("kotlinc")));
            Gui.Act("JDK", "/elsewhere/jdk");
            Gui.Passes(() => page.OnGUI(""));
            Gui.Clear();
            Gui.Passes(() => page.OnGUI(""));
            Assert.That(Gui.Lines, Has.Some.Contains("/nowhere/jdk"), "the warning must stay, because GUI events must not search the disk");
            Menus.Tick();
            Gui.Clear();
            Gui.Passes(() => page.OnGUI(""));
            Assert.That(Gui.Lines, Has.Some.Contains("help Warning: the JDK in the preferences, /elsewhere/jdk"));
        }

        private static SettingsProvider Draw(string path)
        {
            Gui.Clear();
            var page = Menus.SettingsPages().Find(candidate => candidate.settingsPath == path);
            page.OnActivate("", null);
            Gui.Passes(() => page.OnGUI(""));
            return page;
        }
    }
}
