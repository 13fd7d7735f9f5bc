using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Reflection;
using System.Text.RegularExpressions;
using UnityEngine;

namespace UnityEditor.Headless
{
    /// Reads the objects of a prefab with their components. It supports names, scales and parents, and the fields of scripts that are texts or imported
    /// assets. Fields of scripts can also be written.
    static class PrefabFile
    {
        private const RegexOptions Lines = RegexOptions.Multiline | RegexOptions.Singleline;

        static readonly Dictionary<string, Type> BuiltIn = new Dictionary<string, Type>
        {
            ["MeshFilter"] = typeof(MeshFilter), ["MeshRenderer"] = typeof(MeshRenderer), ["SphereCollider"] = typeof(SphereCollider),
            ["Rigidbody"] = typeof(Rigidbody),
        };

        /// Prefabs that are loaded but not instantiated, with the paths of their files.
        internal static readonly Dictionary<UnityEngine.Object, string> Loaded = new Dictionary<UnityEngine.Object, string>();

        internal static GameObject Load(string path)
        {
            var objects = new Dictionary<string, GameObject>();
            var transforms = new Dictionary<string, Transform>();
            GameObject root = null;
            foreach (Match part in Regex.Matches(File.ReadAllText(path), @"^--- !u!\d+ &(-?\d+)\n(.*?)(?=^---|\z)", Lines))
            {
                var (id, text) = (part.Groups[1].Value, part.Groups[2].Value);
                var type = text.Substring(0, text.IndexOf(':'));
                if (type == "GameObject") objects[id] = Object(Value(text, "m_Name"));
                if (type != "Transform") continue;
                var placed = transforms[id] = objects[Reference(text, "m_GameObject")].transform;
                placed.localScale = Vector(Value(text, "m_LocalScale"));
                if (transforms.TryGetValue(Reference(text, "m_Father"), out var parent)) placed.SetParent(parent, false);
                else root = placed.gameObject;
            }
            foreach (Match part in Regex.Matches(File.ReadAllText(path), @"^--- !u!\d+ &-?\d+\n(.*?)(?=^---|\z)", Lines))
            {
                var text = part.Groups[1].Value;
                var type = text.Substring(0, text.IndexOf(':'));
                if (type == "MonoBehaviour") Read(text, objects[Reference(text, "m_GameObject")].AddComponent(ScriptOf(text)));
                else if (BuiltIn.TryGetValue(type, out var component)) objects[Reference(text, "m_GameObject")].AddComponent(component);
            }
            foreach (var child in objects.Values) child.SetActive(child != root);
            Loaded.Add(root, path);
            return root;
        }

        static void Read(string text, Component script)
        {
            foreach (var field in SerializedFields.FieldsOf(script.GetType()))
            {
                var line = Regex.Match(text, "^  " + field.Name + ": (.*)$", RegexOptions.Multiline);
                if (!line.Success) continue;
                var value = line.Groups[1].Value;
                if (field.FieldType == typeof(string)) field.SetValue(script, value);
                else if (SceneFile.Referred(value) is UnityEngine.Object asset && field.FieldType.IsInstanceOfType(asset)) field.SetValue(script, asset);
            }
        }

        internal static void Save(GameObject prefab)
        {
            var scripts = new Queue<MonoBehaviour>(prefab.GetComponentsInChildren<MonoBehaviour>(true));
            var path = Loaded[prefab];
            var text = File.ReadAllText(path);
            const string behaviour = @"^--- !u!114 &-?\d+\n(.*?)(?=^---|\z)";
            File.WriteAllText(path, Regex.Replace(text, behaviour, part => Written(part.Value, scripts.Dequeue()), Lines));
        }

        static string Written(string text, MonoBehaviour script)
        {
            foreach (var field in SerializedFields.FieldsOf(script.GetType()))
            {
                var value = field.GetValue(script);
                if (value is UnityEngine.Object asset && AssetDatabase.TryGetGUIDAndLocalFileIdentifier(asset, out var guid, out var id))
                    value = "{fileID: " + id + ", guid: " + guid + ", type: 3}";
                if (value is string line) text = Regex.Replace(text, "^  " + field.Name + ":.*$", "  " + field.Name + ": " + line, RegexOptions.Multiline);
            }
            return text;
        }

        /// Creates an object that is inactive, as an asset is. Its copies are active.
        static GameObject Object(string name)
        {
            var created = new GameObject(name);
            created.SetActive(false);
            return created;
        }

        static string Reference(string part, string key) => Regex.Match(Value(part, key), @"fileID: (-?\d+)").Groups[1].Value;

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
