using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Neighbours are the nodes whose centres are within a radius of this node's.</summary>
    [AddComponentMenu("Collektive/Neighbourhoods/Radius Neighbourhood")]
    public sealed class RadiusNeighbourhood : NeighbourhoodRule
    {
        private static readonly List<Node> Found = new List<Node>();
        private static readonly List<float> Distances = new List<float>();

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres.")]
        private float radius = 3;

        /// <summary>The radius in metres, 0 or greater.</summary>
        public float Radius
        {
            get => radius;
            set => radius = value;
        }

        /// <inheritdoc/>
        protected override void FindNeighbours(SimulationManager manager)
        {
            manager.FindNodes(Node.Body.position, radius, Found, Distances);
            for (var i = 0; i < Found.Count; i++) Connect(Found[i], Distances[i], 0);
        }
    }
}
