using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Measures the intensity of an <see cref="IntensitySource"/> at the node, or the sum of all enabled ones.</summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class IntensitySensor<TData> : Sensor<TData>
    {
        [SerializeField]
        [Tooltip("Source to measure. None: the sum of all enabled sources in the scene.")]
        private IntensitySource source;

        // The last source that existed. A destroyed source equals null, but is not a null reference.
        private IntensitySource lastSource;

        /// <summary>The source to measure; while it is disabled or after it was destroyed, its intensity is 0. Null: the sum of all enabled sources.</summary>
        public IntensitySource Source
        {
            get => source;
            set
            {
                source = value;
                lastSource = value == null ? null : value;
            }
        }

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            if (source != null) lastSource = source;
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data)
        {
            var position = Node.Position;
            if (source != null) lastSource = source;
            Write(ref data, lastSource is null ? AllAt(position) : source != null && source.isActiveAndEnabled ? source.IntensityAt(position) : 0);
        }

        /// <summary>Writes the intensity.</summary>
        protected abstract void Write(ref TData data, float intensity);

        // A source that the inspector clears still exists. After a source was destroyed, clearing the field has no effect.
        private void OnValidate()
        {
            if (source == null && lastSource != null) lastSource = null;
        }

        private static float AllAt(Vector3 position)
        {
            var sources = IntensitySource.All;
            // Unity enables sources in an undefined order. Adding the rounding errors makes the sum independent of it.
            double sum = 0, errors = 0;
            for (var i = 0; i < sources.Count; i++)
            {
                double intensity = sources[i].IntensityAt(position);
                var next = sum + intensity;
                var added = next - sum;
                errors += sum - (next - added) + (intensity - added);
                sum = next;
            }
            // Infinite intensities have no rounding error.
            return (float)(double.IsNaN(errors) ? sum : sum + errors);
        }
    }
}
