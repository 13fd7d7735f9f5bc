using System;
using System.Collections.Generic;
using System.Reflection;
using System.Reflection.Emit;
using System.Runtime.CompilerServices;
using Collektive.Bridge;

namespace Collektive.Headless
{
    /// <summary>
    /// Checks the types and members to which compiled scripts refer. If one of them may leave state in the process, such as a culture, a thread or an
    /// environment variable, each run needs its own process.
    /// </summary>
    internal static class ScriptReferences
    {
        private const int TypeReferences = 0x01000000;
        private const int MemberReferences = 0x0A000000;
        private const BindingFlags All =
            BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Static | BindingFlags.Instance | BindingFlags.DeclaredOnly;

        private static readonly HashSet<string> Assemblies = new HashSet<string>
        {
            "Collektive.FlatBuffers", "Collektive.Bridge", "Collektive.Unity", "UnityEngine",
        };

        private static readonly HashSet<string> Namespaces = new HashSet<string> { "System.Collections", "System.Collections.Generic", "System.Linq" };

        private static readonly HashSet<string> SystemTypes = new HashSet<string>((
            "Object String Boolean Byte SByte Char Int16 UInt16 Int32 UInt32 Int64 UInt64 Single Double Decimal Void Math MathF Array Enum ValueType "
            + "Nullable`1 IDisposable IComparable IComparable`1 IEquatable`1 IFormattable IFormatProvider Delegate MulticastDelegate EventHandler "
            + "EventHandler`1 EventArgs Predicate`1 Comparison`1 Converter`2 Exception ArgumentException ArgumentNullException "
            + "ArgumentOutOfRangeException InvalidOperationException NotSupportedException NotImplementedException IndexOutOfRangeException "
            + "FormatException Index Range Span`1 ReadOnlySpan`1 ArraySegment`1 Random StringComparison StringComparer Convert HashCode "
            + "RuntimeTypeHandle RuntimeFieldHandle TimeSpan StringSplitOptions MidpointRounding").Split(' '));

        /// <summary>Generic types with any number of parameters.</summary>
        private static readonly HashSet<string> GenericTypes = new HashSet<string> { "Action", "Func", "Tuple", "ValueTuple" };

        /// <summary>Types of which scripts may use only the named members.</summary>
        private static readonly Dictionary<string, string> Members = new Dictionary<string, string>
        {
            ["System.Threading.Interlocked"] = "CompareExchange",
            ["System.Environment"] = "get_CurrentManagedThreadId get_NewLine",
            ["System.Type"] = "GetTypeFromHandle get_Name get_FullName op_Equality op_Inequality",
            ["System.Console"] = "Write WriteLine",
            ["System.Globalization.CultureInfo"] = "get_InvariantCulture",
            ["System.Globalization.NumberFormatInfo"] = "get_InvariantInfo",
            ["System.Runtime.CompilerServices.RuntimeHelpers"] = "InitializeArray",
        };

        private static readonly HashSet<string> OtherTypes = new HashSet<string>
        {
            "System.Text.StringBuilder", "System.Globalization.NumberStyles", "System.Reflection.MemberInfo", "System.Collections.IEnumerator",
            "System.Diagnostics.DebuggableAttribute+DebuggingModes", "System.Security.Permissions.SecurityAction",
            "System.Collections.Generic.List`1+Enumerator", "Collektive.Headless.DataFile", "Collektive.Headless.Track", "Collektive.Headless.ValueSeries",
            "Collektive.Headless.PlaceExpression", "Collektive.Headless.RandomWalk", "Collektive.Headless.ScenarioException",
            "System.ComponentModel.EditorBrowsableAttribute", "System.ComponentModel.EditorBrowsableState",
        };

        private static readonly HashSet<string> ForbiddenTypes = new HashSet<string>
        {
            "System.ThreadStaticAttribute", "UnityEngine.GUI", "UnityEngine.GUIUtility", "UnityEngine.GUILayout", "UnityEngine.Event", "UnityEngine.Gizmos",
            "UnityEngine.GUIContent", "Collektive.Bridge.Jvm", "Collektive.Bridge.JvmRecording", "Collektive.Bridge.Session", "Collektive.Unity.Installation",
        };

        private static readonly HashSet<string> ForbiddenMembers = new HashSet<string>
        {
            "Intern", "GetInstanceID", "Finalize", "get_Method", "get_Module", "get_Assembly",
        };

        private static readonly OpCode[] PointerCodes =
        {
            OpCodes.Conv_U, OpCodes.Conv_I, OpCodes.Localloc, OpCodes.Cpblk, OpCodes.Initblk, OpCodes.Calli,
        };

