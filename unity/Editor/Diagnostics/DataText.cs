using System;
using System.Collections;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;

namespace Collektive.Unity.Editor
{
    /// <summary>Converts data of any schema to names and values.</summary>
    internal static class DataText
    {
        private const int MaxElements = 8;

        /// <summary>Returns the fields of a struct or a draft, or the properties of a FlatBuffers reader.</summary>
        internal static List<KeyValuePair<string, string>> Of(object data)
        {
            var lines = new List<KeyValuePair<string, string>>();
            foreach (var member in Members(data.GetType())) lines.Add(new KeyValuePair<string, string>(member.Name, Text(Value(member, data))));
            return lines;
        }

        private static List<MemberInfo> Members(Type type)
        {
            var members = new List<MemberInfo>();
            members.AddRange(type.GetFields(BindingFlags.Instance | BindingFlags.Public));
            foreach (var property in type.GetProperties(BindingFlags.Instance | BindingFlags.Public))
            {
                // The property ByteBuffer of FlatBuffers readers is their memory, not a field of the schema.
                if (property.CanRead && property.GetIndexParameters().Length == 0 && property.Name != "ByteBuffer") members.Add(property);
            }
            return members;
        }

        private static object Value(MemberInfo member, object data) =>
            member is FieldInfo field ? field.GetValue(data) : ((PropertyInfo)member).GetValue(data);

        private static string Text(object value)
        {
            switch (value)
            {
                case null: return "none";
                case string text: return text;
                case IFormattable number when value.GetType().IsPrimitive || value is Enum: return number.ToString(null, CultureInfo.InvariantCulture);
                case bool flag: return flag ? "true" : "false";
                case IEnumerable list: return ListText(list);
            }
            var parts = new List<string>();
            foreach (var member in Members(value.GetType())) parts.Add(member.Name + " " + Text(Value(member, value)));
            return parts.Count == 0 ? value.ToString() : string.Join(", ", parts);
        }

        private static string ListText(IEnumerable list)
        {
            var parts = new List<string>();
            foreach (var element in list)
            {
                if (parts.Count == MaxElements)
                {
                    parts.Add("...");
                    break;
                }
                parts.Add("[" + Text(element) + "]");
            }
            return parts.Count == 0 ? "empty" : string.Join(" ", parts);
        }
    }
}
