using System;
using System.Collections.Generic;
using System.IO;
using UnityEngine;

namespace UnityEditor
{
    public enum BuildTarget
    {
        StandaloneOSX = 2,
        StandaloneWindows = 5,
        StandaloneWindows64 = 19,
        StandaloneLinux64 = 24,
        LinuxHeadlessSimulation = 41,
        EmbeddedLinux = 45,
        NoTarget = -2,
    }

    public class BuildPipeline
    {
        public static string GetBuildTargetName(BuildTarget targetPlatform) =>
            targetPlatform == BuildTarget.StandaloneWindows64 ? "Win64" : targetPlatform == BuildTarget.StandaloneOSX ? "OSXUniversal"
                : targetPlatform == BuildTarget.StandaloneLinux64 ? "Linux64" : targetPlatform.ToString();
    }

    public class EditorUserBuildSettings
    {
        static readonly Dictionary<(string, string), string> Settings = new Dictionary<(string, string), string>();

        public static string GetPlatformSettings(string platformName, string name) => Settings.TryGetValue((platformName, name), out var value) ? value : "";
        public static void SetPlatformSettings(string platformName, string name, string value) => Settings[(platformName, name)] = value;
    }

    public struct BuildPlayerOptions
    {
        public string[] scenes { get; set; }
        public BuildTarget target { get; set; }
    }
}

namespace UnityEditor.Build
{
    public interface IOrderedCallback
    {
        int callbackOrder { get; }
    }

    public abstract class BuildPlayerProcessor : IOrderedCallback
    {
        public virtual int callbackOrder => 0;

        public abstract void PrepareForBuild(BuildPlayerContext buildPlayerContext);
    }

    public sealed class BuildPlayerContext
    {
        readonly string streamingAssets;

        internal BuildPlayerContext(BuildPlayerOptions options, string streamingAssets)
        {
            BuildPlayerOptions = options;
            this.streamingAssets = streamingAssets;
        }

        public BuildPlayerOptions BuildPlayerOptions { get; }

        /// Adds a file or a folder whose name must be unique. It is copied immediately, whereas Unity copies it later.
        public void AddAdditionalPathToStreamingAssets(string directoryOrFile, string pathInStreamingAssets = null)
        {
            if (File.Exists(directoryOrFile))
            {
                var target = Path.Combine(streamingAssets, pathInStreamingAssets ?? Path.GetFileName(directoryOrFile));
                if (File.Exists(target)) throw new ArgumentException("a file of this name already exists: " + target);
                Directory.CreateDirectory(Path.GetDirectoryName(target));
                File.Copy(directoryOrFile, target);
                return;
            }
            if (!Directory.Exists(directoryOrFile)) throw new FileNotFoundException("No such file or directory.", directoryOrFile);
            foreach (var file in Directory.GetFiles(directoryOrFile, "*", SearchOption.AllDirectories))
                AddAdditionalPathToStreamingAssets(file, Path.Combine(pathInStreamingAssets ?? "", file.Substring(directoryOrFile.Length).TrimStart('/')));
        }
    }

    public class BuildFailedException : Exception
    {
        public BuildFailedException(string message) : base(message) { }
        public BuildFailedException(Exception innerException) : base(null, innerException) { }
    }
}
