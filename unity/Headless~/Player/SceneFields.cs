using System;
using System.Collections;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.Serialization;
using Collektive.Unity;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using UnityEngine;

namespace Collektive.Headless
{
    /// <summary>Sets public fields of a scene builder from the scenario file and the command line, and reads all of them.</summary>
    internal static class SceneFields
    {
        private const BindingFlags Public = BindingFlags.Public | BindingFlags.Instance;

        /// <summary>Returns the values of all fields that a scenario can set, including defaults.</summary>
        internal static JObject Get(SceneBuilder builder)
        {
            var lists = new Queue<Action>();
            var fields = (JObject)ToJson(builder, builder.GetType(), new ObjectIDGenerator(), lists);
            while (lists.Count > 0) lists.Dequeue()();
            return fields;
        }

        internal static void Set(SceneBuilder builder, Scenario scenario, IReadOnlyList<string> assignments)
        {
            var tokens = new Dictionary<string, JToken>();
            foreach (var property in scenario.Fields.Properties()) tokens[property.Name] = property.Value;
            foreach (var assignment in assignments)
            {
                var name = assignment.Substring(0, assignment.IndexOf('='));
                tokens[name] = Token(assignment.Substring(name.Length + 1), Find(builder, name));
            }
            foreach (var token in tokens)
            {
                var field = Find(builder, token.Key);
                field.SetValue(builder, Value(scenario.File, token.Value, field.FieldType, field.Name, field.GetValue(builder)));
            }
        }

        private static FieldInfo Find(SceneBuilder builder, string name)
        {
            var field = builder.GetType().GetField(name, Public);
            if (field != null) return field;
            var names = new List<string>();
            foreach (var known in builder.GetType().GetFields(Public)) names.Add(known.Name);
            throw new ScenarioException(
                "the scene " + builder.GetType().FullName + " has no public field '" + name + "'; it has: " + string.Join(", ", names));
        }

        /// <summary>Returns an error for a problem of a scene. If the text begins with a quoted field of the scenario, adds the line of the field.</summary>
        internal static ScenarioException Error(Scenario scenario, string problem)
        {
            JToken found = scenario.Fields;
            var path = problem.StartsWith("'", StringComparison.Ordinal) ? problem.Substring(1, Math.Max(0, problem.IndexOf('\'', 1) - 1)) : "";
            foreach (var name in path.Split(new[] { '.', '[', ']' }, StringSplitOptions.RemoveEmptyEntries))
            {
                var next = found is JArray list && int.TryParse(name, out var index) && index < list.Count ? list[index] : (found as JObject)?[name];
                if (next == null) break;
                found = next;
            }
            return scenario.File.Error(found, problem);
        }

        /// <param name="current">The current value. An object keeps the fields that the token does not contain.</param>
        private static object Value(JsonFile file, JToken token, Type type, string key, object current = null)
        {
            if (type == typeof(Vector3))
            {
                var numbers = token as JArray;
                if (numbers == null || numbers.Count != 3) throw file.Error(token, "'" + key + "' must be a list of three numbers");
                float Number(int index) => (float)file.Convert(numbers[index], typeof(float), key);
                return new Vector3(Number(0), Number(1), Number(2));
            }
            if (ElementOf(type) is Type element && element != typeof(string))
            {
                if (!(token is JArray items)) throw file.Error(token, "'" + key + "' must be a list");
                var list = (IList)Activator.CreateInstance(typeof(List<>).MakeGenericType(element));
                for (var i = 0; i < items.Count; i++) list.Add(Value(file, items[i], element, key + "[" + i + "]"));
                if (!type.IsArray) return list;
                var array = Array.CreateInstance(element, list.Count);
                list.CopyTo(array, 0);
                return array;
            }
            if (!IsObject(type)) return file.Convert(token, type, key);
            var part = (JObject)file.Convert(token, typeof(JObject), key);
            file.RejectUnknownKeys(part, key + ".", Array.ConvertAll(type.GetFields(Public), field => field.Name));
            var value = current ?? Activator.CreateInstance(type);
            foreach (var field in type.GetFields(Public))
                if (part[field.Name] is JToken given)
                    field.SetValue(value, Value(file, given, field.FieldType, key + "." + field.Name, field.GetValue(value)));
            return value;
        }

        /// <summary>Returns the value in a form that <see cref="Value"/> reads back; null for types that scenarios cannot set.</summary>
        /// <param name="seen">The objects so far. Another reference to one of them, possibly from itself, is omitted.</param>
        /// <param name="lists">Adds the lists later. A list with an object that is also the value of a field is omitted: setting it changes both.</param>
        private static JToken ToJson(object value, Type type, ObjectIDGenerator seen, Queue<Action> lists)
        {
            if (value?.GetType() == type && (value is Vector3 vector ? new JArray(vector.x, vector.y, vector.z) : JsonFile.Token(value)) is JToken token)
                return token;
            if (value is IEnumerable items && ElementOf(type) is Type element)
            {
                var list = new JArray();
                foreach (var item in items)
                {
                    // The scenario would create objects of the element's type.
                    var json = item != null && IsObject(element) && item.GetType() != element ? null : ToJson(item, element, seen, lists);
                    if (json == null) return null;
                    list.Add(json);
                }
                return list;
            }
            if (!(value is SceneBuilder) && (value == null || !IsObject(type))) return null;
            seen.GetId(value, out var isFirst);
            if (!isFirst) return null;
            var values = new JObject();
            foreach (var field in type.GetFields(Public))
            {
                if (values.ContainsKey(field.Name)) continue;
                // Keeps the order of the fields.
                values.Add(field.Name, null);
                void Add() => Set(values, field.Name, ToJson(field.GetValue(value), field.FieldType, seen, lists));
                if (ElementOf(field.FieldType) != null) lists.Enqueue(Add);
                else Add();
            }
            return values;
        }

        private static void Set(JObject values, string name, JToken value)
        {
            if (value == null) values.Remove(name);
            else values[name] = value;
        }

        private static Type ElementOf(Type type) =>
            type.IsArray ? type.GetElementType()
                : type.IsGenericType && type.GetGenericTypeDefinition() == typeof(List<>) ? type.GetGenericArguments()[0] : null;

        /// <summary>Returns whether a type is a plain class of the scene's code. In a scenario, it is an object whose keys are its fields.</summary>
        private static bool IsObject(Type type) =>
            type.IsClass && !type.IsAbstract && !typeof(UnityEngine.Object).IsAssignableFrom(type) && !typeof(IEnumerable).IsAssignableFrom(type)
                && !typeof(Delegate).IsAssignableFrom(type) && type.Assembly != typeof(object).Assembly && type.GetConstructor(Type.EmptyTypes) != null;

        /// <summary>Reads a value of the command line as JSON. Strings need no quotes.</summary>
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
