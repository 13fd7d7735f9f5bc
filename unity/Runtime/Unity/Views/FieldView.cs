using System;
using System.Globalization;
using System.Text;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Colours all nodes by a number in the program's answers, and shows a legend in a corner of the screen. A subclass reads the number. Add one component
    /// anywhere in the scene. A node without an answer keeps its colour.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Actuator{TData}"/>.</typeparam>
    [HelpPage("sensors-and-actuators.md#views")]
    public abstract class FieldView<TData> : MonoBehaviour
    {
        [SerializeField]
        [Tooltip("Name of the field, for the legend.")]
        private string title = "value";

        [SerializeField]
        [Tooltip("Colours of the numbers.")]
        private ColourScale scale = new ColourScale();

        [SerializeField]
        [Tooltip("On: the legend is shown in the upper left corner.")]
        private bool legend = true;

        // The coloured renderers, indexed by node id.
        private readonly PagedArray<Painted> painted = new PagedArray<Painted>();
        private SimulationManager shown;
        private ulong tick;
        private Color paintedLow;
        private Color paintedHigh;
        private string text;
        private (string Title, Color Low, Color High, float Lowest, float Highest) inLegend;

        private struct Painted
        {
            internal Node Node;
            internal Renderer Renderer;
            internal float Number;
            internal bool IsNew;
            internal int Step;
        }

        /// <summary>Name of the field, for the legend.</summary>
        public string Title
        {
            get => title;
            set => title = value;
        }

        /// <summary>The colours.</summary>
        public ColourScale Scale => scale;

        /// <summary>The legend in Unity's rich text. It is cached until the title or the scale changes.</summary>
        public string Legend
        {
            get
            {
                var currentLegend = (title, scale.low, scale.high, scale.lowest, scale.highest);
                if (text == null || !currentLegend.Equals(inLegend)) Describe();
                inLegend = currentLegend;
                return text;
            }
        }

        /// <summary>Returns the number in a node's answer. A node whose number is not finite keeps its colour.</summary>
        protected abstract float Read(TData data);

        /// <summary>
        /// Disables Unity's layout for this component. The legend has a fixed position and does not need the layout, which would allocate at each event.
        /// </summary>
        protected virtual void OnEnable() => useGUILayout = false;

        /// <summary>Removes the legend, and frees its place.</summary>
        protected virtual void OnDisable() => Legends.Remove(this);

        /// <summary>Colours the nodes once per tick.</summary>
        protected virtual void LateUpdate()
        {
            var manager = SimulationManager.Current;
            if (manager == null || shown == manager && tick == manager.Tick) return;
            shown = manager;
            tick = manager.Tick;
            ReadNumbers(manager);
            Paint(manager);
        }

        private void ReadNumbers(SimulationManager manager)
        {
            scale.Begin();
            for (var i = 0; i < manager.Nodes.Count; i++)
            {
                var node = manager.Nodes[i];
                ref var entry = ref painted[node.Id];
                if (!ReferenceEquals(entry.Node, node))
                {
                    entry.Node = node;
                    entry.Renderer = Node.FindFirst<Renderer>(node.gameObject, node);
                    entry.Step = -1;
                }
                entry.IsNew = false;
                if (entry.Renderer == null || !node.TryGetAnswer(out TData data)) continue;
                entry.Number = Read(data);
                entry.IsNew = float.IsFinite(entry.Number);
                scale.Include(entry.Number);
            }
        }

        private void Paint(SimulationManager manager)
        {
            var isRecoloured = paintedLow != scale.low || paintedHigh != scale.high;
            paintedLow = scale.low;
            paintedHigh = scale.high;
            for (var i = 0; i < manager.Nodes.Count; i++)
            {
                ref var entry = ref painted[manager.Nodes[i].Id];
                if (!entry.IsNew) continue;
                var step = scale.StepOf(entry.Number);
                if (step == entry.Step && !isRecoloured) continue;
                entry.Step = step;
                entry.Renderer.Paint(scale.At(step));
            }
        }

        private void Describe()
        {
            var builder = new StringBuilder(title).Append("  ").Append(Text(scale.lowest)).Append(' ');
            for (var step = 0; step < ColourScale.Steps; step++) builder.Append("<color=#").Append(Hex(scale.At(step))).Append(">\u2588</color>");
            text = builder.Append(' ').Append(Text(scale.highest)).ToString();
        }

        private static string Text(float number) => number.ToString("G4", CultureInfo.InvariantCulture);

        private static string Hex(Color color) =>
            ((int)(255 * Mathf.Clamp01(color.r)) << 16 | (int)(255 * Mathf.Clamp01(color.g)) << 8 | (int)(255 * Mathf.Clamp01(color.b))).ToString("X6");

        /// <summary>Shows the legend.</summary>
        protected virtual void OnGUI()
        {
            if (legend) GUI.Label(Legends.PlaceOf(this), Legend);
            else Legends.Remove(this);
        }
    }
}
