using System;
using System.Collections.Generic;
using System.Reflection;
using Collektive.Unity;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using UnityEngine;

namespace Collektive.Headless
{
    /// <summary>Sets public fields of a scene builder, from the scenario file and from the command line, and reads them all.</summary>
    internal static class SceneFields
    {
        /// <summary>The values of all fields that a scenario can set, those with their defaults included.</summary>
        internal static JObject Get(SceneBuilder builder)
        {
            var values = new JObject();
            foreach (var field in builder.GetType().GetFields(BindingFlags.Public | BindingFlags.Instance))
            {
                var value = field.GetValue(builder);
                var token = value is Vector3 vector ? new JArray(vector.x, vector.y, vector.z) : JsonFile.Token(value);
                if (token != null) values.Add(field.Name, token);
            }
            return values;
        }

        internal static void Set(SceneBuilder builder, Scenario scenario, IReadOnlyList<string> assignments)
        {
            foreach (var property in scenario.Fields.Properties())
            {
                var field = Find(builder, property.Name);
                field.SetValue(builder, Value(scenario.File, property.Value, field));
            }
            foreach (var assignment in assignments)
            {
                var equals = assignment.IndexOf('=');
                var field = Find(builder, assignment.Substring(0, equals));
                field.SetValue(builder, Value(scenario.File, Token(assignment.Substring(equals + 1), field), field));
            }
        }

        private static FieldInfo Find(SceneBuilder builder, string name)
        {
            var field = builder.GetType().GetField(name, BindingFlags.Public | BindingFlags.Instance);
            if (field != null) return field;
            var names = new List<string>();
            foreach (var known in builder.GetType().GetFields(BindingFlags.Public | BindingFlags.Instance)) names.Add(known.Name);
            throw new ScenarioException(
                "the scene " + builder.GetType().FullName + " has no public field '" + name + "'; it has: " + string.Join(", ", names));
        }

        private static object Value(JsonFile file, JToken token, FieldInfo field)
        {
            if (field.FieldType != typeof(Vector3)) return file.Convert(token, field.FieldType, field.Name);
            var numbers = token as JArray;
            if (numbers == null || numbers.Count != 3) throw file.Error(token, "'" + field.Name + "' must be a list of three numbers");
            float Number(int index) => (float)file.Convert(numbers[index], typeof(float), field.Name);
            return new Vector3(Number(0), Number(1), Number(2));
        }

        /// <summary>Reads command-line text as JSON. Strings need no quotes.</summary>
        private static JToken Token(string text, FieldInfo field)
        {
            if (field.FieldType == typeof(string) || field.FieldType.IsEnum) return new JValue(text);
            try
            {
                return JsonFile.Parse(text);
            }
            catch (JsonReaderException)
            {
                throw new ScenarioException("--set " + field.Name + "=" + text + ": it must be of type " + JsonFile.NameOf(field.FieldType));
            }
        }
    }
}
