using System.IO;
using System.Reflection;
using UnityEngine;

namespace UnityEditor
{
    /// Stores the public fields that are texts or booleans in the file that the attribute names, one "name: value" per line.
    public class ScriptableSingleton<T> : ScriptableObject where T : ScriptableObject
    {
        static T single;

        public static T instance
        {
            get
            {
                if (single == null || loadedFrom != Path.GetFullPath(GetFilePath())) Load();
                return single;
            }
        }

        static string loadedFrom;

        protected ScriptableSingleton() { }

        protected virtual void Save(bool saveAsText)
        {
            var path = GetFilePath();
            Directory.CreateDirectory(Path.GetDirectoryName(path));
            using (var file = new StreamWriter(path))
                foreach (var field in typeof(T).GetFields(BindingFlags.Instance | BindingFlags.Public))
                    file.WriteLine(field.Name + ": " + field.GetValue(this));
        }

        protected static string GetFilePath() => typeof(T).GetCustomAttribute<FilePathAttribute>().relativePath;

        static void Load()
        {
            single = ScriptableObject.CreateInstance<T>();
            loadedFrom = Path.GetFullPath(GetFilePath());
            if (!File.Exists(loadedFrom)) return;
            foreach (var line in File.ReadAllLines(loadedFrom))
            {
                var parts = line.Split(new[] { ": " }, 2, System.StringSplitOptions.None);
                var field = typeof(T).GetField(parts[0]);
                if (field == null) continue;
                var isEnum = field.FieldType.IsEnum;
                field.SetValue(single, isEnum ? System.Enum.Parse(field.FieldType, parts[1]) : System.Convert.ChangeType(parts[1], field.FieldType));
            }
        }
    }
}
