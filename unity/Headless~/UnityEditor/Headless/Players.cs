using System;
using System.Collections.Generic;
using UnityEditor.Build;

namespace UnityEditor.Headless
{
    /// Simulates player builds, as far as they involve the package.
    public static class Players
    {
        /// Calls all build processors in order, and copies the files that they add to the streaming assets.
        public static void Build(BuildTarget target, string streamingAssets, params string[] scenes)
        {
            var processors = new List<BuildPlayerProcessor>();
            foreach (var type in Menus.EditorTypes())
                if (!type.IsAbstract && typeof(BuildPlayerProcessor).IsAssignableFrom(type))
                    processors.Add((BuildPlayerProcessor)Activator.CreateInstance(type, true));
            processors.Sort((a, b) => a.callbackOrder.CompareTo(b.callbackOrder));
            var context = new BuildPlayerContext(new BuildPlayerOptions { target = target, scenes = scenes }, streamingAssets);
            foreach (var processor in processors) processor.PrepareForBuild(context);
        }
    }
}
