using System;
using System.Collections;
using System.Collections.Generic;
using System.Diagnostics;
using System.Reflection;
using System.Xml;
using System.Xml.Linq;
using NUnit.Framework;
using UnityEngine.Headless;
using UnityEngine.TestTools;

/// Runs the NUnit tests of an assembly one after another on the calling thread, as Unity does, and ends with "N passed, N failed".
/// Usage: Collektive.TestRunner.exe [--results FILE] [--only CATEGORY] [--without CATEGORY]... ASSEMBLY [PART OF A TEST'S NAME]. Exit code 1 when a test failed
/// or none ran. Skipped tests of a category are counted. The results are written to FILE as JUnit XML at the end; an interrupted run
/// writes no file.
/// Unsupported NUnit attributes are failures, because the test might run differently.
/// Assemblies that use Unity's test framework get its features: log assertions, coroutines, and, unless it uses the
/// editor, play mode.
static class Program
{
    const BindingFlags Members = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.FlattenHierarchy;

    /// Length of a frame in play mode.
    const float FrameSeconds = 0.02f;

    static readonly HashSet<Type> known = new HashSet<Type>
    {
        typeof(TestFixtureAttribute), typeof(TestAttribute), typeof(TestCaseAttribute), typeof(SetUpAttribute), typeof(TearDownAttribute),
        typeof(IgnoreAttribute), typeof(CategoryAttribute), typeof(UnityTestAttribute), typeof(UnitySetUpAttribute), typeof(UnityTearDownAttribute),
    };

    static readonly XElement results = new XElement("testsuite");
    static readonly SortedDictionary<string, int> skippedCategories = new SortedDictionary<string, int>(StringComparer.Ordinal);
    static int passed, failed;
    static bool isUnity, isPlayMode;
    static string only;

    static int Main(string[] arguments)
    {
        string file = null;
        while (arguments[0].StartsWith("--", StringComparison.Ordinal))
        {
            if (arguments[0] == "--results") file = arguments[1];
            else if (arguments[0] == "--only") only = arguments[1];
            else if (arguments[0] == "--without") skippedCategories[arguments[1]] = 0;
            else throw new ArgumentException("unknown option " + arguments[0]);
            arguments = arguments.AsSpan(2).ToArray();
        }
        var filter = arguments.Length > 1 ? arguments[1] : "";
        var assembly = Assembly.LoadFrom(arguments[0]);
        var references = Array.ConvertAll(assembly.GetReferencedAssemblies(), reference => reference.Name);
        isUnity = Array.IndexOf(references, typeof(UnityTestAttribute).Assembly.GetName().Name) >= 0;
        isPlayMode = isUnity && Array.IndexOf(references, "UnityEditor") < 0;
        // As in Unity, which loads all assemblies.
        Array.ForEach(assembly.GetReferencedAssemblies(), reference => Assembly.Load(reference));
        var types = assembly.GetExportedTypes();
        Array.Sort(types, (a, b) => string.CompareOrdinal(a.FullName, b.FullName));
        foreach (var type in types)
        {
            ReportUnknownAttributes(type.FullName, type);
            if (type.IsAbstract) continue;
            foreach (var method in type.GetMethods(Members))
            {
                ReportUnknownAttributes($"{type.FullName}.{method.Name}", method, method.GetParameters());
                var cases = method.GetCustomAttributes(typeof(TestCaseAttribute), true);
                var isTest = method.IsDefined(typeof(TestAttribute), true) || method.IsDefined(typeof(UnityTestAttribute), true);
                if (cases.Length == 0 && isTest) Run(type, method, null, filter);
                foreach (TestCaseAttribute testCase in cases) Run(type, method, testCase, filter);
            }
        }
        foreach (var category in skippedCategories) Console.WriteLine($"{category.Value} tests of category {category.Key} were skipped");
        Console.WriteLine($"{passed} passed, {failed} failed");
        if (file != null)
        {
            results.Add(new XAttribute("name", assembly.GetName().Name), new XAttribute("tests", passed + failed), new XAttribute("failures", failed));
            results.Save(file);
        }
        return failed == 0 && passed > 0 ? 0 : 1;
    }

    static void Run(Type type, MethodInfo method, TestCaseAttribute testCase, string filter)
    {
        var arguments = testCase?.Arguments;
        var name = $"{type.FullName}.{method.Name}" + (arguments == null ? "" : "(" + string.Join(", ", arguments) + ")");
        if (name.IndexOf(filter, StringComparison.Ordinal) < 0 || method.IsDefined(typeof(IgnoreAttribute), true)) return;
        bool HasCategory(string category) => testCase?.Category == category || IsIn(category, method) || IsIn(category, type);
        if (only != null && !HasCategory(only)) return;
        foreach (var category in new List<string>(skippedCategories.Keys))
        {
            if (!HasCategory(category)) continue;
            skippedCategories[category]++;
            return;
        }
        var clock = Stopwatch.StartNew();
        Exception failure = null;
        if (isUnity) Begin();
        var fixture = Try(() => Activator.CreateInstance(type), ref failure);
        if (failure == null)
        {
            foreach (var setUp in Marked(type, typeof(SetUpAttribute), typeof(UnitySetUpAttribute)))
                if (failure == null) Try(() => Finish(setUp.Invoke(fixture, null)), ref failure);
            if (failure == null)
            {
                var returned = Try(() => Finish(method.Invoke(fixture, ConvertArguments(arguments, method))), ref failure);
                if (failure == null && testCase != null && testCase.HasExpectedResult)
                    Try(() => { Assert.AreEqual(testCase.ExpectedResult, returned); return null; }, ref failure);
            }
            var tearDowns = Marked(type, typeof(TearDownAttribute), typeof(UnityTearDownAttribute));
            tearDowns.Reverse();
            foreach (var tearDown in tearDowns) Try(() => Finish(tearDown.Invoke(fixture, null)), ref failure);
        }
        if (isUnity) Try(End, ref failure);
        Report(type.FullName, name, clock, failure);
    }

