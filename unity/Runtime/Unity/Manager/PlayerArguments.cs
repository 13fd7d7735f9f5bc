using System;
using System.Globalization;
using System.Reflection;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Settings from the command line of a player, for batch runs: <c>-collektive-seed 7 -collektive-record run.clkrec</c>. Each setting that is a number,
    /// a text or a choice can be given, under its name in scenario files. The editor has the inspector instead.
    /// </summary>
    internal static class PlayerArguments
    {
        private const string Prefix = "-collektive-";

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
                if (field == null) return words[i] + " is not an option; the options are: " + Prefix + string.Join(", " + Prefix, Names());
                if (++i == words.Length) return Prefix + name + " needs a value";
                if (!TryParse(field.FieldType, words[i], out var value))
                    return Prefix + name + " is '" + words[i] + "': it must be " + Kind(field.FieldType);
                field.SetValue(settings, value);
            }
            return null;
        }

        private static FieldInfo[] Fields() => Array.FindAll(
            typeof(SimulationSettings).GetFields(BindingFlags.Public | BindingFlags.Instance),
            field => field.FieldType.IsPrimitive || field.FieldType.IsEnum || field.FieldType == typeof(string));

        private static string[] Names() => Array.ConvertAll(Fields(), field => field.Name);

        private static bool TryParse(Type type, string text, out object value)
        {
            value = text;
            if (type == typeof(string)) return true;
            try
            {
                // By its name only, as in scenario files.
                if (type.IsEnum) return Array.IndexOf(Enum.GetNames(type), text) >= 0 && (value = Enum.Parse(type, text)) != null;
                value = Convert.ChangeType(text, type, CultureInfo.InvariantCulture);
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
