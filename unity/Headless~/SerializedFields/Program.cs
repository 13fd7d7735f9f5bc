using System;
using System.Collections.Generic;
using System.Reflection;
using UnityEngine;

/// Prints the serialised fields of the components and assets in assemblies, for the validator: one line for each class,
/// "class FULL.NAME KIND", followed by "  PATH KIND" for its fields, those of nested classes as "outer.inner".
/// Usage: Collektive.SerializedFields.exe ASSEMBLY...
static class Program
{
    /// Unity's limit of nested types.
    const int MaxDepth = 10;

    static int Main(string[] arguments)
    {
        foreach (var path in arguments)
        {
            var types = Assembly.LoadFrom(path).GetTypes();
            Array.Sort(types, (a, b) => string.CompareOrdinal(a.FullName, b.FullName));
            foreach (var type in types)
            {
                var isComponent = typeof(MonoBehaviour).IsAssignableFrom(type);
                if (type.IsAbstract || type.ContainsGenericParameters || !isComponent && !typeof(ScriptableObject).IsAssignableFrom(type)) continue;
                Console.WriteLine("class " + type.FullName + " " + (isComponent ? "component" : "asset"));
                Print(type, "", 0);
            }
        }
        return 0;
    }

    static void Print(Type type, string prefix, int depth)
    {
        foreach (var field in FieldsOf(type))
        {
            var kind = KindOf(field.FieldType);
            if (kind == null) continue;
            Console.WriteLine("  " + prefix + field.Name + " " + kind);
            var nested = kind == "list" ? ElementOf(field.FieldType) : field.FieldType;
            if (KindOf(nested) == "fields" && depth < MaxDepth) Print(nested, prefix + field.Name + ".", depth + 1);
        }
    }

    /// Base classes first, as Unity writes them.
    static List<FieldInfo> FieldsOf(Type type)
    {
        var fields = new List<FieldInfo>();
        for (var level = type; level != null && level.Assembly != typeof(MonoBehaviour).Assembly && level != typeof(object); level = level.BaseType)
        {
            var own = new List<FieldInfo>();
            foreach (var field in level.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
            {
                var wanted = field.IsPublic || field.IsDefined(typeof(SerializeField), false);
                if (wanted && !field.IsInitOnly && !field.IsDefined(typeof(NonSerializedAttribute), false)) own.Add(field);
            }
            fields.InsertRange(0, own);
        }
        return fields;
    }

    /// The form of the value in YAML; null if Unity does not serialise the field.
    static string KindOf(Type type)
    {
        if (type.IsEnum || type.IsPrimitive) return "number";
        if (type == typeof(string)) return "text";
        if (typeof(UnityEngine.Object).IsAssignableFrom(type)) return "reference";
        if (ElementOf(type) is Type element) return ElementOf(element) == null && KindOf(element) != null ? "list" : null;
        if (type.Assembly == typeof(MonoBehaviour).Assembly && type.IsValueType) return "value";
        if (type.IsDefined(typeof(SerializableAttribute), false) && !type.IsAbstract && !type.IsGenericType && !typeof(Delegate).IsAssignableFrom(type))
            return "fields";
        return null;
    }

    static Type ElementOf(Type type)
    {
        if (type.IsArray) return type.GetArrayRank() == 1 ? type.GetElementType() : null;
        return type.IsGenericType && type.GetGenericTypeDefinition() == typeof(List<>) ? type.GetGenericArguments()[0] : null;
    }
}
