using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Selects the nodes of a list as neighbours, at any distance. Nodes outside the simulation are ignored.</summary>
    [AddComponentMenu("Collektive/Neighbourhoods/Explicit Neighbourhood")]
    public sealed class ExplicitNeighbourhood : NeighbourhoodRule
    {
        [SerializeField]
        [Tooltip("Nodes that receive messages from this one. Unless the rule is directed, they also send to it.")]
        private List<Node> neighbours = new List<Node>();

        /// <summary>The neighbours; may be changed at any time.</summary>
        public List<Node> Neighbours => neighbours;

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector collector)
        {
            for (var i = 0; i < neighbours.Count; i++)
            {
                if (neighbours[i] != null) collector.Add(neighbours[i]);
            }
        }

        private void OnDrawGizmosSelected()
        {
            for (var i = 0; i < neighbours.Count; i++)
            {
                if (neighbours[i] != null) Gizmos.DrawLine(transform.position, neighbours[i].transform.position);
            }
        }
    }
}
