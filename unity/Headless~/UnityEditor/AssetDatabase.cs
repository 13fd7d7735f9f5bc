using System.IO;
using UnityEditor.Headless;
using UnityEngine;

namespace UnityEditor
{
    public sealed class AssetDatabase
    {
        public static string GUIDToAssetPath(string guid) => Project.PathOf(guid);

        /// Prefabs become objects that are in no scene; any other file that exists is an asset without content.
        public static T LoadAssetAtPath<T>(string assetPath) where T : Object
        {
            var file = string.IsNullOrEmpty(assetPath) ? "" : Project.FileOf(assetPath);
            if (!File.Exists(file)) return null;
            if (typeof(T) == typeof(GameObject)) return assetPath.EndsWith(".prefab") ? (T)(Object)PrefabFile.Load(file) : null;
            return typeof(T).IsAssignableFrom(typeof(PlainAsset)) ? (T)(Object)new PlainAsset { name = Path.GetFileNameWithoutExtension(file) } : null;
        }

        public static void Refresh() => Project.Refreshes++;
        public static void ImportAsset(string path) => Project.Imported.Add(path);

        sealed class PlainAsset : Object { }
    }
}
