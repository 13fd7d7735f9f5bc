using System;
using System.Collections.Generic;
using System.IO;
using System.Text.RegularExpressions;
using UnityEditor.Headless;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public sealed class AssetDatabase
    {
        public static string GUIDToAssetPath(string guid)
        {
            AssetState.CheckCall();
            return Project.PathOf(guid);
        }

        public static string AssetPathToGUID(string path)
        {
            AssetState.CheckCall();
            return Project.GuidOf(path);
        }

        public static string GetAssetPath(Object assetObject)
        {
            AssetState.CheckCall();
            return ImportedAsset.PathOf(assetObject);
        }

        public static bool TryGetGUIDAndLocalFileIdentifier(Object obj, out string guid, out long localId)
        {
            var path = GetAssetPath(obj);
            guid = path.Length > 0 ? AssetPathToGUID(path) : new string('0', 32);
            localId = path.Length > 0 ? ImportedAsset.Of(path).IdOf(obj) : 0;
            return path.Length > 0;
        }

        public static void ImportAsset(string path)
        {
            AssetState.CheckChange();
            Project.Imported.Add(path);
            ImportedAsset.Reimport(path);
        }

        /// Supports prefabs only.
        public static void SaveAssetIfDirty(Object obj)
        {
            AssetState.CheckChange();
            PrefabFile.Save(RootOf(obj));
        }

        /// Supports prefabs only.
        public static bool Contains(Object obj) => EditorUtility.IsPersistent(RootOf(obj));

        static UnityEngine.GameObject RootOf(Object obj) =>
            (obj is UnityEngine.Component part ? part.transform : ((UnityEngine.GameObject)obj).transform).root.gameObject;

        /// Loads a prefab as objects outside any scene, and other assets through their importers. An existing file without an importer is an asset without
        /// content.
        public static T LoadAssetAtPath<T>(string assetPath) where T : Object
        {
            AssetState.CheckCall();
            var file = string.IsNullOrEmpty(assetPath) ? "" : Project.FileOf(assetPath);
            if (!File.Exists(file)) return null;
            if (typeof(T) == typeof(UnityEngine.GameObject)) return assetPath.EndsWith(".prefab") ? (T)(Object)PrefabFile.Load(file) : null;
            if (ImportedAsset.Of(assetPath) is ImportedAsset imported) return imported.Main as T;
            return typeof(T).IsAssignableFrom(typeof(PlainAsset)) ? (T)(Object)new PlainAsset { name = Path.GetFileNameWithoutExtension(file) } : null;
        }

        /// Returns the paths of the given assets and of the assets that their YAML refers to.
        public static string[] GetDependencies(string[] pathNames, bool recursive)
        {
            AssetState.CheckCall();
            var found = new List<string>(pathNames);
            for (var i = 0; i < found.Count && recursive; i++)
            {
                if (!found[i].EndsWith(".unity") && !found[i].EndsWith(".prefab")) continue;
                foreach (Match reference in Regex.Matches(File.ReadAllText(Project.FileOf(found[i])), "guid: ([0-9a-f]{32})"))
                {
                    var path = Project.PathOf(reference.Groups[1].Value);
                    if (path.Length > 0 && !found.Contains(path)) found.Add(path);
                }
            }
            return found.ToArray();
        }

        /// Supports only the filter "t:TYPE" for types that importers create.
        public static string[] FindAssets(string filter)
        {
            var found = new List<string>();
            foreach (var file in Directory.Exists("Assets") ? Directory.GetFiles("Assets", "*", SearchOption.AllDirectories) : new string[0])
            {
                var path = file.Replace('\\', '/');
                if (ImportedAsset.IsImportable(path) && "t:" + ImportedAsset.Of(path).Main.GetType().Name == filter) found.Add(AssetPathToGUID(path));
            }
            found.Sort(StringComparer.Ordinal);
            return found.ToArray();
        }

        public static void Refresh()
        {
            AssetState.CheckChange();
            Project.Refreshes++;
        }

        sealed class PlainAsset : Object { }
    }
}
