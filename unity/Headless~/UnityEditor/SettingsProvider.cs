using System.Collections.Generic;
using UnityEngine.UIElements;

namespace UnityEditor
{
    public enum SettingsScope
    {
        User,
        Project,
    }

    public class SettingsProvider
    {
        public string settingsPath { get; }
        public SettingsScope scope { get; }
        public IEnumerable<string> keywords { get; set; }

        public SettingsProvider(string path, SettingsScope scopes, IEnumerable<string> keywords = null)
        {
            settingsPath = path;
            scope = scopes;
            this.keywords = keywords;
        }

        public virtual void OnActivate(string searchContext, VisualElement rootElement) { }
        public virtual void OnDeactivate() { }
        public virtual void OnGUI(string searchContext) { }
        public void Repaint() { }
    }
}
