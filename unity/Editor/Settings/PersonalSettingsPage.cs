using System;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;
using UnityEngine.UIElements;
using Object = UnityEngine.Object;

namespace Collektive.Unity.Editor
{
    /// <summary>The page Preferences &gt; Collektive. It shows the tools in use, and searches for them when it opens and after changes.</summary>
    internal sealed class PersonalSettingsPage : SettingsPage
    {
        private (string Text, bool IsProblem) jdk, kotlin;

        private PersonalSettingsPage() : base("Preferences/Collektive", SettingsScope.User)
        {
        }

        /// <inheritdoc/>
        protected override Object Settings => PersonalSettings.instance;

        [SettingsProvider]
        private static SettingsProvider Make() => new PersonalSettingsPage();

        /// <inheritdoc/>
        public override void OnActivate(string searchContext, VisualElement rootElement)
        {
            base.OnActivate(searchContext, rootElement);
            FindTools();
        }

        /// <inheritdoc/>
        protected override void Draw()
        {
            DrawPath(nameof(PersonalSettings.jdk), "JDK", "Root folder of a JDK 17 or newer. Empty: JAVA_HOME, or the newest installed JDK.");
            DrawTool(jdk);
            DrawPath(nameof(PersonalSettings.kotlin), "Kotlin compiler",
                "The folder kotlinc of a Kotlin compiler. Empty: KOTLIN_HOME, or the compiler on PATH.");
            DrawTool(kotlin);
            DrawPath(nameof(PersonalSettings.sourceCheckout), "Source checkout",
                "Root folder of a clone of the package's repository, for Tools > Collektive > Rebuild Backend. Most projects leave it empty.");
        }

        /// <inheritdoc/>
        protected override void Store()
        {
            PersonalSettings.instance.Store();
            // The tools must not be searched for during a GUI event.
            EditorApplication.delayCall += FindTools;
        }

        private void FindTools()
        {
            jdk = TryFind(Toolchain.FindJdk);
            kotlin = TryFind(() => Toolchain.FindKotlin(AggregateRuntime.BuiltIn));
            Repaint();
        }

        private static (string Text, bool IsProblem) TryFind(Func<string> find)
        {
            try
            {
                return (find(), false);
            }
            catch (ToolException error)
            {
                return (error.Message, true);
            }
        }

        private void DrawPath(string name, string label, string tooltip) =>
            EditorGUILayout.DelayedTextField(Fields.FindProperty(name), new GUIContent(label, tooltip));

        private static void DrawTool((string Text, bool IsProblem) tool)
        {
            if (tool.IsProblem) EditorGUILayout.HelpBox(tool.Text, MessageType.Warning);
            else EditorGUILayout.LabelField(" ", tool.Text);
        }
    }
}
