using System;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;
using System.Text;
using Collektive.Bridge;
using Collektive.FlatBuffers;

namespace Collektive.Headless.Tests.Schema
{
    /// <summary>
    /// Converts drafts, mirrors and flatc's readers to a canonical text, which equals the text of flatc's Java objects. Members are sorted by name.
    /// Floating-point numbers are printed as bits, integers as signed 64-bit numbers, and absent lists as empty lists.
    /// </summary>
    internal static class Dump
    {
        internal static string Of(object data)
        {
            var text = new StringBuilder();
            Append(text, data);
            return text.ToString();
        }

        private static void Append(StringBuilder text, object data)
        {
            switch (data)
            {
                case null: text.Append("null"); break;
                case string s: text.Append('"').Append(s).Append('"'); break;
                case bool b: text.Append(b ? "true" : "false"); break;
                case float f: text.Append('f').Append(BitConverter.SingleToInt32Bits(f)); break;
                case double d: text.Append('d').Append(BitConverter.DoubleToInt64Bits(d)); break;
                case Enum e: Append(text, Convert.ChangeType(e, Enum.GetUnderlyingType(e.GetType()))); break;
                case ulong u: text.Append(unchecked((long)u)); break;
                case IConvertible i: text.Append(i.ToInt64(CultureInfo.InvariantCulture)); break;
                case List<object> list: AppendAll(text, list); break;
                default: AppendMembers(text, data); break;
            }
        }

        private static void AppendAll(StringBuilder text, List<object> list)
        {
            text.Append('[');
            foreach (var item in list)
            {
                Append(text, item);
                text.Append(' ');
            }
            text.Append(']');
        }

        private static void AppendMembers(StringBuilder text, object data)
        {
            text.Append('{');
            foreach (var member in data is IFlatbufferObject ? ReaderMembers(data) : StagedMembers(data))
            {
                text.Append(member.Key).Append('=');
                Append(text, member.Value);
                text.Append(' ');
            }
            text.Append('}');
        }

        private static SortedDictionary<string, object> StagedMembers(object data)
        {
            var members = new SortedDictionary<string, object>(StringComparer.Ordinal);
            foreach (var field in data.GetType().GetFields(BindingFlags.Public | BindingFlags.Instance))
            {
                members.Add(Name(field.Name), field.GetValue(data));
            }
            foreach (var property in data.GetType().GetProperties(BindingFlags.Public | BindingFlags.Instance))
            {
                var value = property.GetValue(data);
                members.Add(Name(property.Name), property.PropertyType.IsGenericType ? Items(value) : value);
            }
            return members;
        }

        private static List<object> Items(object list)
        {
            var copy = list.GetType().GetGenericTypeDefinition() == typeof(DraftList<>) ? nameof(Values) : nameof(Tables);
            return (List<object>)typeof(Dump).GetMethod(copy, BindingFlags.NonPublic | BindingFlags.Static)
                .MakeGenericMethod(list.GetType().GenericTypeArguments).Invoke(null, new[] { list });
        }

        private static List<object> Values<T>(DraftList<T> list)
        {
            var items = new List<object>();
            for (var i = 0; i < list.Count; i++) items.Add(list[i]);
            return items;
        }

        private static List<object> Tables<T>(DraftTables<T> list) where T : Draft, new()
        {
            var items = new List<object>();
            for (var i = 0; i < list.Count; i++) items.Add(list[i]);
            return items;
        }

        private static SortedDictionary<string, object> ReaderMembers(object reader)
        {
            var members = new SortedDictionary<string, object>(StringComparer.Ordinal);
            var type = reader.GetType();
            foreach (var property in type.GetProperties(BindingFlags.Public | BindingFlags.Instance))
            {
                if (property.Name == "ByteBuffer") continue;
                var list = property.Name.EndsWith("Length") ? property.Name.Substring(0, property.Name.Length - "Length".Length) : null;
                var element = list == null ? null : type.GetMethod(list, new[] { typeof(int) });
                if (element == null) members.Add(Name(property.Name), property.GetValue(reader));
                else members.Add(Name(list), Elements(reader, element, (int)property.GetValue(reader)));
            }
            return members;
        }

        private static List<object> Elements(object reader, MethodInfo element, int count)
        {
            var items = new List<object>();
            for (var i = 0; i < count; i++) items.Add(element.Invoke(reader, new object[] { i }));
            return items;
        }

        private static string Name(string member) =>
            string.Concat(Array.ConvertAll(member.Split('_'), part => part.Length == 0 ? "" : char.ToUpperInvariant(part[0]) + part.Substring(1)));
    }
}
