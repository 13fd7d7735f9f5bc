using System;

namespace UnityEditor.Headless
{
    /// Times at which calls of the asset database throw, since Unity 6000.4.
    public static class AssetState
    {
        static bool isReloading, isImporting;

        /// Does what the editor does while it reloads code.
        public static void Reload(Action action) => During(ref isReloading, action);

        /// Does what the editor does while it imports an asset.
        public static void Import(Action action) => During(ref isImporting, action);

        /// At the start of each call.
        internal static void CheckCall()
        {
            if (isReloading) throw new InvalidOperationException("The asset database cannot be used while code is reloaded.");
        }

        /// At the start of each call that changes assets.
        internal static void CheckChange()
        {
            CheckCall();
            if (isImporting) throw new InvalidOperationException("The asset database cannot be changed while an asset is imported.");
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
