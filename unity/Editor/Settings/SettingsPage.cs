using UnityEditor;
using UnityEngine;
using UnityEngine.UIElements;

namespace Collektive.Unity.Editor
{
    /// <summary>A page for settings in a file. The file is written when the user commits a field, and after Undo.</summary>
    internal abstract class SettingsPage : SettingsProvider
    {
        protected SettingsPage(string path, SettingsScope scope)
            : base(path, scope, new[] { "Collektive", "Kotlin", "JDK", "JVM", "program", "schema" })
        {
        }

        protected SerializedObject Fields { get; private set; }

        /// <inheritdoc/>
        public override void OnActivate(string searchContext, VisualElement rootElement)
        {
            Fields = new SerializedObject(Settings);
            Undo.undoRedoPerformed += Store;
        }

        /// <inheritdoc/>
        public override void OnDeactivate() => Undo.undoRedoPerformed -= Store;

        /// <inheritdoc/>
        public override void OnGUI(string searchContext)
        {
            Fields.Update();
            Draw();
            if (Fields.ApplyModifiedProperties()) Store();
        }

        protected abstract Object Settings { get; }

        protected abstract void Draw();

        /// <summary>Saves the changed settings.</summary>
        protected abstract void Store();
    }
}
