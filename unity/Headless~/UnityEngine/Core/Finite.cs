namespace UnityEngine
{
    /// Rejects NaN and infinity with an error, as Unity does.
    static class Finite
    {
        public static bool Accepts(Vector3 value, string what, Object context) => Accepts(value.x + value.y + value.z, value, what, context);
        public static bool Accepts(Quaternion value, string what, Object context) => Accepts(value.x + value.y + value.z + value.w, value, what, context);

        static bool Accepts<T>(float sum, T value, string what, Object context) where T : struct
        {
            if (sum - sum == 0f) return true;
            Debug.LogError($"{what} assign attempt for '{context.NameImpl}' is not valid. Input is {value}.", context);
            return false;
        }
    }
}
