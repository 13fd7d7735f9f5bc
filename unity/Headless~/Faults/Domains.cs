using System;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Threading;
using Collektive.Headless.Tests;

namespace Collektive.Headless.Faults
{
    /// <summary>Plays in C# domains that are then unloaded, as the editor does after each change of a script.</summary>
    internal static class Domains
    {
        private const int Times = 50;
        private const int Collections = 20;

        private static readonly Type[] Parts =
        {
            typeof(FlatBuffers.FlatBufferBuilder), typeof(Bridge.Jvm), typeof(UnityEngine.Object), typeof(Unity.SimulationManager), typeof(ShimCounts),
        };

        /// <summary>Returns whether all plays succeeded and released their sessions, slots and threads.</summary>
        internal static bool Play()
        {
            var arguments = Array.FindAll(Environment.GetCommandLineArgs(),
                argument => argument.Contains("=") && !argument.StartsWith("act=", StringComparison.Ordinal));
            Array.Resize(ref arguments, arguments.Length + 1);
            var threads = 0;
            for (var i = 0; i < Times; i++)
            {
                // Unload every third domain in the middle of its play.
                arguments[arguments.Length - 1] = i % 3 == 2 ? "act=play-on" : "act=play";
                var code = IsCoreClr ? PlayInContext(arguments) : PlayInDomain(arguments);
                if (code != 0 || ShimCounts.Sessions != 0 || ShimCounts.Slots != 0)
                {
                    Console.WriteLine("play " + i + ": code " + code + ", " + ShimCounts.Sessions + " sessions, " + ShimCounts.Slots + " slots");
                    return false;
                }
                if (i == 10) threads = CountThreadsAfterDelay();
            }
            var left = CountThreadsAfterDelay() - threads;
            Console.WriteLine(left + " threads more after " + Times + " domains");
            return left <= 2;
        }

        private static bool IsCoreClr => typeof(object).Assembly.GetName().Name == "System.Private.CoreLib";

        private static int PlayInDomain(string[] arguments)
        {
            var domain = AppDomain.CreateDomain("play");
            var code = domain.ExecuteAssembly(typeof(Domains).Assembly.Location, arguments);
            AppDomain.Unload(domain);
            return code;
        }

        /// <summary>CoreCLR has load contexts instead of domains. A context is unloaded when nothing refers to its code any more.</summary>
        private static int PlayInContext(string[] arguments)
        {
            var code = PlayInContext(arguments, out var context);
            for (var i = 0; i < Collections && context.IsAlive; i++)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
            }
            if (context.IsAlive) throw new InvalidOperationException("the code of an ended play is still referenced");
            return code;
        }

        // By reflection, because netstandard2.1 lacks the class. No variable of the caller may refer to objects of the context.
        [MethodImpl(MethodImplOptions.NoInlining)]
        private static int PlayInContext(string[] arguments, out WeakReference reference)
        {
            var type = typeof(object).Assembly.GetType("System.Runtime.Loader.AssemblyLoadContext", true);
            var load = type.GetMethod("LoadFromAssemblyPath");
            var context = Activator.CreateInstance(type, "play", true);
            reference = new WeakReference(context, true);
            // Other assemblies are shared with the caller.
            foreach (var part in Parts) load.Invoke(context, new object[] { part.Assembly.Location });
            var program = (Assembly)load.Invoke(context, new object[] { typeof(Domains).Assembly.Location });
            var code = (int)program.EntryPoint.Invoke(null, new object[] { arguments });
            type.GetMethod("Unload").Invoke(context, null);
            return code;
        }

        private static int CountThreadsAfterDelay()
        {
            Thread.Sleep(300);
            return ShimCounts.Threads;
        }
    }
}
