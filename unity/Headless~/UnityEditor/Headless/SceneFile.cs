using System;
using System.Collections;
using System.Globalization;
using System.IO;
using System.Reflection;
using System.Text.RegularExpressions;
using UnityEngine;

namespace UnityEditor.Headless
{
    /// Reads the prefab instances of a scene, with the texts, numbers and imported assets that the scene assigns to fields of their scripts. Other content
    /// of the scene is ignored.
    static class SceneFile
    {
        internal static void Load(string path)
        {
            var text = File.ReadAllText(Project.FileOf(path));
            foreach (Match instance in Regex.Matches(text, @"^PrefabInstance:\n(?:(?!---).*\n)+", RegexOptions.Multiline))
            {
                var guid = Regex.Match(instance.Value, @"m_SourcePrefab: .*guid: ([0-9a-f]+)").Groups[1].Value;
                var created = PrefabFile.Load(Project.FileOf(Project.PathOf(guid)));
                foreach (Match change in Regex.Matches(instance.Value, @"propertyPath: (.+)\n +value: ?(.*)\n +objectReference: (.*)\n"))
                    Change(created, change.Groups[1].Value.Replace(".Array.data[", "[").Split('.'), Referred(change.Groups[3].Value) ?? change.Groups[2].Value);
            }
        }

        /// Returns the imported object of a reference such as `{fileID: 1, guid: 2, type: 3}`, or null.
        internal static object Referred(string reference)
        {
            var parts = Regex.Match(reference, @"fileID: (-?\d+), guid: ([0-9a-f]+)");
            if (!parts.Success) return null;
            return ImportedAsset.Of(Project.PathOf(parts.Groups[2].Value))?.Find(long.Parse(parts.Groups[1].Value));
        }

        /// Sets the field of the first script that has it.
        static void Change(GameObject created, string[] path, object value)
        {
            foreach (var script in created.GetComponents<MonoBehaviour>())
                if (FieldOf(script, path[0]) != null)
                {
                    Change(script, path, 0, value);
                    return;
                }
        }

        static void Change(object owner, string[] path, int at, object value)
        {
            var element = Regex.Match(path[at], @"^(.+)\[(\d+)\]$");
            var field = FieldOf(owner, element.Success ? element.Groups[1].Value : path[at]);
            // This entry is the size of a list. The entries of its elements follow.
            if (field == null || path[path.Length - 1] == "size") return;
            if (element.Success && IsReference(field)) value = value as UnityEngine.Object;
            if (element.Success) ((IList)field.GetValue(owner)).Insert(int.Parse(element.Groups[2].Value), value);
            else if (at < path.Length - 1) Change(field.GetValue(owner), path, at + 1, value);
            else if (value is UnityEngine.Object) field.SetValue(owner, value);
            else if (field.FieldType.IsEnum) field.SetValue(owner, Enum.Parse(field.FieldType, (string)value));
            else field.SetValue(owner, Convert.ChangeType(value, field.FieldType, CultureInfo.InvariantCulture));
        }

        static bool IsReference(FieldInfo list) => typeof(UnityEngine.Object).IsAssignableFrom(SerializedFields.ElementOf(list.FieldType));

        static FieldInfo FieldOf(object owner, string name) =>
            owner.GetType().GetField(name, BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic);
    }
}
