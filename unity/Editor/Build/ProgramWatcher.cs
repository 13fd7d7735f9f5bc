using System;
using System.Collections.Generic;
using UnityEditor;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Builds programs when their Kotlin files or their schema changed. Also runs after a reload of code, because the reload may have interrupted a build.
    /// </summary>
    internal sealed class ProgramWatcher : AssetPostprocessor
    {
        private static void OnPostprocessAllAssets(
            string[] importedAssets, string[] deletedAssets, string[] movedAssets, string[] movedFromAssetPaths, bool didDomainReload)
        {
            var changed = new List<string>();
            foreach (var paths in new[] { importedAssets, deletedAssets, movedAssets, movedFromAssetPaths })
                changed.AddRange(Array.FindAll(paths, IsSource));
            // The call is delayed, because an import may be running now.
            if (changed.Count > 0 || didDomainReload) EditorApplication.delayCall += () => ProgramBuild.StartOutdated(changed);
        }

        private static bool IsSource(string path) => path.StartsWith("Assets/", StringComparison.Ordinal)
            && (path.EndsWith(".kt", StringComparison.Ordinal) || path.EndsWith(".fbs", StringComparison.Ordinal));
    }
}
