using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Reflection;
using System.Text.RegularExpressions;
using UnityEngine;

namespace UnityEditor.Headless
{
    /// Reads a prefab of one GameObject: its name, place, and components. Of the components' fields it takes Unity's own no further.
    static class PrefabFile
    {
        static readonly Dictionary<string, Type> BuiltIn = new Dictionary<string, Type>
        {
            ["MeshFilter"] = typeof(MeshFilter), ["MeshRenderer"] = typeof(MeshRenderer), ["SphereCollider"] = typeof(SphereCollider),
            ["Rigidbody"] = typeof(Rigidbody),
        };

        /// Prefabs that are loaded and were not instantiated.
        internal static readonly HashSet<UnityEngine.Object> Loaded = new HashSet<UnityEngine.Object>();

        internal static GameObject Load(string path)
        {
            var made = new GameObject();
            Loaded.Add(made);
            // Like an asset it takes part in nothing; its copies do.
            made.SetActive(false);
            foreach (var part in Regex.Split(File.ReadAllText(path), @"^--- !u!\d+ &-?\d+\n", RegexOptions.Multiline))
            {
                var type = part.Substring(0, part.IndexOf(':'));
                if (type == "GameObject") made.name = Value(part, "m_Name");
                else if (type == "Transform") made.transform.localScale = Vector(Value(part, "m_LocalScale"));
                else if (type == "MonoBehaviour") made.AddComponent(ScriptOf(part));
                else if (BuiltIn.TryGetValue(type, out var component)) made.AddComponent(component);
            }
            return made;
        }

        static Type ScriptOf(string part)
        {
            var guid = Regex.Match(part, "m_Script: .*guid: ([0-9a-f]+)").Groups[1].Value;
            var name = Path.GetFileNameWithoutExtension(Project.PathOf(guid));
            foreach (var assembly in AppDomain.CurrentDomain.GetAssemblies())
            {
                foreach (var type in TypesOf(assembly))
                    if (type.Name == name && typeof(MonoBehaviour).IsAssignableFrom(type)) return type;
            }
            throw new InvalidOperationException("the script with GUID " + guid + " (" + name + ") is missing");
        }

        static Type[] TypesOf(Assembly assembly) => assembly.IsDynamic ? Type.EmptyTypes : assembly.GetTypes();

        static string Value(string part, string key) => Regex.Match(part, "^  " + key + ": (.*)$", RegexOptions.Multiline).Groups[1].Value;

        static Vector3 Vector(string text)
        {
            var numbers = Regex.Matches(text, @"[xyz]: (-?[0-9.]+)");
            float Number(int index) => float.Parse(numbers[index].Groups[1].Value, CultureInfo.InvariantCulture);
            return new Vector3(Number(0), Number(1), Number(2));
        }
    }
}
