using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The links that scripts add and remove, in addition to the links of neighbourhood rules.</summary>
    internal sealed class ScriptLinks
    {
        private readonly Simulation simulation;
        // Ids of missing nodes that were already reported.
        private readonly HashSet<int> warnedIds = new HashSet<int>();

        internal ScriptLinks(Simulation simulation)
        {
            this.simulation = simulation;
        }

        /// <summary>Links two nodes until <see cref="Remove"/>. The link's length is the present distance between the nodes.</summary>
        internal void Add(int a, int b, bool directed)
        {
            if (!CheckEnds("add", a, b)) return;
            var length = Vector3.Distance(simulation.Find(a).Body.position, simulation.Find(b).Body.position);
            simulation.Links.Hold(new LinkRecord { From = a, To = b, Length = length });
            if (!directed) simulation.Links.Hold(new LinkRecord { From = b, To = a, Length = length });
        }

        /// <summary>Removes a link added by <see cref="Add"/>.</summary>
        internal void Remove(int a, int b, bool directed)
        {
            if (!CheckEnds("remove", a, b)) return;
            var removed = simulation.Links.Release(a, b);
            if (!directed) removed |= simulation.Links.Release(b, a);
            if (!removed) Debug.LogWarning("cannot remove the link from node " + a + " to node " + b + ": no script added it", simulation.Manager);
        }

        private bool CheckEnds(string verb, int a, int b)
        {
            // The missing library is reported when the simulation opens.
            if (ShimLibrary.Problem != null) return false;
            var missing = simulation.Find(a) == null ? a : b;
            if (simulation.Find(missing) == null)
            {
                // Nodes may leave while scripts still have their ids or receive messages about their colliders.
                if (warnedIds.Add(missing))
                {
                    Debug.LogWarning("cannot " + verb + " a link between nodes " + a + " and " + b + ": node " + missing
                        + " is not in the simulation. Later links of this node are ignored without a warning", simulation.Manager);
                }
                return false;
            }
            if (a != b) return true;
            simulation.Fail("cannot " + verb + " a link from node " + a + " to itself");
            return false;
        }
    }
}
