using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Builds a scene from code, which runs both in Unity and without it. The public fields of a subclass can be set in the inspector, in a scenario file
    /// and on the command line. The scene needs a <see cref="SimulationManager"/>. A subclass with its own <c>Awake</c> must override this class's
    /// <c>Awake</c> and call it.
    /// </summary>
    [HelpPage("tutorial-scene-builder.md")]
    public abstract class SceneBuilder : MonoBehaviour
    {
        /// <summary>Names of the scene's metrics.</summary>
        public virtual IReadOnlyList<string> MetricNames => Array.Empty<string>();

        /// <summary>Name of <see cref="GetColouringValue"/> in the legend of a replay, or null if nodes have no such value.</summary>
        public virtual string ColouringName => null;

        /// <summary>
        /// The values by which a replay can colour nodes. The replay starts with the first one. Read once, when the run starts. By default, the list
        /// contains <see cref="GetColouringValue"/>, if <see cref="ColouringName"/> is set.
        /// </summary>
        public virtual IReadOnlyList<NodeColouring> Colourings =>
            ColouringName == null ? Array.Empty<NodeColouring>() : new[] { new NodeColouring(ColouringName, node => GetColouringValue(node)) };

        /// <summary>Points to mark in a replay, with their labels.</summary>
        public virtual IReadOnlyList<KeyValuePair<string, Vector3>> Landmarks => Array.Empty<KeyValuePair<string, Vector3>>();

        /// <summary>
        /// Returns an error of the fields, or null. Runs without Unity call it before they build the scene. If the message begins with a field in single
        /// quotes, such as <c>'range' must be positive</c> or <c>'zones[2].radius'</c>, the reported error contains the field's line in the scenario file.
        /// </summary>
        public virtual string FindProblem() => null;

        /// <summary>Writes the current metrics, one per name. Called between ticks.</summary>
        public virtual void Measure(double[] values)
        {
        }

        /// <summary>Returns the number by which a replay colours a node.</summary>
        public virtual float GetColouringValue(Node node) => 0;

        /// <summary>Creates the scene's objects. Called once, from <c>Awake</c>, in play mode. An exception stops the simulation.</summary>
        protected abstract void Build(SimulationManager manager);

        /// <summary>Creates a box with a collider, such as a floor, a wall or an obstacle.</summary>
        protected static GameObject MakeBox(string title, Vector3 centre, Vector3 size)
        {
            var box = GameObject.CreatePrimitive(PrimitiveType.Cube);
            box.name = title;
            box.transform.position = centre;
            box.transform.localScale = size;
            return box;
        }

        /// <summary>Calls <see cref="Build"/>.</summary>
        protected virtual void Awake()
        {
            if (SimulationManager.Current == null)
            {
                Debug.LogError(
                    GetType().Name + " on '" + name
                        + "' needs a Simulation Manager in the scene: add one (GameObject > Collektive > Simulation Manager)", this);
                return;
            }
            try
            {
                Build(SimulationManager.Current);
            }
            catch (Exception error)
            {
                // An incomplete scene would give wrong results.
                Debug.LogException(error, this);
                SimulationManager.Current.Fail("the scene " + GetType().Name + " could not be built: " + error.Message, this);
            }
        }
    }
}
