using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Calls the users' handlers of <see cref="SimulationManager.Ticked"/>. An exception in a handler stops neither the other handlers nor the simulation.
    /// </summary>
    internal sealed class TickHandlers
    {
        private readonly Dictionary<Action<SimulationManager>, int> failuresInRow = new Dictionary<Action<SimulationManager>, int>();
        private Action<SimulationManager> all;

        // This array is replaced and never modified, because handlers may be added or removed while others are called.
        private Delegate[] each = Array.Empty<Delegate>();

        internal void Add(Action<SimulationManager> handler) => Set(all + handler);

        internal void Remove(Action<SimulationManager> handler) => Set(all - handler);

        /// <summary>Calls the handlers in the order in which they were added.</summary>
        internal void Run(SimulationManager manager)
        {
            var now = each;
            for (var i = 0; i < now.Length; i++)
            {
                var handler = (Action<SimulationManager>)now[i];
                try
                {
                    handler(manager);
                    if (failuresInRow.Count > 0) failuresInRow.Remove(handler);
                }
                catch (Exception error)
                {
                    Failed(handler, manager, error);
                }
            }
        }

        /// <summary>Returns the value of a stop condition, or false if it throws an exception.</summary>
        internal static bool IsTrue(Func<SimulationManager, bool> condition, SimulationManager manager)
        {
            try
            {
                return condition(manager);
            }
            catch (Exception error)
            {
                Report(condition, manager, error);
                return false;
            }
        }

        private void Failed(Action<SimulationManager> handler, SimulationManager manager, Exception error)
        {
            Report(handler, manager, error);
            failuresInRow.TryGetValue(handler, out var failures);
            failuresInRow[handler] = ++failures;
            if (failures < NodePart.MaxFailuresInRow) return;
            failuresInRow.Remove(handler);
            Remove(handler);
            Debug.LogError(NameOf(handler) + " failed " + failures + " times in a row and was removed from Ticked: fix it, then add it again",
                Context(handler, manager));
        }

        private static void Report(Delegate handler, SimulationManager manager, Exception error) =>
            manager.Simulation.Errors.AddHandler(NameOf(handler), manager.Simulation.TickInProgress, error, Context(handler, manager));

        /// <summary>Returns the object that a click on the message selects.</summary>
        private static UnityEngine.Object Context(Delegate handler, SimulationManager manager) => handler.Target as UnityEngine.Object ?? manager;

        /// <summary>
        /// Returns the class and method of a handler. For a lambda, returns the class and method that contain it, which are found in the nested class and
        /// the angle brackets of the compiler's names.
        /// </summary>
        private static string NameOf(Delegate handler)
        {
            var type = handler.Method.DeclaringType;
            while (type?.DeclaringType != null && type.Name[0] == '<') type = type.DeclaringType;
            var method = handler.Method.Name;
            if (method[0] == '<') method = method.Substring(1, method.IndexOf('>') - 1) + " (lambda)";
            return type?.Name + "." + method;
        }

        private void Set(Action<SimulationManager> handlers)
        {
            all = handlers;
            each = handlers?.GetInvocationList() ?? Array.Empty<Delegate>();
        }
    }
}
