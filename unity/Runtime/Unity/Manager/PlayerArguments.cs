using System;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Reads settings from the command line of a player, for batch runs: <c>-collektive-seed 7 -collektive-jvm.placement OwnProcess</c>. Options have the
    /// names of the settings in scenario files, and exist for all numbers, texts and choices. The editor ignores them.
    /// </summary>
    internal static class PlayerArguments
    {
        private const string Prefix = "-collektive-";
        private const string JvmPrefix = "jvm.";

        /// <summary>
        /// Applies the command line to the settings. <see cref="SimulationSettings.FindProblem"/> checks their ranges.
        /// </summary>
        internal static SimulationSettings Apply(SimulationSettings settings)
        {
            if (!Application.isEditor) settings.ArgumentProblem = Apply(settings, Environment.GetCommandLineArgs());
            return settings;
        }

        /// <returns>The error of the first invalid argument, or null.</returns>
        internal static string Apply(SimulationSettings settings, string[] words)
        {
            for (var i = 0; i < words.Length; i++)
            {
                if (!words[i].StartsWith(Prefix, StringComparison.Ordinal)) continue;
                var name = words[i].Substring(Prefix.Length);
                var field = Array.Find(Fields(), known => known.Name == name);
                var setting = name.StartsWith(JvmPrefix, StringComparison.Ordinal) ? JvmSetting.Find(name.Substring(JvmPrefix.Length)) : null;
                var type = field != null ? field.FieldType : setting?.Type;
                if (!IsSimple(type)) return words[i] + " is not an option; the options are: " + Prefix + string.Join(", " + Prefix, Names());
                if (++i == words.Length) return Prefix + name + " needs a value";
                if (!TryParse(type, words[i], out var value)) return Prefix + name + " is '" + words[i] + "': it must be " + Kind(type);
                if (field != null) field.SetValue(settings, value);
                else setting.Set(JvmOf(settings), value);
            }
            const string home = Prefix + JvmPrefix + nameof(JvmSettings.home);
            if (Array.IndexOf(words, home) < 0 || JvmOf(settings).location == JvmLocation.Folder) return null;
            return home + " needs " + Prefix + JvmPrefix + nameof(JvmSettings.location) + " " + JvmLocation.Folder;
        }

        private static JvmSettings JvmOf(SimulationSettings settings)
        {
            if (settings.jvm == null) settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            return settings.jvm.settings;
        }

        private static FieldInfo[] Fields() =>
            Array.FindAll(typeof(SimulationSettings).GetFields(BindingFlags.Public | BindingFlags.Instance), field => IsSimple(field.FieldType));

        private static bool IsSimple(Type type) => type != null && (type.IsPrimitive || type.IsEnum || type == typeof(string));

        private static List<string> Names()
        {
            var names = new List<string>(Array.ConvertAll(Fields(), field => field.Name));
            foreach (var setting in JvmSetting.All)
            {
                if (IsSimple(setting.Type)) names.Add(JvmPrefix + setting.Key);
            }
            return names;
        }

        private static bool TryParse(Type type, string text, out object value)
        {
            value = text;
            if (type == typeof(string)) return true;
            try
            {
                // Accept names only, as in scenario files.
                if (type.IsEnum) return Array.IndexOf(Enum.GetNames(type), text) >= 0 && (value = Enum.Parse(type, text)) != null;
                // ChangeType ignores commas, so it would read "0,05" as 5.
                value = type == typeof(float) ? float.Parse(text, NumberStyles.Float, CultureInfo.InvariantCulture)
                    : Convert.ChangeType(text, type, CultureInfo.InvariantCulture);
                return true;
            }
            catch (Exception error) when (error is FormatException || error is OverflowException)
            {
                return false;
            }
        }

        private static string Kind(Type type) => type.IsEnum ? "one of " + string.Join(", ", Enum.GetNames(type))
            : type == typeof(ulong) ? "a whole number from 0 to " + ulong.MaxValue
            : type == typeof(int) ? "a whole number" : "a number";
    }
}
