using org.collektive.schema;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Between Unity's value types and those of <c>types.fbs</c>.</summary>
    public static class Conversions
    {
        /// <summary>As schema data.</summary>
        public static Vector3Value ToValue(this UnityEngine.Vector3 vector) =>
            new Vector3Value { x = vector.x, y = vector.y, z = vector.z };

        /// <summary>As Unity's type.</summary>
        public static UnityEngine.Vector3 ToUnity(this Vector3Value value) => new UnityEngine.Vector3(value.x, value.y, value.z);

        /// <summary>As schema data.</summary>
        public static Vector2Value ToValue(this UnityEngine.Vector2 vector) => new Vector2Value { x = vector.x, y = vector.y };

        /// <summary>As Unity's type.</summary>
        public static UnityEngine.Vector2 ToUnity(this Vector2Value value) => new UnityEngine.Vector2(value.x, value.y);

        /// <summary>As schema data.</summary>
        public static QuaternionValue ToValue(this UnityEngine.Quaternion rotation) =>
            new QuaternionValue { x = rotation.x, y = rotation.y, z = rotation.z, w = rotation.w };

        /// <summary>As Unity's type.</summary>
        public static UnityEngine.Quaternion ToUnity(this QuaternionValue value) =>
            new UnityEngine.Quaternion(value.x, value.y, value.z, value.w);

        /// <summary>As schema data; Unity's colour is taken as linear.</summary>
        public static ColorValue ToValue(this UnityEngine.Color color) =>
            new ColorValue { r = color.r, g = color.g, b = color.b, a = color.a };

        /// <summary>As Unity's type.</summary>
        public static UnityEngine.Color ToUnity(this ColorValue value) => new UnityEngine.Color(value.r, value.g, value.b, value.a);
    }
}
