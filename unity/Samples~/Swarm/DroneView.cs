using System;
using System.Collections.Generic;
using Collektive.Unity;
using drones;
using UnityEngine;

namespace CollektiveSamples.Swarm
{
    /// <summary>
    /// Draws all drones of the scene, each in the colour of the shape that it forms. Drones have no renderers, because 10,000 renderers would take longer than
    /// the rest of a frame. Instead, this component makes about twenty draw calls with 500 instances each. It does not draw without a model or in batch mode.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Swarm/Drone View")]
    public sealed class DroneView : MonoBehaviour
    {
        // Maximum number of instances per draw call, which all graphics APIs support.
        private const int MaxInstances = 500;

        private static readonly Color[] Colors =
        {
            new Color(0.6f, 0.6f, 0.6f), new Color(0.34f, 0.71f, 0.91f), new Color(0.9f, 0.62f, 0), new Color(0, 0.62f, 0.45f), new Color(0.8f, 0.47f, 0.65f),
        };

        [SerializeField]
        [Tooltip("A sphere that is drawn once per drone.")]
        private Renderer model;

        private readonly Matrix4x4[][] places = new Matrix4x4[Colors.Length][];
        private readonly int[] counts = new int[Colors.Length];
        private readonly Material[] materials = new Material[Colors.Length];
        private Mesh mesh;

        // Positions of the nodes before and after the last tick, by node id.
        private Vector3[] before = new Vector3[0];
        private Vector3[] after = new Vector3[0];
        private ulong tick;

        /// <summary>Radius of a drone in metres.</summary>
        public float Radius { get; set; } = 0.3f;

        /// <summary>
        /// The renderer of a sphere with a mesh filter. The sphere is drawn once per drone. Its material must be an asset with instancing enabled, because
        /// Unity removes the instancing variants of other shaders from players.
        /// </summary>
        public Renderer Model
        {
            get => model;
            set => model = value;
        }

        private void LateUpdate()
        {
            var manager = SimulationManager.Current;
            if (manager == null || model == null || Application.isBatchMode) return;
            // OnEnable would be too early, because the model may not be set yet. A reload of code during Play clears the materials, but not the mesh.
            if (materials[0] == null) Prepare();
            if (tick != manager.Tick) Take(manager);
            Draw(manager.Nodes, manager.TickFraction);
        }

        private void OnDestroy()
        {
            foreach (var material in materials)
                if (material != null) Destroy(material);
        }

        private void Prepare()
        {
            mesh = model.GetComponent<MeshFilter>().sharedMesh;
            for (var i = 0; i < Colors.Length; i++)
            {
                materials[i] = new Material(model.sharedMaterial) { color = Colors[i] };
                places[i] = new Matrix4x4[MaxInstances];
            }
        }

        private void Take(SimulationManager manager)
        {
            tick = manager.Tick;
            (before, after) = (after, before);
            var drones = manager.Nodes;
            var capacity = drones.Count == 0 ? 0 : drones[drones.Count - 1].Id + 1;
            if (before.Length < capacity) Array.Resize(ref before, capacity);
            if (after.Length < capacity) Array.Resize(ref after, capacity);
            for (var i = 0; i < drones.Count; i++)
            {
                var position = drones[i].transform.position;
                if (tick <= 1) before[drones[i].Id] = position;
                after[drones[i].Id] = position;
            }
        }

        private void Draw(IReadOnlyList<Node> drones, float fraction)
        {
            var place = Matrix4x4.Scale(2 * Radius * Vector3.one);
            for (var i = 0; i < drones.Count; i++)
            {
                var drone = drones[i];
                var position = Vector3.Lerp(before[drone.Id], after[drone.Id], fraction);
                place.m03 = position.x;
                place.m13 = position.y;
                place.m23 = position.z;
                var shape = drone.TryGetAnswer(out ActuatorData answer) ? Mathf.Clamp(answer.Shape + 1, 0, Colors.Length - 1) : 0;
                places[shape][counts[shape]++] = place;
                if (counts[shape] == MaxInstances) Draw(shape);
            }
            for (var shape = 0; shape < Colors.Length; shape++) Draw(shape);
        }

        private void Draw(int shape)
        {
            if (counts[shape] == 0) return;
            var parameters = new RenderParams(materials[shape]);
            Graphics.RenderMeshInstanced(parameters, mesh, 0, places[shape], counts[shape]);
            counts[shape] = 0;
        }
    }
}
