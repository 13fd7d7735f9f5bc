using System;
using System.Collections.Generic;
using System.ComponentModel;
using System.Globalization;
using System.Reflection;
using System.Text;

namespace Collektive.Unity.PublicApi.Tests
{
    /// <summary>Lists the public and protected members of an assembly as sorted text, one per line.</summary>
    internal static class PublicApi
    {
        private const BindingFlags Declared =
            BindingFlags.Instance | BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

        /// <summary>Returns the list for the public types in Collektive's namespaces, except types that only generated code needs.</summary>
        internal static string Of(Assembly assembly)
        {
            var lines = new List<string>();
            foreach (var type in assembly.GetExportedTypes())
            {
                if (type.Namespace == null || !type.Namespace.StartsWith("Collektive.", StringComparison.Ordinal) || IsHidden(type)) continue;
                lines.Add(Name(type) + " : " + Kind(type));
                foreach (var member in type.GetMembers(Declared))
                {
                    var text = IsHidden(member) ? null : Text(member);
                    if (text != null) lines.Add(Name(type) + "." + text);
                }
            }
            lines.Sort(StringComparer.Ordinal);
            return string.Join("\n", lines) + "\n";
        }

        private static bool IsHidden(MemberInfo member) => member.GetCustomAttribute<EditorBrowsableAttribute>()?.State == EditorBrowsableState.Never;

        private static string Kind(Type type)
        {
            if (type.IsEnum) return "enum";
            var kind = type.IsInterface ? "interface" : type.IsValueType ? "struct" : type.IsAbstract && type.IsSealed ? "static class" : type.IsAbstract
                ? "abstract class" : type.IsSealed ? "sealed class" : "class";
            return type.BaseType == null || type.IsValueType || type.BaseType == typeof(object) ? kind : kind + ", " + Name(type.BaseType);
        }

        /// <summary>Returns a member as text, or null if it is not visible to users.</summary>
        private static string Text(MemberInfo member)
        {
            switch (member)
            {
                case FieldInfo field:
                    if (!field.IsPublic && !field.IsFamily || field.IsSpecialName) return null;
                    return field.Name + " : " + (field.IsStatic ? "static " : "") + Name(field.FieldType);
                case PropertyInfo property:
                    var get = IsVisible(property.GetMethod) ? "get; " : "";
                    var set = IsVisible(property.SetMethod) ? "set; " : "";
                    return get + set == "" ? null : property.Name + Parameters(property.GetIndexParameters(), "[", "]") + " : " + Name(property.PropertyType)
                        + " { " + get + set + "}";
                case EventInfo happening:
                    return IsVisible(happening.AddMethod) ? happening.Name + " : event " + Name(happening.EventHandlerType) : null;
                case ConstructorInfo constructor:
                    return IsVisible(constructor) ? "new" + Parameters(constructor.GetParameters(), "(", ")") : null;
                case MethodInfo method:
                    // Accessors are skipped, because they are listed with their property or event. Operators are listed as methods.
                    if (!IsVisible(method) || method.IsSpecialName && !method.Name.StartsWith("op_", StringComparison.Ordinal)) return null;
                    var style = method.IsStatic ? "static " : method.IsAbstract ? "abstract " : method.IsVirtual && !method.IsFinal ? "virtual " : "";
                    return method.Name + Generics(method) + Parameters(method.GetParameters(), "(", ")") + " : " + style + Name(method.ReturnType);
                default:
                    return null;
            }
        }

        private static bool IsVisible(MethodBase method) => method != null && (method.IsPublic || method.IsFamily || method.IsFamilyOrAssembly);

        private static string Generics(MethodInfo method) =>
            method.IsGenericMethod ? "<" + string.Join(", ", Array.ConvertAll(method.GetGenericArguments(), Name)) + ">" : "";

        private static string Parameters(ParameterInfo[] parameters, string open, string close)
        {
            if (parameters.Length == 0 && open == "[") return "";
            var parts = Array.ConvertAll(parameters, parameter => Name(parameter.ParameterType) + " " + parameter.Name
                + (parameter.IsOptional ? " = " + Convert.ToString(parameter.DefaultValue ?? "null", CultureInfo.InvariantCulture) : ""));
            return open + string.Join(", ", parts) + close;
        }

        private static string Name(Type type)
        {
            if (type.IsByRef) return "ref " + Name(type.GetElementType());
            if (type.IsArray) return Name(type.GetElementType()) + "[]";
            if (type.IsGenericParameter) return type.Name;
            var text = new StringBuilder((type.IsNested ? Name(type.DeclaringType) : type.Namespace) + ".");
            text.Append(type.Name.Split('`')[0]);
            if (type.IsGenericType) text.Append('<').Append(string.Join(", ", Array.ConvertAll(type.GetGenericArguments(), Name))).Append('>');
            return text.ToString();
        }
    }
}
