using System;
using System.Collections.Generic;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    /// <summary>A set of places on the ground with a minimum distance between them. The time to check a place does not depend on their number.</summary>
    internal sealed class FreePlaces
    {
        /// <summary>
        /// Side of a grid cell, in units of the distance. With this size, a cell has room for only one place, and places that are too near to each other are
        /// at most two cells apart.
        /// </summary>
        private const double CellSize = 0.625;

        private readonly Dictionary<(int X, int Z), Vector3> taken = new Dictionary<(int X, int Z), Vector3>();
        private readonly float distance;

        /// <param name="distance">Minimum distance in metres, greater than 0.</param>
        internal FreePlaces(float distance) => this.distance = distance;

        /// <summary>Adds a place unless another one is too near, and returns whether it was added.</summary>
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
