using System;
using System.Collections;
using System.Collections.Generic;

namespace UnityEditor
{
    public static class TypeCache
    {
        public static TypeCollection GetTypesDerivedFrom<T>()
        {
            var found = new List<Type>();
            var owner = typeof(T).Assembly.GetName().Name;
            foreach (var assembly in AppDomain.CurrentDomain.GetAssemblies())
            {
                if (assembly.IsDynamic) continue;
                // Types of other assemblies, such as Mono's own on CoreCLR, may refer to missing types.
                if (assembly != typeof(T).Assembly && !Array.Exists(assembly.GetReferencedAssemblies(), name => name.Name == owner)) continue;
                foreach (var type in assembly.GetTypes())
                    if (type != typeof(T) && typeof(T).IsAssignableFrom(type)) found.Add(type);
            }
            return new TypeCollection(found);
        }

        public struct TypeCollection : IEnumerable<Type>
        {
            readonly List<Type> types;
            internal TypeCollection(List<Type> types) => this.types = types;
            public IEnumerator<Type> GetEnumerator() => types.GetEnumerator();
            IEnumerator IEnumerable.GetEnumerator() => GetEnumerator();
        }
    }
}
