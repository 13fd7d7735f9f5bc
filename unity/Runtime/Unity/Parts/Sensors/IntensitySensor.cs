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

        /// <summary>The source to measure; while it is disabled, its intensity is 0. Null: the sum of all enabled sources.</summary>
        public IntensitySource Source
        {
            get => source;
            set => source = value;
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data)
        {
            var position = Node.Position;
            Write(ref data, source == null ? AllAt(position) : source.isActiveAndEnabled ? source.IntensityAt(position) : 0);
        }

        /// <summary>Writes the intensity.</summary>
        protected abstract void Write(ref TData data, float intensity);

        private static float AllAt(Vector3 position)
        {
            var sources = IntensitySource.All;
            var intensity = 0f;
            for (var i = 0; i < sources.Count; i++) intensity += sources[i].IntensityAt(position);
            return intensity;
        }
    }
}