    static void Report(string fixture, string name, Stopwatch clock, Exception failure)
    {
        var result = new XElement("testcase", new XAttribute("classname", fixture),
            new XAttribute("name", Printable(name.StartsWith(fixture + ".", StringComparison.Ordinal) ? name.Substring(fixture.Length + 1) : name)),
            new XAttribute("time", clock.Elapsed.TotalSeconds));
        results.Add(result);
        if (failure == null || failure is SuccessException)
        {
            passed++;
            Console.WriteLine($"ok   {name} ({clock.ElapsedMilliseconds} ms)");
            return;
        }
        failed++;
        result.Add(new XElement("failure", new XAttribute("message", Printable(failure.Message)), Printable(failure.ToString())));
        Console.WriteLine($"FAIL {name}\n{failure}");
    }

    /// Reports a failure for each unknown attribute of NUnit or Unity's test framework.
    static void ReportUnknownAttributes(string name, MemberInfo member, params ParameterInfo[] parameters)
    {
        var attributes = new List<object>(member.GetCustomAttributes(true));
        foreach (var parameter in parameters) attributes.AddRange(parameter.GetCustomAttributes(true));
        foreach (var attribute in attributes)
        {
            var type = attribute.GetType();
            if (type.Namespace != typeof(TestAttribute).Namespace && type.Namespace != typeof(UnityTestAttribute).Namespace || known.Contains(type)) continue;
            Report((member as Type ?? member.DeclaringType).FullName, $"{name} has [{type.Name}]", Stopwatch.StartNew(),
                new NotSupportedException($"{name}: this runner does not support [{type.Name}], so the test might run differently"));
        }
    }

    static bool IsIn(string category, MemberInfo member) =>
        Array.Exists(member.GetCustomAttributes(typeof(CategoryAttribute), true), attribute => ((CategoryAttribute)attribute).Name == category);

    /// Removes control characters, which XML cannot represent.
    static string Printable(string text)
    {
        var characters = text.ToCharArray();
        for (var index = 0; index < characters.Length; index++)
            if (!XmlConvert.IsXmlChar(characters[index])) characters[index] = '?';
        return new string(characters);
    }

    static void Begin()
    {
        Loop.Reset();
        LogAssert.Begin();
        if (isPlayMode) Loop.Start(1);
    }

    static object End()
    {
        try
        {
            LogAssert.End();
        }
        finally
        {
            Loop.Reset();
        }
        return null;
    }

    /// Runs a coroutine to its end, with one frame for each step, including those of nested enumerators.
    static object Finish(object result)
    {
        if (!isUnity || !(result is IEnumerator coroutine)) return result;
        var running = new Stack<IEnumerator>();
        running.Push(coroutine);
        while (running.Count > 0)
        {
            if (!running.Peek().MoveNext()) running.Pop();
            else if (running.Peek().Current is IEnumerator inner) running.Push(inner);
            else if (isPlayMode) Loop.Frame(FrameSeconds);
        }
        return null;
    }

    /// Base classes first.
    static List<MethodInfo> Marked(Type type, params Type[] attributes)
    {
        var methods = new List<MethodInfo>();
        for (var level = type; level != null; level = level.BaseType)
            foreach (var method in level.GetMethods(Members | BindingFlags.DeclaredOnly))
                if (Array.Exists(attributes, attribute => method.IsDefined(attribute, false))) methods.Insert(0, method);
        return methods;
    }

    static object[] ConvertArguments(object[] arguments, MethodInfo method)
    {
        if (arguments == null) return null;
        var parameters = method.GetParameters();
        var converted = (object[])arguments.Clone();
        for (var index = 0; index < converted.Length; index++)
            if (converted[index] is IConvertible && !parameters[index].ParameterType.IsInstanceOfType(converted[index])
                && !parameters[index].ParameterType.IsEnum)
                converted[index] = Convert.ChangeType(converted[index], parameters[index].ParameterType);
        return converted;
    }

    static object Try(Func<object> action, ref Exception failure)
    {
        try
        {
            return action();
        }
        catch (Exception exception)
        {
            while (exception is TargetInvocationException && exception.InnerException != null) exception = exception.InnerException;
            failure = failure ?? exception;
            return null;
        }
    }
}
