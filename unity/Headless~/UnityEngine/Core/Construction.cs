using System;

namespace UnityEngine
{
    /// Creates scripts and their serialised values. As in Unity, constructors and field initialisers must not use most of the engine.
    static class Construction
    {
        static Type constructed;

        public static object Create(Type type)
        {
            var outer = constructed;
            constructed = type;
            try
            {
                return Activator.CreateInstance(type, true);
            }
            finally
            {
                constructed = outer;
            }
        }

        /// Logs an error at the first call in a constructor, in which Unity throws an exception.
        public static void Check(string member)
        {
            var name = constructed?.Name;
            if (name == null) return;
            constructed = null;
            Debug.LogError($"{member} is not allowed to be called from the constructor or a field initialiser of {name}: call it in Awake or Start instead.");
        }
    }
}
