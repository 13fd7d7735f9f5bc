using System;
using System.Collections.Generic;

namespace UnityEditor
{
    public enum SettingsScope
    {
        User,
        Project,
    }

    public class SettingsProvider
    {
        public string label { get; set; }
        public string settingsPath { get; }
        public SettingsScope scope { get; }
        public IEnumerable<string> keywords { get; set; }
        public Action<string> guiHandler { get; set; }

        public SettingsProvider(string path, SettingsScope scopes, IEnumerable<string> keywords = null)
        {
            settingsPath = path;
            scope = scopes;
            this.keywords = keywords;
        }
    }
}
