using System;
using System.Collections.Generic;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Finds generated schema classes among the loaded assemblies.</summary>
    internal static class Schemas
    {
        /// <summary>The schema of that name, or the only one when the name is empty.</summary>
        /// <exception cref="BridgeException">There is none, or more than one to choose from.</exception>
        internal static DataSchema Find(string name)
        {
            var found = new List<DataSchema>();
            foreach (var assembly in LoadedAssemblies())
            {
                if (assembly.IsDynamic || !References(assembly)) continue;
                foreach (var type in assembly.GetExportedTypes())
                {
                    if (type.IsAbstract || !typeof(DataSchema).IsAssignableFrom(type)) continue;
                    var schema = (DataSchema)Activator.CreateInstance(type);
                    if (schema.Name == name) return schema;
                    found.Add(schema);
                }
            }
            if (string.IsNullOrEmpty(name) && found.Count == 1) return found[0];
            var names = found.Count == 0 ? "none" : string.Join(", ", found.ConvertAll(schema => schema.Name));
            var wish = string.IsNullOrEmpty(name) ? "no schema is named" : "schema '" + name + "' does not exist";
            throw new BridgeException(
                BridgeError.Schema,
                wish + "; there is: " + names + ". Name one in the Simulation Manager, or generate its code (./collektive generate)");
        }

        /// <summary>Where CoreCLR runs Unity's scripts, the domain also knows assemblies of code that was unloaded.</summary>
        private static IEnumerable<System.Reflection.Assembly> LoadedAssemblies() =>
#if UNITY_6000_5_OR_NEWER
            UnityEngine.Assemblies.CurrentAssemblies.GetLoadedAssemblies();
#else
            AppDomain.CurrentDomain.GetAssemblies();
#endif

        private static bool References(System.Reflection.Assembly assembly)
        {
            var bridge = typeof(DataSchema).Assembly.GetName().Name;
            foreach (var reference in assembly.GetReferencedAssemblies())
            {
                if (reference.Name == bridge) return true;
            }
            return false;
        }
    }
}
