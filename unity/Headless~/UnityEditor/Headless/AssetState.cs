using System;

namespace UnityEditor.Headless
{
    /// Simulates the editor states in which calls of the asset database throw exceptions, as they do from Unity 6000.4 on.
    public static class AssetState
    {
        static bool isReloading, isImporting;

        /// Runs an action as if the editor were reloading code.
        public static void Reload(Action action) => During(ref isReloading, action);

        /// Runs an action as if the editor were importing an asset.
        public static void Import(Action action) => During(ref isImporting, action);

        /// Must be called at the start of each call of the asset database.
        internal static void CheckCall()
        {
            if (isReloading) throw new InvalidOperationException("The asset database cannot be used while code is being reloaded.");
        }

        /// Must be called at the start of each method that changes assets.
        internal static void CheckChange()
        {
            CheckCall();
            if (isImporting) throw new InvalidOperationException("The asset database cannot be changed while an asset is being imported.");
        }

        static void During(ref bool state, Action action)
        {
            var before = state;
            state = true;
            try
            {
                action();
            }
            finally
            {
                state = before;
            }
        }
    }
}
