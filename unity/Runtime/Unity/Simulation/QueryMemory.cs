using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Where physics write what they find, of one query at a time; who finds an array full makes it longer. It is the simulation's, so that no
    /// collider outlives it here.
    /// </summary>
    internal sealed class QueryMemory
    {
        internal Collider[] Near = new Collider[32];
        internal Obstacle[] Obstacles = new Obstacle[32];
        internal RaycastHit[] InTheWay = new RaycastHit[16];
    }
}
