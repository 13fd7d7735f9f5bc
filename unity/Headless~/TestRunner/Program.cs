using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Reflection;
using NUnit.Framework;

/// Runs the NUnit tests of an assembly one after another on the calling thread, as Unity does, and ends with "N passed, N failed".
/// Usage: Collektive.TestRunner.exe ASSEMBLY [PART OF A TEST'S NAME]. Exit code 1 when a test failed or none ran.
static class Program
{
    const BindingFlags Members = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.FlattenHierarchy;

    static int passed, failed;

    static int Main(string[] arguments)
    {
        var filter = arguments.Length > 1 ? arguments[1] : "";
        var types = Assembly.LoadFrom(arguments[0]).GetExportedTypes();
        Array.Sort(types, (a, b) => string.CompareOrdinal(a.FullName, b.FullName));
        foreach (var type in types)
        {
            if (type.IsAbstract) continue;
            foreach (var method in type.GetMethods(Members))
            {
                var cases = method.GetCustomAttributes(typeof(TestCaseAttribute), true);
                if (cases.Length == 0 && method.IsDefined(typeof(TestAttribute), true)) Run(type, method, null, filter);
                foreach (TestCaseAttribute testCase in cases) Run(type, method, testCase, filter);
            }
        }
        Console.WriteLine($"{passed} passed, {failed} failed");
        return failed == 0 && passed > 0 ? 0 : 1;
    }

    static void Run(Type type, MethodInfo method, TestCaseAttribute testCase, string filter)
    {
        var arguments = testCase?.Arguments;
        var name = $"{type.FullName}.{method.Name}" + (arguments == null ? "" : "(" + string.Join(", ", arguments) + ")");
        if (name.IndexOf(filter, StringComparison.Ordinal) < 0 || method.IsDefined(typeof(IgnoreAttribute), true)) return;
        var clock = Stopwatch.StartNew();
        Exception failure = null;
        var fixture = Try(() => Activator.CreateInstance(type), ref failure);
        if (failure == null)
        {
            foreach (var setUp in Marked(type, typeof(SetUpAttribute)))
                if (failure == null) Try(() => setUp.Invoke(fixture, null), ref failure);
            if (failure == null)
            {
                var result = Try(() => method.Invoke(fixture, Converted(arguments, method)), ref failure);
                if (failure == null && testCase != null && testCase.HasExpectedResult)
                    Try(() => { Assert.AreEqual(testCase.ExpectedResult, result); return null; }, ref failure);
            }
            var tearDowns = Marked(type, typeof(TearDownAttribute));
            tearDowns.Reverse();
            foreach (var tearDown in tearDowns) Try(() => tearDown.Invoke(fixture, null), ref failure);
        }
        if (failure == null || failure is SuccessException)
        {
            passed++;
            Console.WriteLine($"ok   {name} ({clock.ElapsedMilliseconds} ms)");
            return;
        }
        failed++;
        Console.WriteLine($"FAIL {name}\n{failure}");
    }

    /// Base classes first.
    static List<MethodInfo> Marked(Type type, Type attribute)
    {
        var methods = new List<MethodInfo>();
        for (var level = type; level != null; level = level.BaseType)
            foreach (var method in level.GetMethods(Members | BindingFlags.DeclaredOnly))
                if (method.IsDefined(attribute, false)) methods.Insert(0, method);
        return methods;
    }

    static object[] Converted(object[] arguments, MethodInfo method)
    {
        if (arguments == null) return null;
        var parameters = method.GetParameters();
        var converted = (object[])arguments.Clone();
        for (var index = 0; index < converted.Length; index++)
            if (converted[index] is IConvertible && !parameters[index].ParameterType.IsInstanceOfType(converted[index]) && !parameters[index].ParameterType.IsEnum)
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
