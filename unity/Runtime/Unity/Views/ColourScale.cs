using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A scale that maps numbers to colours between a low and a high colour, in <see cref="Steps"/> steps.</summary>
    [Serializable]
    public sealed class ColourScale
    {
        /// <summary>Number of different colours.</summary>
        internal const int Steps = 16;

        /// <summary>Colour of the lowest value.</summary>
        [Tooltip("Colour of the lowest value.")]
        public Color low = new Color(0.25f, 0.05f, 0.45f);

        /// <summary>Colour of the highest value.</summary>
        [Tooltip("Colour of the highest value.")]
        public Color high = new Color(1, 0.9f, 0.2f);

        /// <summary>Whether the scale adapts to the lowest and highest value of each tick.</summary>
        [Tooltip("On: the scale adapts to the lowest and highest value of each tick. Off: it uses the values below.")]
        public bool automatic = true;

        /// <summary>The lowest value. Lower values have the same colour.</summary>
        [Tooltip("The lowest value. Lower values have the same colour.")]
        public float lowest;

        /// <summary>The highest value. Higher values have the same colour.</summary>
        [Tooltip("The highest value. Higher values have the same colour.")]
        public float highest = 1;

        private bool empty;

        /// <summary>Returns the colour of a step, 0 to <see cref="Steps"/> - 1.</summary>
        internal Color At(int step) => Color.Lerp(low, high, step / (Steps - 1f));

        /// <summary>Returns the step of a value, clamped to the scale. NaN is also mapped to a step.</summary>
        internal int StepOf(float value)
        {
            // In double precision, because the difference of two floats may overflow.
            var fraction = ((double)value - lowest) / ((double)highest - lowest);
            return fraction >= 1 ? Steps - 1 : fraction > 0 ? (int)(fraction * Steps) : 0;
        }

        /// <summary>Begins a tick by resetting the ends of an automatic scale.</summary>
        internal void Begin() => empty = true;

        /// <summary>Extends an automatic scale to include a value.</summary>
        internal void Include(float value)
        {
            if (!automatic || !float.IsFinite(value)) return;
            lowest = empty ? value : Math.Min(lowest, value);
            highest = empty ? value : Math.Max(highest, value);
            empty = false;
        }
    }
}
