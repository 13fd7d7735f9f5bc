using System;
using System.Collections.Generic;
using System.Reflection;
using Collektive.Bridge;

namespace Collektive.Headless
{
    /// <summary>
    /// Compares the static fields of a scene's scripts before and after a run. It can compare numbers, strings, structs of these, and arrays of them. If the
    /// scripts have another static field, such as a list, or a reference that <see cref="ScriptReferences"/> does not allow, each run needs its own process.
    /// </summary>
    internal sealed class ScriptState
    {
        private const BindingFlags StaticFields = BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Static | BindingFlags.DeclaredOnly;

        private const BindingFlags InstanceFields = BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Instance;

        private readonly List<KeyValuePair<FieldInfo, object>> before = new List<KeyValuePair<FieldInfo, object>>();

        internal ScriptState(Assembly scripts)
        {
            Problem = ScriptReferences.FindProblem(scripts);
            foreach (var type in scripts.GetTypes())
            {
                if (type.ContainsGenericParameters || ScriptReferences.IsStateless(type)) continue;
                foreach (var field in type.GetFields(StaticFields))
                {
                    if (!field.IsLiteral && !IsComparable(field)) Problem = Problem ?? type.FullName + "." + field.Name;
                }
            }
            // Reading a field runs the initialiser of its type. With a problem, each run has its own process, in which initialisers must not run early.
            if (Problem != null) return;
            foreach (var type in scripts.GetTypes())
            {
                if (type.ContainsGenericParameters || ScriptReferences.IsStateless(type)) continue;
                foreach (var field in type.GetFields(StaticFields))
                {
                    if (field.IsLiteral || IsLambda(field)) continue;
                    var value = field.GetValue(null);
                    if (value is Delegate method && HasTarget(method)) Problem = type.FullName + "." + field.Name;
                    before.Add(new KeyValuePair<FieldInfo, object>(field, value is Array array ? array.Clone() : value));
                }
            }
        }

        /// <summary>The part of the scripts that could leave state which cannot be compared; null if none.</summary>
        internal string Problem { get; }

        /// <summary>Whether the static fields have the same values as before the first run.</summary>
        internal bool IsUnchanged => Problem == null && before.TrueForAll(field => AreEqual(field.Value, field.Key.GetValue(null)));

        private static bool IsComparable(FieldInfo field) =>
            IsLambda(field) || IsValueData(field.FieldType) || field.FieldType.IsArray && IsValueData(field.FieldType.GetElementType())
                || field.IsInitOnly && IsWithoutState(field.FieldType);

        /// <summary>Returns whether the compiler generated a field to cache a lambda that captures no variables.</summary>
        private static bool IsLambda(FieldInfo field) =>
            field.Name.StartsWith("<>", StringComparison.Ordinal) && typeof(Delegate).IsAssignableFrom(field.FieldType);

        /// <summary>Compares all bits, because scripts can define which of their structs are equal, and 0 equals -0.</summary>
        private static bool AreEqual(object before, object now)
        {
            if (before is Array was && now is Array isNow)
            {
                if (was.Length != isNow.Length || was.Rank != 1 || isNow.Rank != 1) return false;
                for (var i = 0; i < was.Length; i++)
                {
                    if (!AreEqual(was.GetValue(i), isNow.GetValue(i))) return false;
                }
                return true;
            }
            if (before is double number && now is double other) return BitConverter.DoubleToInt64Bits(number) == BitConverter.DoubleToInt64Bits(other);
            if (before is float single && now is float otherSingle) return AreEqual((double)single, (double)otherSingle);
            if (!(before is ValueType) || !(now is ValueType) || before.GetType().IsPrimitive || before is Enum) return Equals(before, now);
            return Array.TrueForAll(before.GetType().GetFields(InstanceFields), field => AreEqual(field.GetValue(before), field.GetValue(now)));
        }

        /// <summary>Returns whether a type is a delegate or used by the generated code of a schema.</summary>
        private static bool IsWithoutState(Type type) =>
            typeof(Delegate).IsAssignableFrom(type) || type == typeof(RowLayout) || type == typeof(TableShape);

        /// <summary>Returns whether a delegate contains an object that could change, such as a boxed struct.</summary>
        private static bool HasTarget(Delegate method) =>
            Array.Exists(method.GetInvocationList(), one => one.Target != null && !ScriptReferences.IsStateless(one.Target.GetType()));

        private static bool IsValueData(Type type)
        {
            if (type.IsPrimitive || type.IsEnum || type == typeof(string)) return true;
            if (!type.IsValueType) return false;
            foreach (var field in type.GetFields(InstanceFields))
            {
                if (field.FieldType != type && !IsValueData(field.FieldType)) return false;
            }
            return true;
        }
    }
}
