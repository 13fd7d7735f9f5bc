using System;
using System.Collections.Generic;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>Derives colourings from the nodes' answers, for scenes without their own.</summary>
    internal static class AnswerColourings
    {
        /// <summary>Maximum number of colourings. It is limited, because each colouring takes time and space in every frame.</summary>
        private const int MaxColourings = 8;

        /// <summary>Returns a colouring for each number, boolean and enum of the answers, at most eight.</summary>
        internal static List<NodeColouring> Of(SimulationManager manager)
        {
            var colourings = new List<NodeColouring>();
            foreach (var field in AnswerField.Of(Schemas.Find(manager.Settings.schema)))
            {
                if (colourings.Count == MaxColourings) break;
                if (Converter(field.Type) is Func<object, double> convert) colourings.Add(Colouring(field, convert));
            }
            return colourings;
        }

        private static NodeColouring Colouring(AnswerField field, Func<object, double> convert)
        {
            var name = char.ToLowerInvariant(field.Name[0]) + field.Name.Substring(1);
            var colouring = new NodeColouring(name, node => node.Answer is object answer && field.Read(answer) is object value ? convert(value) : double.NaN);
            if (field.Type == typeof(bool)) (colouring.IsCategory, colouring.Categories) = (true, new[] { "false", "true" });
            else if (field.Type.IsEnum) (colouring.IsCategory, colouring.Categories) = (true, NamesOf(field.Type));
            return colouring;
        }

        /// <summary>Returns a function that converts values of a type to those of a colouring; null for types that cannot colour nodes.</summary>
        internal static Func<object, double> Converter(Type type)
        {
            if (type == typeof(bool)) return value => (bool)value ? 1 : 0;
            if (IsFlags(type)) return Convert.ToDouble;
            if (type.IsEnum)
            {
                // The values are in the same order as the names.
                var values = Enum.GetValues(type);
                return value => Array.IndexOf(values, value) is var place && place >= 0 ? place : double.NaN;
            }
            if (type.IsPrimitive && type != typeof(char)) return value => Convert.ToDouble(value);
            return null;
        }

        private static bool IsFlags(Type type) => type.IsDefined(typeof(FlagsAttribute), false);

        /// <summary>Returns the names of an enum's values, or of all sets of flags. The page shows numbers if there are more than 256 sets.</summary>
        internal static string[] NamesOf(Type type)
        {
            if (!IsFlags(type)) return Enum.GetNames(type);
            ulong all = 0;
            foreach (var flag in Enum.GetValues(type)) all |= Convert.ToUInt64(flag);
            var names = new string[all < 256 ? (int)all + 1 : 0];
            for (var set = 0; set < names.Length; set++) names[set] = Enum.ToObject(type, set).ToString();
            return names;
        }
    }
}
