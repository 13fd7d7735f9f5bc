using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Text;
using UnityEditor.AssetImporters;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor.Headless
{
    /// The objects that a scripted importer created from a file. As in Unity, a later import changes the existing objects, so that references to them remain
    /// valid.
    sealed class ImportedAsset
    {
        static readonly Dictionary<string, ImportedAsset> Known = new Dictionary<string, ImportedAsset>();

        readonly SortedDictionary<string, Object> objects = new SortedDictionary<string, Object>(StringComparer.Ordinal);

        internal Object Main { get; private set; }

        internal IEnumerable<Object> Objects => objects.Values;

        internal static bool IsImportable(string path) => ImporterOf(path) != null;

        /// Returns the asset, importing it if needed; null if no importer handles the file.
        internal static ImportedAsset Of(string path)
        {
            var key = KeyOf(path);
            if (!Known.TryGetValue(key, out var asset) && ImporterOf(path) is Type importer && File.Exists(key))
            {
                Known[key] = asset = new ImportedAsset();
                asset.Import(path, importer);
            }
            return asset;
        }

        internal static void Reimport(string path)
        {
            if (Known.TryGetValue(KeyOf(path), out var asset)) asset.Import(path, ImporterOf(path));
            else Of(path);
        }

        internal static string PathOf(Object asset)
        {
            foreach (var known in Known)
            {
                if (known.Value.objects.ContainsValue(asset)) return Path.GetRelativePath(Directory.GetCurrentDirectory(), known.Key);
            }
            return "";
        }

        /// Returns the full path of an asset. Tests use different projects, so relative paths are not unique.
        static string KeyOf(string path) => Path.GetFullPath(Project.FileOf(path));

        /// Returns the object that scenes refer to by the given id.
        internal Object Find(long fileId)
        {
            foreach (var part in objects)
                if (IdOf(part.Key) == fileId) return part.Value;
            return null;
        }

        internal long IdOf(Object asset)
        {
            foreach (var part in objects)
                if (part.Value == asset) return IdOf(part.Key);
            return 0;
        }

        /// Returns the id of a ScriptableObject that an importer adds with the given identifier.
        static long IdOf(string identifier) => (long)XxHash64.Of(Encoding.UTF8.GetBytes("Type:MonoBehaviour->" + identifier + "0"));

        void Import(string path, Type importer)
        {
            var context = new AssetImportContext(path);
            AssetState.Import(() => ((ScriptedImporter)Activator.CreateInstance(importer, true)).OnImportAsset(context));
            foreach (var identifier in new List<string>(objects.Keys))
            {
                if (context.Objects.ContainsKey(identifier)) continue;
                Object.DestroyImmediate(objects[identifier], true);
                objects.Remove(identifier);
            }
            var replacements = new Dictionary<Object, Object>();
            foreach (var created in context.Objects)
            {
                if (objects.TryGetValue(created.Key, out var old)) replacements[created.Value] = old;
                else objects[created.Key] = created.Value;
            }
            foreach (var created in context.Objects.Values) Move(created, replacements.TryGetValue(created, out var old) ? old : created, replacements);
            Main = replacements.TryGetValue(context.mainObject, out var main) ? main : context.mainObject;
        }

        /// Copies the name and the serialised fields. References to new objects are replaced with references to the existing objects.
        static void Move(Object from, Object to, Dictionary<Object, Object> replacements)
        {
            to.name = from.name;
            foreach (var field in from.GetType().GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
            {
                var value = field.GetValue(from);
                if (value is Object single && replacements.TryGetValue(single, out var old)) value = old;
                if (value is Object[] many)
                    for (var i = 0; i < many.Length; i++)
                        if (replacements.TryGetValue(many[i], out old)) many[i] = old;
                field.SetValue(to, value);
            }
        }

        static Type ImporterOf(string path)
        {
            foreach (var type in Menus.EditorTypes())
            {
                var mark = type.GetCustomAttribute<ScriptedImporterAttribute>();
                if (mark != null && Array.Exists(mark.fileExtensions, extension => path.EndsWith("." + extension, StringComparison.Ordinal))) return type;
            }
            return null;
        }
    }
}
