using org.collektive.schema;

namespace Collektive.Unity
{
    /// <summary>
    /// Converts value types of <c>types.fbs</c> to Unity's types within expressions. In assignments, values are converted implicitly, in both directions.
    /// </summary>
    public static class Conversions
    {
        /// <summary>Converts to Unity's type.</summary>
        public static UnityEngine.Vector3 ToUnity(this Vector3Value value) => new UnityEngine.Vector3(value.X, value.Y, value.Z);

        /// <summary>Converts to Unity's type.</summary>
        public static UnityEngine.Vector2 ToUnity(this Vector2Value value) => new UnityEngine.Vector2(value.X, value.Y);

        /// <summary>Converts to Unity's type.</summary>
        public static UnityEngine.Quaternion ToUnity(this QuaternionValue value) =>
            new UnityEngine.Quaternion(value.X, value.Y, value.Z, value.W);

        /// <summary>Converts to Unity's type.</summary>
        public static UnityEngine.Color ToUnity(this ColorValue value) => new UnityEngine.Color(value.R, value.G, value.B, value.A);

        /// <summary>Converts a field or element of an answer that is a table to Unity's type; zero if the program omitted it.</summary>
        public static UnityEngine.Vector3 ToUnity(this Vector3? value) =>
            value is Vector3 given ? new UnityEngine.Vector3(given.X, given.Y, given.Z) : UnityEngine.Vector3.zero;

        /// <summary>Converts a field or element of an answer that is a table to Unity's type; zero if the program omitted it.</summary>
        public static UnityEngine.Vector2 ToUnity(this Vector2? value) =>
            value is Vector2 given ? new UnityEngine.Vector2(given.X, given.Y) : UnityEngine.Vector2.zero;

        /// <summary>Converts a field or element of an answer that is a table to Unity's type; no rotation if the program omitted it.</summary>
        public static UnityEngine.Quaternion ToUnity(this Quaternion? value) =>
            value is Quaternion given ? new UnityEngine.Quaternion(given.X, given.Y, given.Z, given.W) : UnityEngine.Quaternion.identity;

        /// <summary>Converts a field or element of an answer that is a table to Unity's type; clear if the program omitted it.</summary>
        public static UnityEngine.Color ToUnity(this Color? value) =>
            value is Color given ? new UnityEngine.Color(given.R, given.G, given.B, given.A) : UnityEngine.Color.clear;
    }
}
