using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Standard
{
    /// <summary>
    /// A set of places with a minimum distance between them. The places are in square cells of about that width, so only the nearest cells must be checked.
    /// </summary>
    internal sealed class PlaceGrid
    {
        private readonly Dictionary<(int, int), List<Vector3>> cells = new Dictionary<(int, int), List<Vector3>>();
        private readonly float minDistance;

        internal PlaceGrid(float minDistance) => this.minDistance = minDistance;

        internal int Count { get; private set; }

        /// <summary>Adds a place if it keeps the minimum distance to all others, and returns whether it was added.</summary>
        internal bool TryAdd(Vector3 place)
        {
            int x = CellOf(place.x), z = CellOf(place.z);
            for (var i = 0; minDistance > 0 && i < 9; i++)
            {
                if (!cells.TryGetValue((x + i % 3 - 1, z + i / 3 - 1), out var near)) continue;
                if (!near.TrueForAll(other => (other - place).sqrMagnitude >= minDistance * minDistance)) return false;
            }
            if (!cells.TryGetValue((x, z), out var places)) cells[(x, z)] = places = new List<Vector3>();
            places.Add(place);
            Count++;
            return true;
        }

        // The cells are slightly wider than the distance. Otherwise, rounding could put close places two cells apart.
        private int CellOf(float coordinate) => minDistance > 0 ? (int)Math.Floor(coordinate / (1.001 * minDistance)) : 0;
    }
}
