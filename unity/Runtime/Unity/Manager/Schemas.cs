using System;
using System.Collections.Generic;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Finds generated schema classes among the loaded assemblies.</summary>
    internal static class Schemas
    {
        /// <summary>Returns the schema with the given name, or the only schema if the name is empty.</summary>
        /// <exception cref="BridgeException">No schema, or several schemas, match.</exception>
        internal static DataSchema Find(string name)
        {
            var found = FindAll();
            var schema = Choose(found, name);
            if (schema != null) return schema;
            var names = found.Count == 0 ? "none" : string.Join(", ", found.ConvertAll(schema => schema.Name));
            var problem = string.IsNullOrEmpty(name) ? "no schema is selected" : "schema '" + name + "' does not exist";
            throw new BridgeException(
                BridgeError.Schema,
                problem + "; available: " + names + ". Select one in the Simulation Manager, or generate its code (Tools > Collektive > Generate Schema Code)");
        }

        /// <summary>Like <see cref="Find"/>, but returns null instead of throwing an exception.</summary>
        internal static DataSchema TryFind(string name) => Choose(FindAll(), name);

        private static DataSchema Choose(List<DataSchema> all, string name) =>
            string.IsNullOrEmpty(name) ? all.Count == 1 ? all[0] : null : all.Find(schema => schema.Name == name);

        /// <summary>Returns the types of all schemas. The editor replaces this function, because it has an index of types.</summary>
        internal static Func<IEnumerable<Type>> FindTypes { get; set; } = ExportedTypes;

        /// <summary>Returns all schemas, in no particular order.</summary>
        internal static List<DataSchema> FindAll()
        {
            var found = new List<DataSchema>();
            foreach (var type in FindTypes())
            {
                if (type.IsVisible && !type.IsAbstract && typeof(DataSchema).IsAssignableFrom(type)) found.Add((DataSchema)Activator.CreateInstance(type));
            }
            return found;
        }

        private static IEnumerable<Type> ExportedTypes()
        {
            foreach (var assembly in LoadedAssemblies())
            {
                if (assembly.IsDynamic || !References(assembly)) continue;
                foreach (var type in assembly.GetExportedTypes()) yield return type;
            }
        }

        /// <summary>Returns the loaded assemblies. On CoreCLR, the domain also lists assemblies that were unloaded.</summary>
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
