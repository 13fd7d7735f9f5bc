using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The page Project Settings &gt; Collektive.</summary>
    internal sealed class ProjectSettingsPage : SettingsPage
    {
        private ProjectSettingsPage() : base("Project/Collektive", SettingsScope.Project)
        {
        }

        /// <inheritdoc/>
        protected override Object Settings => ProjectSettings.instance;

        [SettingsProvider]
        private static SettingsProvider Make() => new ProjectSettingsPage();

        /// <inheritdoc/>
        protected override void Draw()
        {
            EditorGUILayout.PropertyField(Fields.FindProperty(nameof(ProjectSettings.whenProgramsFail)), new GUIContent("Play Previous Programs",
                "Whether Play starts with the previous programs when the current ones do not compile."), true);
            EditorGUILayout.PropertyField(Fields.FindProperty(nameof(ProjectSettings.reloadWhilePlaying)), new GUIContent("Reload While Playing",
                "Whether a running simulation loads programs that you save during Play. Nodes keep their state."), true);
        }

        /// <inheritdoc/>
        protected override void Store() => ProjectSettings.instance.Store();
    }
}
