using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Links that scripts make and remove, beside those of neighbourhood rules.</summary>
    internal sealed class ScriptLinks
    {
        private readonly Simulation simulation;
        // Ids of absent nodes that were warned of.
        private readonly HashSet<int> missed = new HashSet<int>();

        internal ScriptLinks(Simulation simulation)
        {
            this.simulation = simulation;
        }

        /// <summary>Links two nodes until <see cref="Remove"/>; the length is the distance now.</summary>
        internal void Add(int a, int b, bool directed)
        {
            if (!CheckEnds("add", a, b)) return;
            var length = Vector3.Distance(simulation.Find(a).Body.position, simulation.Find(b).Body.position);
            simulation.Links.HoldForScripts(a, b, length, 0);
            if (!directed) simulation.Links.HoldForScripts(b, a, length, 0);
        }

        /// <summary>Removes what <see cref="Add"/> made.</summary>
        internal void Remove(int a, int b, bool directed)
        {
            if (!CheckEnds("remove", a, b)) return;
            var removed = simulation.Links.ReleaseForScripts(a, b);
            if (!directed) removed |= simulation.Links.ReleaseForScripts(b, a);
            if (!removed) Debug.LogWarning("no script made a link from node " + a + " to node " + b + ": nothing to remove", simulation.Manager);
        }

        private bool CheckEnds(string verb, int a, int b)
        {
            var missing = simulation.Find(a) == null ? a : b;
            if (simulation.Find(missing) == null)
            {
                // Nodes may leave while scripts still have their ids or touch their colliders.
                if (missed.Add(missing))
                {
                    Debug.LogWarning("cannot " + verb + " a link between nodes " + a + " and " + b + ": node " + missing
                        + " takes no part in the simulation; later links of it are passed over without a word", simulation.Manager);
                }
                return false;
            }
            if (a != b) return true;
            simulation.Fail("cannot " + verb + " a link from node " + a + " to itself");
            return false;
        }
    }
}
