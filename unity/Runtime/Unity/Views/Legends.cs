using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Places of the legends of all field views, one below the other.</summary>
    internal static class Legends
    {
        private static readonly List<MonoBehaviour> Shown = new List<MonoBehaviour>();

        /// <summary>Returns the place of a view's legend, in pixels. The first call adds it below the others.</summary>
        internal static Rect PlaceOf(MonoBehaviour view)
        {
            var row = Shown.IndexOf(view);
            if (row < 0)
            {
                row = Shown.Count;
                Shown.Add(view);
            }
            return new Rect(10, 10 + 24 * row, 600, 24);
        }

        internal static void Remove(MonoBehaviour view) => Shown.Remove(view);

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void ResetStatics() => Shown.Clear();
    }
}
