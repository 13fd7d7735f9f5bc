using System;
using System.Collections.Generic;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    /// <summary>Positions on the ground with a minimum distance between them. Testing a place takes constant time.</summary>
    internal sealed class FreePlaces
    {
        /// <summary>
        /// Side of a grid cell, in units of the distance. A cell has room for one place, and places that are too near are at most two cells
        /// away.
        /// </summary>
        private const double CellSize = 0.625;

        private readonly Dictionary<(int X, int Z), Vector3> taken = new Dictionary<(int X, int Z), Vector3>();
        private readonly float distance;

        /// <param name="distance">Metres, greater than 0.</param>
        internal FreePlaces(float distance) => this.distance = distance;

        /// <summary>Takes a place unless an earlier one is too near, and returns whether it did.</summary>
        internal bool TryTake(Vector3 place)
        {
            var x = CellOf(place.x);
            var z = CellOf(place.z);
            for (var i = x - 2; i <= x + 2; i++)
            {
                for (var k = z - 2; k <= z + 2; k++)
                {
                    if (taken.TryGetValue((i, k), out var other) && (other - place).sqrMagnitude < distance * distance) return false;
                }
            }
            taken.Add((x, z), place);
            return true;
        }

        private int CellOf(float coordinate) => (int)Math.Floor(coordinate / (CellSize * distance));
    }
}