        /// <summary>Returns the first reference that could leave state behind, or null.</summary>
        internal static string FindProblem(Assembly scripts)
        {
            var module = scripts.ManifestModule;
            foreach (var type in Resolve(row => module.ResolveType(TypeReferences | row)))
            {
                if (!IsAllowed(type)) return type.FullName;
            }
            foreach (var member in Resolve(row => module.ResolveMember(MemberReferences | row)))
            {
                if (ForbiddenMembers.Contains(member.Name)) return member.DeclaringType?.FullName + "." + member.Name;
                var type = member.DeclaringType?.FullName;
                if (type == null || !Members.TryGetValue(type, out var known)) continue;
                if (Array.IndexOf(known.Split(' '), member.Name) < 0) return type + "." + member.Name;
            }
            foreach (var type in scripts.GetTypes())
            {
                foreach (var method in MethodsOf(type))
                {
                    if ((method.Attributes & MethodAttributes.PinvokeImpl) != 0 || UsesPointers(method)) return type.FullName + "." + method.Name;
                }
                if (IsStateless(type) || typeof(DataSchema).IsAssignableFrom(type)) continue;
                if (type.IsGenericTypeDefinition && HasVariables(type)) return type.FullName;
                var initialiser = type.TypeInitializer;
                if (initialiser != null && DependsOnRun(initialiser, new HashSet<MethodBase>())) return "the static fields of " + type.FullName;
            }
            return null;
        }

        /// <summary>Returns whether the compiler generated a type for constants, or for lambdas that capture no variables.</summary>
        /// <remarks>The name of such a type contains "&lt;", which C# code cannot use.</remarks>
        internal static bool IsStateless(Type type) =>
            type.Name.IndexOf('<') >= 0 && type.IsDefined(typeof(CompilerGeneratedAttribute), false)
                && type.GetFields(BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Instance).Length == 0;

        private static bool HasVariables(Type type) => Array.Exists(type.GetFields(All), field => field.IsStatic && !field.IsLiteral);

        private static IEnumerable<MethodBase> MethodsOf(Type type)
        {
            foreach (var method in type.GetMethods(All)) yield return method;
            foreach (var constructor in type.GetConstructors(All)) yield return constructor;
        }

        /// <summary>Returns whether a method can write to arbitrary addresses. Only unverifiable code uses these instructions.</summary>
        private static bool UsesPointers(MethodBase method)
        {
            var body = method.GetMethodBody()?.GetILAsByteArray();
            if (body == null) return false;
            foreach (var instruction in Instructions.Of(body))
            {
                if (Array.IndexOf(PointerCodes, instruction.Key) >= 0) return true;
            }
            return false;
        }

        /// <summary>
        /// Returns whether the initial values of static fields could depend on the run in which their type is first used. The method is the type's
        /// initialiser, or a method that it calls. Skips the methods in <paramref name="visited"/>.
        /// </summary>
        private static bool DependsOnRun(MethodBase method, HashSet<MethodBase> visited)
        {
            if (!visited.Add(method)) return false;
            var body = method.GetMethodBody()?.GetILAsByteArray();
            if (body == null) return true;
            foreach (var instruction in Instructions.Of(body))
            {
                if (instruction.Key.OperandType == OperandType.InlineField)
                {
                    var field = Resolved(() => method.Module.ResolveField(instruction.Value));
                    var isConstant = field != null && (!field.IsStatic || field.IsInitOnly && !field.FieldType.IsArray || IsStateless(field.DeclaringType)
                        || method is ConstructorInfo && method.IsStatic && field.DeclaringType == method.DeclaringType);
                    if (!isConstant) return true;
                }
                if (instruction.Key.OperandType != OperandType.InlineMethod || instruction.Key == OpCodes.Ldftn) continue;
                var called = Resolved(() => method.Module.ResolveMethod(instruction.Value));
                var owner = called?.DeclaringType;
                if (owner == null) return true;
                var isHarmless = owner.IsValueType && (owner.Assembly != method.Module.Assembly || !DependsOnRun(called, visited))
                    || owner.Assembly == typeof(DataSchema).Assembly || IsStateless(owner) || owner == typeof(RuntimeHelpers)
                    || owner == typeof(UnityEngine.Shader) || typeof(Delegate).IsAssignableFrom(owner) && called.IsConstructor;
                if (!isHarmless) return true;
            }
            return false;
        }

        /// <summary>
        /// Returns the types or members in a table of the scripts' metadata. Skips members of generic types that scripts construct, which cannot be resolved.
        /// Their types are in another table.
        /// </summary>
        private static IEnumerable<T> Resolve<T>(Func<int, T> resolve) where T : class
        {
            for (var row = 1;; row++)
            {
                T found;
                try
                {
                    found = resolve(row);
                }
                catch (ArgumentOutOfRangeException)
                {
                    yield break;
                }
                catch (ArgumentException)
                {
                    continue;
                }
                yield return found;
            }
        }

        private static T Resolved<T>(Func<T> resolve) where T : class
        {
            try
            {
                return resolve();
            }
            catch (ArgumentException)
            {
                return null;
            }
        }

        private static bool IsAllowed(Type type)
        {
            var name = type.FullName ?? "";
            if (ForbiddenTypes.Contains(name)) return false;
            if (Assemblies.Contains(type.Assembly.GetName().Name)) return type.Namespace != "UnityEngine.Headless";
            if (type.IsNested) return IsAllowed(type.DeclaringType) || OtherTypes.Contains(name);
            if (type.Namespace != null && Namespaces.Contains(type.Namespace) || Members.ContainsKey(name) || OtherTypes.Contains(name)) return true;
            if (name.EndsWith("Attribute", StringComparison.Ordinal)) return true;
            return type.Namespace == "System" && (SystemTypes.Contains(type.Name) || GenericTypes.Contains(type.Name.Split('`')[0]));
        }
    }
}
