using System;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.CompilerServices;
using Collektive.Bridge;

namespace Collektive.Headless
{
    /// <summary>
    /// The static fields of a scene's scripts, which a run could leave changed to the next one in the process. Fields are compared that hold numbers, texts,
    /// structs of these, and arrays of all that; with any other field, a list for instance, each run needs a process of its own.
    /// </summary>
    internal sealed class ScriptState
    {
        private const BindingFlags Statics = BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Static | BindingFlags.DeclaredOnly;

        private readonly List<KeyValuePair<FieldInfo, object>> before = new List<KeyValuePair<FieldInfo, object>>();
        private readonly bool isKnown = true;

        internal ScriptState(Assembly scripts)
        {
            foreach (var type in scripts.GetTypes())
            {
                if (type.ContainsGenericParameters) continue;
                // Delegates that the compiler keeps are made of no state.
                if (type.IsDefined(typeof(CompilerGeneratedAttribute), false)) continue;
                foreach (var field in type.GetFields(Statics))
                {
                    if (field.IsLiteral) continue;
                    var value = field.GetValue(null);
                    before.Add(new KeyValuePair<FieldInfo, object>(field, value is Array array ? array.Clone() : value));
                    isKnown &= IsPlain(field.FieldType) || field.FieldType.IsArray && IsPlain(field.FieldType.GetElementType())
                        || field.IsInitOnly && IsWithoutState(field.FieldType);
                }
            }
        }

        /// <summary>Whether the fields are as they were.</summary>
        internal bool IsUnchanged => isKnown && before.TrueForAll(field => AreEqual(field.Value, field.Key.GetValue(null)));

        private static bool AreEqual(object before, object now)
        {
            if (!(before is Array was) || !(now is Array isNow)) return Equals(before, now);
            if (was.Length != isNow.Length || was.Rank != 1 || isNow.Rank != 1) return false;
            for (var i = 0; i < was.Length; i++)
            {
                if (!Equals(was.GetValue(i), isNow.GetValue(i))) return false;
            }
            return true;
        }

        /// <summary>Delegates, and what generated code tells the bridge of the schema.</summary>
        private static bool IsWithoutState(Type type) => typeof(Delegate).IsAssignableFrom(type) || type.Assembly == typeof(DataSchema).Assembly;

        private static bool IsPlain(Type type)
        {
            if (type.IsPrimitive || type.IsEnum || type == typeof(string)) return true;
            if (!type.IsValueType) return false;
            foreach (var field in type.GetFields(BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Instance))
            {
                if (field.FieldType != type && !IsPlain(field.FieldType)) return false;
            }
            return true;
        }
    }
}
