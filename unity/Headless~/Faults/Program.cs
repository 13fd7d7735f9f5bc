using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine.Headless;

namespace Collektive.Headless.Faults
{
    /// <summary>
    /// Tests one fault in its own process: plays a scene, causes the fault in the fourth tick or at the start, and prints what still
    /// works. Arguments are key=value: home, host and jar of the trial, <c>good-*</c> for the recovery, placement, limit (of a tick, in
    /// milliseconds), fault (of the program), act (in C#), and any number of option. Ends with a line "still works: ..., JVM ...", and code 0. With
    /// act=exit it ends as <c>how</c> selects.
    /// </summary>
    internal static class Program
    {
        private const int StopLimitMs = 4000;

        private static readonly List<string> results = new List<string>();
        private static int limitMs;

        private static int Main(string[] arguments)
        {
            var options = new List<string>();
            var values = new Dictionary<string, string>();
            foreach (var argument in arguments)
            {
                var parts = argument.Split(new[] { '=' }, 2);
                if (parts[0] == "option") options.Add(parts[1]);
                else values[parts[0]] = parts[1];
            }
            string Value(string key, string other) => values.TryGetValue(key, out var value) ? value : other;
            var act = Value("act", "none");
            Scene.Placement = (JvmPlacement)Enum.Parse(typeof(JvmPlacement), Value("placement", nameof(JvmPlacement.InProcess)));
            limitMs = int.Parse(Value("limit", "30000"));
            var good = new Setting(values["home"], values["host"], values["jar"], new[] { "-Xmx128m", "-XX:+UseSerialGC" });
            var faulty = new Setting(Value("bad-home", good.Home), Value("bad-host", good.Host), Value("bad-jar", good.Jar),
                options.Count > 0 ? options.ToArray() : good.Options);
            Loop.IsEditor = act != "exit";
            if (act == "exit") return Exit.Play(faulty, values["how"]);
            if (act == "play") return Play(good, "none", "none") ? 0 : 1;
            if (act == "play-on")
            {
                Loop.Start(1);
                return new Scene(good, "none", limitMs).Play("none") ? 0 : 1;
            }
            Console.WriteLine("still works: " + Try(good, faulty, Value("fault", "none"), act) + ", JVM " + Jvm.State);
            return 0;
        }

        private static string Try(Setting good, Setting faulty, string fault, string act)
        {
            var works = act == "domains" ? Domains.Play() : Play(faulty, fault, act);
            // A running JVM keeps its options.
            if (!works) works = Jvm.State == JvmState.Running ? Report("next session", Play(faulty.With(good), "none", "none"))
                : Report("next start", Play(good, "none", "none"));
            else works = Report("next tick", true) && Report("next play", Play(faulty, "none", "none"));
            var csharp = ManagedFaults.CSharpWorks();
            try
            {
                Jvm.Stop(StopLimitMs);
            }
            catch (BridgeException error)
            {
                Console.WriteLine("stop: " + error.Message);
            }
            for (var log = new HostLog(); log.TryRead(out _, out var line);) Console.WriteLine(line);
            results.Add(csharp ? "C#" : "C# does not");
            return string.Join(", ", results);
        }

        private static bool Report(string what, bool works)
        {
            if (works) results.Add(what);
            return works;
        }

        private static bool Play(Setting setting, string fault, string act)
        {
            Loop.Reset();
            Loop.Start(1);
            try
            {
                return new Scene(setting, fault, limitMs).Play(act);
            }
            finally
            {
                Loop.Quit();
            }
        }
    }
}
