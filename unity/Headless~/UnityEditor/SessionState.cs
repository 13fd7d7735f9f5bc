using System.Collections.Generic;

namespace UnityEditor
{
    public class SessionState
    {
        static readonly Dictionary<string, string> Strings = new Dictionary<string, string>();
        public static void SetString(string key, string value) => Strings[key] = value;
        public static string GetString(string key, string defaultValue) => Strings.TryGetValue(key, out var value) ? value : defaultValue;
        public static void EraseString(string key) => Strings.Remove(key);
    }
}
